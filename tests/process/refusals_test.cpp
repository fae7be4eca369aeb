// Who must not have the robot, with the real programs, while an operator is at work: refused, logged,
// harmless.
#include <grpcpp/grpcpp.h>

#include <csignal>
#include <optional>
#include <thread>

#include "common/core/random.hpp"
#include "common/rpc/rpc_channel.hpp"
#include "common/site/certificate.hpp"
#include "common/site/site.hpp"
#include "tests/process/datagram_tap.hpp"
#include "tests/process/load.hpp"
#include "tests/support/station.hpp"
#include "tests/unit/common/rpc/wrong_certificates.hpp"

namespace longreach::refusals_test {
namespace {

class Refusals : public Station {
 protected:
  [[nodiscard]] std::string slave_rpc() const { return "127.0.0.1:" + std::to_string(ports_.slave_rpc); }

  /// An operator is engaged, seen through the tap.
  void work() {
    if (!slave_program_) start_slave();
    start_master({"--operator", "none", "--engage", "--set", "link.slave=" + tap_.address()});
    ASSERT_TRUE(both_engaged()) << outputs();
    before_ = slave_.status().value();
    restarts_ = slave_.counter("peer_restarts");
    disturbance_.emplace(slave_, master_);
  }
  void expect_undisturbed() {
    // Time for any harm to show.
    const std::uint64_t heard = slave_.counter("accepted");
    ASSERT_TRUE(eventually([&] { return slave_.counter("accepted") > heard + 200; })) << outputs();
    const auto after = slave_.status();
    ASSERT_TRUE(after);
    EXPECT_EQ(after->state(), "Engaged") << outputs();
    EXPECT_EQ(after->engagement(), before_.engagement());
    EXPECT_EQ(after->lease(), before_.lease());
    EXPECT_EQ(master_.state(), "Engaged");
    EXPECT_EQ(slave_.counter("peer_restarts"), restarts_);
    disturbance_->expect_none("refused");
    ASSERT_EQ(after->tool_m_size(), 3);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(after->tool_m(i), before_.tool_m(i), 1e-4);
  }
  [[nodiscard]] std::uint64_t session() const {
    const auto first = tap_.recorded(Toward::kSlave).back();
    std::uint64_t number = 0;
    for (std::size_t i = 2; i < 10; ++i) number = number << 8U | first[i];
    return number;
  }

