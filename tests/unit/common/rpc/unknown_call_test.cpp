// A client of another version asks for a call that this side does not have.

#include "common/rpc/unknown_call.hpp"

#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <chrono>

#include "common/recording/build_name.hpp"
#include "common/rpc/rpc_server.hpp"
#include "tests/unit/common/rpc/control_fake_backend.hpp"

namespace longreach::unknown_call_test {
namespace {

/// Calls `method` of `server` as a client with this user agent.
grpc::Status call(const RpcServer& server, const std::string& method, const std::string& agent) {
  grpc::ChannelArguments arguments;
  if (!agent.empty()) arguments.SetUserAgentPrefix(agent);
  grpc::GenericStub stub(
      grpc::CreateCustomChannel(server.address(), grpc::InsecureChannelCredentials(), arguments));
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(30));
  grpc::CompletionQueue queue;
  const grpc::Slice nothing;
  const grpc::ByteBuffer empty(&nothing, 1);
  const auto reader = stub.PrepareUnaryCall(&context, method, empty, &queue);
  reader->StartCall();
  grpc::ByteBuffer answer;
  grpc::Status status;
  reader->Finish(&answer, &status, nullptr);
  void* tag = nullptr;
  bool ok = false;
  queue.Next(&tag, &ok);
  if (!status.ok()) {
    EXPECT_EQ(
        context.GetServerTrailingMetadata().count(grpc::string_ref(kRefusedBy.data(), kRefusedBy.size())),
        1U);
  }
  return status;
}

TEST(UnknownCall, IsRefusedWithTheVersionsOfBoth) {
  FakeBackend side("slave");
  const RpcServer server("127.0.0.1:0", side, "slave");
  const std::string own(build_version()), advice = ": run the same version of all programs";
  const grpc::Status older = call(server, "/longreach.proto.Control/SetScale", "");
  EXPECT_EQ(older.error_code(), grpc::StatusCode::FAILED_PRECONDITION);
  EXPECT_EQ(older.error_message(), "the slave is of version " + own +
                                       " and does not have the call SetScale of this "
                                       "client, which is of another version" +
                                       advice);
  const grpc::Status newer = call(server, "/longreach.proto.Control/Leap", "longreach/9.1");
  EXPECT_EQ(newer.error_message(), "the slave is of version " + own +
                                       " and does not have the call Leap of this "
                                       "client, which is of version 9.1" +
                                       advice);
  const grpc::Status long_name =
      call(server, "/longreach.proto.Control/" + std::string(3000, 'x'), "longreach/");
  EXPECT_EQ(long_name.error_code(), grpc::StatusCode::FAILED_PRECONDITION);
  EXPECT_LT(long_name.error_message().size(), 300U);
  EXPECT_TRUE(call(server, "/longreach.proto.Control/GetLink", user_agent()).ok());
}

}  // namespace
}  // namespace longreach::unknown_call_test
