#pragma once
// Answers calls that this version does not have, for example those of an older client, with a sentence that names both
// versions. Without it, gRPC answers UNIMPLEMENTED without a text.

#include <grpcpp/generic/async_generic_service.h>

#include <string>
#include <string_view>

namespace longreach {

/// Returns what a client sends as the beginning of its user agent: "longreach/0.1.0".
std::string user_agent();

/// Register it beside the other services: gRPC gives it the calls that none of them has.
class UnknownCalls final : public grpc::CallbackGenericService {
 public:
  /// `side` is "master" or "slave".
  explicit UnknownCalls(std::string_view side) : side_(side) {}
  grpc::ServerGenericBidiReactor* CreateReactor(grpc::GenericCallbackServerContext* context) override;

 private:
  std::string side_;
};

}  // namespace longreach
