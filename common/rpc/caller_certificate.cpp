#include "common/rpc/caller_certificate.hpp"

#include <grpcpp/security/auth_metadata_processor.h>
#include <grpcpp/security/credentials.h>

#include <stdexcept>

#include "common/rpc/rpc_refusals.hpp"
#include "common/site/certificate.hpp"
#include "common/site/revocations.hpp"

namespace longreach {
namespace {

class Check final : public grpc::AuthMetadataProcessor {
 public:
  [[nodiscard]] bool IsBlocking() const override { return false; }
  grpc::Status Process(const InputMetadata&, grpc::AuthContext* caller, OutputMetadata*,
                       OutputMetadata*) override {
    if (!is_revoked(*caller)) return grpc::Status::OK;
    constexpr const char* kWhy = "the certificate of this host was revoked: pair the host again";
    note_rpc_refusal("connection " + certificate_text(*caller), kWhy);
    return {grpc::StatusCode::PERMISSION_DENIED, kWhy};
  }
};

}  // namespace

std::string fingerprint_of(const grpc::AuthContext& caller) {
  const auto shown = caller.FindPropertyValues(GRPC_X509_PEM_CERT_PROPERTY_NAME);
  if (shown.empty()) return "";
  try {
    return fingerprint(std::string(shown.front().data(), shown.front().size()));
  } catch (const std::runtime_error&) {
    return "";
  }
}

std::string certificate_text(const grpc::AuthContext& caller) {
  const std::string shown = fingerprint_of(caller);
  if (shown.empty()) return "certificate=none";
  const auto names = caller.FindPropertyValues(GRPC_X509_SAN_PROPERTY_NAME);
  const std::string role =
      names.empty() ? "" : "role=" + std::string(names.front().data(), names.front().size()) + " ";
  return role + "certificate=" + shown;
}

bool is_revoked(const grpc::AuthContext& caller) {
  const std::string shown = fingerprint_of(caller);
  return !shown.empty() && is_revoked(shown);
}

std::shared_ptr<grpc::AuthMetadataProcessor> revocation_check() { return std::make_shared<Check>(); }

}  // namespace longreach
