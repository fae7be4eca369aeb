#pragma once
// Certificate of the caller of an RPC, and refusal of revoked certificates (common/site/revocations).

#include <memory>
#include <string>

namespace grpc {
class AuthContext;
class AuthMetadataProcessor;
}  // namespace grpc

namespace longreach {

/// Fingerprint of the caller's certificate; empty: none.
std::string fingerprint_of(const grpc::AuthContext& caller);
/// "role=client.longreach certificate=SHA256:5f0c...", or "certificate=none".
std::string certificate_text(const grpc::AuthContext& caller);
bool is_revoked(const grpc::AuthContext& caller);
/// Refuses every call with a revoked certificate.
std::shared_ptr<grpc::AuthMetadataProcessor> revocation_check();

}  // namespace longreach
