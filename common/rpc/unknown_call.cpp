#include "common/rpc/unknown_call.hpp"

#include "common/recording/build_name.hpp"
#include "common/rpc/rpc_server.hpp"

namespace longreach {
namespace {

constexpr std::string_view kAgent = "longreach/";

/// "version 0.1.0", or "another version" if the client does not say it, as those before 0.1.0.
std::string version_of(const grpc::GenericCallbackServerContext& context) {
  const auto found = context.client_metadata().find("user-agent");
  const std::string agent =
      found == context.client_metadata().end() ? "" : std::string(found->second.data(), found->second.size());
  if (!agent.starts_with(kAgent)) return "another version";
  return "version " + agent.substr(kAgent.size(), agent.find(' ') - kAgent.size());
}

/// Ends a call at once.
class Refuse final : public grpc::ServerGenericBidiReactor {
 public:
  explicit Refuse(const grpc::Status& status) { Finish(status); }
  void OnDone() override { delete this; }
};

}  // namespace

std::string user_agent() { return std::string(kAgent) + std::string(build_version()); }

grpc::ServerGenericBidiReactor* UnknownCalls::CreateReactor(grpc::GenericCallbackServerContext* context) {
  constexpr std::size_t kNameMost = 64;
  const std::string& method = context->method();  // "/longreach.proto.Control/SetScale"
  const std::string name = method.substr(method.rfind('/') + 1, kNameMost);
  context->AddTrailingMetadata(std::string(kRefusedBy), side_);
  return new Refuse({grpc::StatusCode::FAILED_PRECONDITION,
                     "the " + side_ + " is of version " + std::string(build_version()) +
                         " and does not have the call " + name + " of this client, which is of " +
                         version_of(*context) + ": run the same version of all programs"});
}

}  // namespace longreach
