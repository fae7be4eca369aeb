// A side of an older version does not have a call of this client.

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include "common/recording/build_name.hpp"
#include "deploy/cli/side_client.hpp"
#include "proto/control.grpc.pb.h"

namespace longreach::older_side_test {
namespace {

/// Gives its status; each other call is unknown to gRPC.
class OlderSide final : public proto::Control::Service {
  grpc::Status GetStatus(grpc::ServerContext*, const proto::StatusRequest*, proto::Status* answer) override {
    answer->set_side("slave");
    answer->set_version("0.0.9");
    return grpc::Status::OK;
  }
};

TEST(OlderSide, IsNamedWithItsVersionAndThatOfTheClient) {
  OlderSide side;
  int port = 0;
  grpc::ServerBuilder builder;
  builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port);
  builder.RegisterService(&side);
  const std::unique_ptr<grpc::Server> server = builder.BuildAndStart();
  Options options;
  options.insecure = true;
  options.slave_address = "127.0.0.1:" + std::to_string(port);
  SideClient client(Side::kSlave, options);
  EXPECT_EQ(client.status().version(), "0.0.9");
  try {
    client.run({});
    FAIL() << "the call is unknown there";
  } catch (const SideError& error) {
    EXPECT_EQ(error.kind(), SideError::Kind::kRefused);
    EXPECT_EQ(std::string(error.what()), "the slave at " + options.slave_address +
                                             " is of version 0.0.9 and does not have this call of version " +
                                             std::string(build_version()) +
                                             ": run the same version of all programs");
  }
}

}  // namespace
}  // namespace longreach::older_side_test
