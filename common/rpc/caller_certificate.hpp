#pragma once
// Reads the certificate of the caller of an RPC, and rejects revoked certificates (common/site/revocations).

#include <memory>
#include <string>

namespace grpc {
class AuthContext;
class AuthMetadataProcessor;
}  // namespace grpc

namespace longreach {

/// Returns the fingerprint of the caller's certificate, or an empty string if there is none.
std::string fingerprint_of(const grpc::AuthContext& caller);
/// Returns, for example, "role=client.longreach certificate=SHA256:5f0c..." or "certificate=none".
std::string certificate_text(const grpc::AuthContext& caller);
bool is_revoked(const grpc::AuthContext& caller);
/// Returns a processor that rejects all calls made with a revoked certificate.
std::shared_ptr<grpc::AuthMetadataProcessor> revocation_check();

}  // namespace longreach
