#pragma once
// The certificate that the caller of an RPC has shown, and the refusal of one that is revoked
// (common/site/revocations).

#include <memory>
#include <string>

namespace grpc {
class AuthContext;
class AuthMetadataProcessor;
}  // namespace grpc

namespace longreach {

/// The certificate that a caller has shown; empty: none.
std::string fingerprint_of(const grpc::AuthContext& caller);
/// "role=client.longreach certificate=SHA256:5f0c...", or "certificate=none".
std::string certificate_text(const grpc::AuthContext& caller);
bool is_revoked(const grpc::AuthContext& caller);
/// Refuses every call of those who are revoked.
std::shared_ptr<grpc::AuthMetadataProcessor> revocation_check();

}  // namespace longreach
