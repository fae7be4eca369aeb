#pragma once
// A gRPC connection to a side, as every client of ours makes it: straight, no proxy; patient enough for a
// link of seconds, where connecting takes several round trips; quick to find a side that has come back.

#include <grpcpp/channel.h>

#include <memory>
#include <string>

namespace longreach {

/// `address`: address:port. Does not wait: the first call connects.
std::shared_ptr<grpc::Channel> connect_rpc(const std::string& address);

}  // namespace longreach