  DatagramTap tap_{ports_.link};
  proto::Status before_;
  std::uint64_t restarts_ = 0;
  std::optional<Disturbance> disturbance_;
};

grpc::Status call(const std::string& address, const RpcSecurity& security, const auto& make) {
  const auto stub = proto::Control::NewStub(connect_rpc(address, RpcRole::kSlave, security));
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(20));
  return make(*stub, context);
}

grpc::Status open_session(const std::string& address, const RpcSecurity& security, std::uint64_t number,
                          bool take, proto::OpenSessionResponse& answer) {
  return call(address, security, [&](proto::Control::Stub& stub, grpc::ClientContext& context) {
    proto::OpenSessionRequest request;
    request.set_session(number);
    request.set_take(take);
    return stub.OpenSession(&context, request, &answer);
  });
}

TEST_F(Refusals, ASecondMaster) {
  work();
  const RunningProgram second(
      "longreach-master", {"--set", "link.slave=" + link_address(), "--set", "link.slave_rpc=" + slave_rpc(),
                           "--set", "link.listen=127.0.0.1:0", "--set", "rpc.listen=127.0.0.1:0", "--view",
                           "plain", "--operator", "none", "--engage"});
  ASSERT_TRUE(says(second, "another master has control of the robot")) << second.output();
  EXPECT_TRUE(says(*slave_program_, "lease refused=127.0.0.1:")) << outputs();
  expect_undisturbed();
}

TEST_F(Refusals, EveryWrongCertificate) {
  work();
  const Certificate authority = site_authority(default_site());
  for (const auto& [kind, security] : wrong_certificates(authority, "master.longreach")) {
    SCOPED_TRACE(kind);
    const std::uint64_t refused = slave_.counter("rpc_refused");
    proto::OpenSessionResponse answer;
    const grpc::Status status = open_session(slave_rpc(), security, 0, true, answer);
    EXPECT_FALSE(status.ok());
    EXPECT_FALSE(answer.has_secret());
    EXPECT_TRUE(eventually([&] { return slave_.counter("rpc_refused") > refused; }));
  }
  EXPECT_TRUE(says(*slave_program_, "rpc refused=connection because=\"certificate verify failed\""))
      << outputs();
  expect_undisturbed();
}

TEST_F(Refusals, AStolenSessionNumberWithoutItsKey) {
  work();
  Random random(7);
  const auto genuine = tap_.recorded(Toward::kSlave).back();
  const std::uint64_t before = slave_.counter("rejected_authentication");
  for (int i = 0; i < 1000; ++i) {
    DatagramTap::Datagram forged = genuine;
    forged[10] = 0;  // a sequence far ahead of the genuine ones
    forged[11] = 1;
    for (std::size_t k = 14; k < forged.size(); ++k) forged[k] = static_cast<unsigned char>(random.next());
    tap_.play(Toward::kSlave, forged);
    if (i % 20 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_TRUE(eventually([&] { return slave_.counter("rejected_authentication") == before + 1000; }))
      << slave_.counter("rejected_authentication") - before;
  expect_undisturbed();
}

TEST_F(Refusals, AStolenSessionNumberUnderAClientsCertificate) {
  work();
  for (const bool take : {false, true}) {
    proto::OpenSessionResponse answer;
    EXPECT_EQ(open_session(slave_rpc(), test_site(RpcRole::kClient), session(), take, answer).error_code(),
              grpc::StatusCode::PERMISSION_DENIED);
    EXPECT_FALSE(answer.has_secret());
  }
  const auto close = [this](proto::Control::Stub& stub, grpc::ClientContext& context) {
    proto::CloseSessionRequest request;
    request.set_session(session());
    proto::Outcome answer;
    return stub.CloseSession(&context, request, &answer);
  };
  EXPECT_EQ(call(slave_rpc(), test_site(RpcRole::kClient), close).error_code(),
            grpc::StatusCode::PERMISSION_DENIED);
  const std::string fingerprint =
      longreach::fingerprint(site_credentials(default_site(), RpcRole::kClient).certificate);
  EXPECT_TRUE(says(*slave_program_, "role=client.longreach certificate=" + fingerprint + " because="))
      << outputs();
  EXPECT_TRUE(says(*slave_program_, "rpc refused=127.0.0.1:")) << outputs();
  EXPECT_TRUE(says(*slave_program_, "because=\"only a master of this site may open a session\""))
      << outputs();
  // Not even a master is told the secret of a session that it names.
  proto::OpenSessionResponse kept;
  EXPECT_TRUE(open_session(slave_rpc(), test_site(RpcRole::kMaster), session(), false, kept).ok());
  EXPECT_FALSE(kept.has_secret());
  expect_undisturbed();
}

TEST_F(Refusals, AReplayOfYesterdaysSessionAndOfTodays) {
  work();
  ASSERT_TRUE(eventually([this] {
    return tap_.recorded(Toward::kSlave).size() > 300 && tap_.recorded(Toward::kMaster).size() > 50;
  }));
  master_program_->signal(SIGTERM);
  ASSERT_EQ(master_program_->wait(std::chrono::seconds(20)), 0) << outputs();
  const auto up = tap_.recorded(Toward::kSlave), down = tap_.recorded(Toward::kMaster);
  work();
  const auto today = tap_.recorded(Toward::kSlave);
  const std::uint64_t slave_session = slave_.counter("rejected_session"),
                      master_session = master_.counter("rejected_session"),
                      slave_replay = slave_.counter("rejected_replay");
  const auto play = [this](Toward way, const std::vector<DatagramTap::Datagram>& all, std::size_t from) {
    for (std::size_t i = from; i < all.size(); ++i) {
      tap_.play(way, all[i]);
      if (i % 20 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  };
  play(Toward::kSlave, up, 0);
  play(Toward::kMaster, down, 0);
  play(Toward::kSlave, today, up.size());
  EXPECT_TRUE(eventually([&] {
    return slave_.counter("rejected_session") == slave_session + up.size() &&
           master_.counter("rejected_session") == master_session + down.size() &&
           slave_.counter("rejected_replay") == slave_replay + today.size() - up.size();
  })) << slave_.counter("rejected_session") - slave_session
      << " of " << up.size() << ", " << master_.counter("rejected_session") - master_session << " of "
      << down.size() << ", " << slave_.counter("rejected_replay") - slave_replay << " of "
      << today.size() - up.size();
  expect_undisturbed();
}

}  // namespace
}  // namespace longreach::refusals_test
