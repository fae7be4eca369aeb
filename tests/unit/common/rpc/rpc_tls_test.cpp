// Who is let in by mutual TLS, and who is not.
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <thread>

#include "common/rpc/rpc_channel.hpp"
#include "common/rpc/rpc_refusals.hpp"
#include "common/rpc/rpc_server.hpp"
#include "common/site/certificate.hpp"
#include "proto/control.grpc.pb.h"
#include "tests/unit/common/rpc/control_fake_backend.hpp"
#include "tests/unit/common/rpc/wrong_certificates.hpp"

namespace longreach::rpc_tls_test {
namespace {

const std::string kAnyPort = "127.0.0.1:0";

std::string name(RpcRole role) { return std::string(name_of(role)); }

RpcSecurity with(const Certificate& authority, const Certificate& own) {
  return {RpcCredentials{authority.certificate_pem, own.certificate_pem, own.key_pem}};
}

/// A site, and a slave of it that serves.
struct Served {
  Certificate authority = make_authority("one site");
  Certificate other = make_authority("another site");
  RpcSecurity slave =
      with(authority, issue(authority, {.name = name(RpcRole::kSlave), .use = CertificateUse::kServer}));
  FakeBackend backend{"slave"};
  RpcServer server{kAnyPort, backend, "slave", slave};

  [[nodiscard]] RpcSecurity client(const CertificateTerms& terms) const {
    return with(authority, issue(authority, terms));
  }

  /// Code of a call that changes something, by who holds `security`.
  grpc::StatusCode stop(const RpcSecurity& security, RpcRole side = RpcRole::kSlave) const {
    const auto stub = proto::Control::NewStub(connect_rpc(server.address(), side, security));
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(20));
    proto::Outcome outcome;
    const grpc::Status status = stub->Stop(&context, {}, &outcome);
    EXPECT_TRUE(status.ok() || connect_failure(status) != ConnectFailure::kOther || other_role(status))
        << status.error_message();
    return status.error_code();
  }
  grpc::StatusCode close_session(const RpcSecurity& security) const {
    const auto stub = proto::Control::NewStub(connect_rpc(server.address(), RpcRole::kSlave, security));
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(20));
    proto::Outcome answer;
    return stub->CloseSession(&context, {}, &answer).error_code();
  }
  grpc::StatusCode open_session(const RpcSecurity& security) const {
    const auto stub = proto::Control::NewStub(connect_rpc(server.address(), RpcRole::kSlave, security));
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(20));
    proto::OpenSessionResponse answer;
    return stub->OpenSession(&context, {}, &answer).error_code();
  }
};

TEST(RpcTls, EveryRoleOfTheSiteMayStopAndAMasterAloneOpensSessions) {
  Served served;
  const RpcSecurity master = served.client({.name = name(RpcRole::kMaster)});
  const RpcSecurity client = served.client({.name = name(RpcRole::kClient), .use = CertificateUse::kClient});
  EXPECT_EQ(served.stop(master), grpc::StatusCode::OK);
  EXPECT_EQ(served.stop(client), grpc::StatusCode::OK);
  EXPECT_EQ(served.open_session(client), grpc::StatusCode::PERMISSION_DENIED);
  EXPECT_EQ(served.close_session(client), grpc::StatusCode::PERMISSION_DENIED);
  EXPECT_EQ(served.backend.calls(), (std::vector<std::string>{"stop", "stop"}));
  EXPECT_EQ(served.open_session(master), grpc::StatusCode::OK);
}

TEST(RpcTls, AWrongCertificateIsRefusedCountedAndHarmless) {
  Served served;
  const std::string client = name(RpcRole::kClient);
  for (const auto& [kind, security] : wrong_certificates(served.authority, client)) {
    const std::uint64_t before = rpc_refusals();
    EXPECT_NE(served.stop(security), grpc::StatusCode::OK) << kind;
    // The server notes it in a thread of its own.
    for (int i = 0; i < 1000 && rpc_refusals() == before; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_GT(rpc_refusals(), before) << kind << ": the server has seen and refused it";
  }
  EXPECT_TRUE(served.backend.calls().empty());
  const std::uint64_t before = rpc_refusals();
  EXPECT_EQ(served.stop(served.client({.name = client})), grpc::StatusCode::OK)
      << "and the right one still is";
  EXPECT_EQ(rpc_refusals(), before);
}

TEST(RpcTls, AClientTalksToNobodyButTheSideThatItMeans) {
  Served served;
  const RpcSecurity good = served.client({.name = name(RpcRole::kClient)});
  EXPECT_NE(served.stop(good, RpcRole::kMaster), grpc::StatusCode::OK) << "another role of the same site";
  const Certificate own = issue(served.authority, {.name = name(RpcRole::kClient)});
  EXPECT_NE(served.stop(with(served.other, own)), grpc::StatusCode::OK) << "a slave of another site";
  EXPECT_TRUE(served.backend.calls().empty());
}

TEST(RpcTls, AServerWithAnOldCertificateIsNotTrusted) {
  Served served;
  const Certificate old =
      issue(served.authority, {.name = name(RpcRole::kSlave), .not_after = "20010101000000Z"});
  FakeBackend backend("slave");
  const RpcServer server(kAnyPort, backend, "slave", with(served.authority, old));
  const auto stub = proto::Control::NewStub(
      connect_rpc(server.address(), RpcRole::kSlave, served.client({.name = name(RpcRole::kClient)})));
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(20));
  proto::Outcome outcome;
  EXPECT_EQ(connect_failure(stub->Stop(&context, {}, &outcome)), ConnectFailure::kMistrusted);
  EXPECT_TRUE(backend.calls().empty());
}

TEST(RpcTls, ClearTextStaysOnThisMachine) {
  FakeBackend backend("slave");
  for (const std::string open : {"0.0.0.0:0", "[::]:0", "192.0.2.1:0"}) {
    EXPECT_THROW(RpcServer(open, backend, "slave", {}), std::runtime_error) << open;
    EXPECT_THROW(connect_rpc(open, RpcRole::kSlave, {}), std::runtime_error) << open;
  }
  for (const std::string local : {"127.0.0.1:1", "127.8.9.1:1", "localhost:1", "[::1]:1"})
    EXPECT_TRUE(is_loopback(local)) << local;
  for (const std::string far : {"robot:1", "127.0.0.1.example:1", "10.0.0.1:1", "::1", ""})
    EXPECT_FALSE(is_loopback(far)) << far;
}

}  // namespace
}  // namespace longreach::rpc_tls_test
