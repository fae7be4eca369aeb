// The real programs on loopback: the loop closes, each side notices the other's end, and nothing moves by
// itself.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <thread>

#include "common/core/random.hpp"
#include "tests/process/load.hpp"
#include "tests/support/station.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::loop_test {
namespace {

std::vector<double> tool(StationSide& slave) {
  const auto status = slave.status();
  return status ? std::vector<double>(status->tool_m().begin(), status->tool_m().end())
                : std::vector<double>{};
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != 3 || b.size() != 3) return INFINITY;
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

TEST_F(Station, TheHandFeelsTheWall) {
  start_slave({"--set", "scene.material.wall.stiffness_n_per_m=2000"});
  start_master({"--operator", "script", "--engage"});
  ASSERT_TRUE(both_engaged()) << outputs();
  const auto felt = [this] {
    const auto status = master_.status();
    return status && status->in_contact() && status->force_n() > 1.0 &&
           status->stiffness_n_per_m() > 1600.0 && status->stiffness_n_per_m() < 2400.0;
  };
  EXPECT_TRUE(eventually(felt, std::chrono::seconds(120))) << outputs();
  EXPECT_EQ(slave_.counter("limit_violations"), 0u);
}

TEST_F(Station, RobotHoldsAfterMasterDiesUntilEngagedAgain) {
  start_slave();
  start_master({"--operator", "script", "--engage"});
  ASSERT_TRUE(both_engaged()) << outputs();
  master_program_->signal(SIGKILL);
  ASSERT_EQ(master_program_->wait(std::chrono::seconds(10)), 128 + SIGKILL);
  ASSERT_TRUE(eventually([this] { return slave_.state() == "Holding"; })) << outputs();
  EXPECT_EQ(slave_.status()->cause(), "link silent");

  // It comes to rest, and a new master alone does not move it.
  std::vector<double> rest = tool(slave_);
  ASSERT_TRUE(eventually([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    const auto now = tool(slave_);
    return distance(std::exchange(rest, now), now) < 1e-5;
  }));
  start_master({"--operator", "script"});
  ASSERT_TRUE(eventually([this] { return master_.counter("reports") + master_.counter("accepted") > 50; }))
      << outputs();
  for (int i = 0; i < 20; ++i) {
    ASSERT_NE(slave_.state(), "Engaged");
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  EXPECT_LT(distance(tool(slave_), rest), 1e-4);
  EXPECT_EQ(master_.engage(), "");
  EXPECT_TRUE(both_engaged()) << outputs();
}

TEST_F(Station, ReconnectsToRestartedSlaveWithoutEngaging) {
  start_slave();
  start_master({"--operator", "script", "--engage"});
  ASSERT_TRUE(both_engaged()) << outputs();
  slave_program_->signal(SIGKILL);
  ASSERT_EQ(slave_program_->wait(std::chrono::seconds(10)), 128 + SIGKILL);
  ASSERT_TRUE(eventually([this] { return master_.state() == "Holding"; })) << outputs();
  EXPECT_EQ(master_.status()->cause(), "link silent");
  EXPECT_NE(master_.engage(), "");  // nobody there: refused with a sentence

  start_slave();
  ASSERT_TRUE(eventually([this] {
    return slave_.state() == "Observing" && master_.counter("peer_restarts") == 1;
  })) << outputs();
  const auto rest = tool(slave_);
  for (int i = 0; i < 20; ++i) {
    ASSERT_EQ(slave_.state(), "Observing");
    ASSERT_NE(master_.state(), "Engaged");
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  EXPECT_LT(distance(tool(slave_), rest), 1e-6);
  EXPECT_EQ(master_.engage(), "");
  EXPECT_TRUE(both_engaged()) << outputs();
}

TEST_F(Station, GarbageOverTheSocketChangesNothing) {
  start_slave();
  start_master({"--operator", "none", "--engage"});
  ASSERT_TRUE(both_engaged()) << outputs();
  const auto before = slave_.status();
  ASSERT_TRUE(before);
  const int garbage = ::socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(ports_.link));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  Random random(5);
  std::vector<unsigned char> bytes(65507);
  for (auto& b : bytes) b = static_cast<unsigned char>(random.next());
  for (std::size_t i = 0; i < 3000; ++i) {
    const std::size_t size = i % 100 == 0 ? bytes.size() : i % 600;
    bytes[0] = i % 2 == 0 ? 2 : bytes[1];  // half of them with the right version
    ::sendto(garbage, bytes.data() + (i % 2) * (i % 7), size - std::min<std::size_t>(size, 7), 0,
             reinterpret_cast<sockaddr*>(&address), sizeof address);
    if (i % 20 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ::close(garbage);
  EXPECT_TRUE(eventually([this] { return slave_.counter("rejected") >= 2000; }))
      << slave_.counter("rejected");
  const auto after = slave_.status();
  ASSERT_TRUE(after);
  EXPECT_EQ(after->state(), "Engaged");
  EXPECT_EQ(after->engagement(), before->engagement());
  EXPECT_EQ(slave_.counter("peer_restarts"), 0u);
  EXPECT_LT(distance(tool(slave_), {before->tool_m().begin(), before->tool_m().end()}), 1e-4);
  const auto heard = master_.counter("accepted");  // the slave still answers the master
  EXPECT_TRUE(eventually([&] { return master_.counter("accepted") > heard + 20; }));
  EXPECT_EQ(master_.state(), "Engaged");
}

TEST_F(Station, AMasterWithoutASlaveSaysWhereItLooksAndWhatToDo) {
  start_master({"--operator", "none", "--engage"});
  const std::string said = "no session with the slave at 127.0.0.1:" + std::to_string(ports_.slave_rpc) +
                           ": no program is listening there; start longreach-slave there";
  ASSERT_TRUE(says(*master_program_, said)) << outputs();
  start_slave();
  EXPECT_TRUE(both_engaged()) << outputs();
}

TEST_F(Station, AMasterOfAnotherSiteGetsNothing) {
  start_slave();
  ASSERT_TRUE(eventually([this] { return slave_.state() == "Idle"; })) << outputs();
  const TemporaryFolder elsewhere;
  start_master({"--operator", "none", "--engage", "--site", (elsewhere.path() / "site").string()});
  ASSERT_TRUE(says(*master_program_, "its certificate is not valid for this site")) << outputs();
  EXPECT_EQ(slave_.state(), "Idle");
  EXPECT_EQ(slave_.counter("accepted"), 0u);
  // In clear it gets nothing, either.
  start_master({"--operator", "none", "--engage", "--insecure"});
  ASSERT_TRUE(says(*master_program_, "no session")) << outputs();
  EXPECT_TRUE(says(*master_program_, "INSECURE")) << outputs();
  EXPECT_EQ(slave_.state(), "Idle");
  start_master({"--operator", "none", "--engage"});
  EXPECT_TRUE(both_engaged()) << outputs();
}

TEST_F(Station, ElevenHundredIdleConnectionsDisturbNothing) {
  // The programs begin with the usual 1024 descriptors, the test has more.
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &limit), 0);
  const rlimit usual{std::min<rlim_t>(1024, limit.rlim_max), limit.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &usual), 0);
  start_slave();
  start_master({"--operator", "none", "--engage"});
  ASSERT_TRUE(both_engaged()) << outputs();
  Disturbance disturbance(slave_, master_);
  limit.rlim_cur = limit.rlim_max;
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &limit), 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(ports_.slave_rpc));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  std::vector<int> idle;
  for (int i = 0; i < 1100; ++i) {
    idle.push_back(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    ASSERT_EQ(::connect(idle.back(), reinterpret_cast<sockaddr*>(&address), sizeof address), 0) << i;
  }
  // Known connections and new ones are served.
  EXPECT_EQ(slave_.state(), "Engaged");
  EXPECT_TRUE(
      eventually([this] { return StationSide(RpcRole::kSlave, ports_.slave_rpc).state() == "Engaged"; }));
  for (const int one : idle) ::close(one);
  disturbance.expect_none("1100 connections");
  EXPECT_EQ(master_.state(), "Engaged");
}

TEST_F(Station, StopsFromEitherSideAndChangesWhatMayChange) {
  start_slave();
  start_master({"--operator", "none", "--engage"});
  ASSERT_TRUE(both_engaged()) << outputs();
  EXPECT_NE(slave_.set("command.force_guard_n", "10").find("command.force_guard_n"), std::string::npos);
  EXPECT_NE(slave_.engage(), "");
  EXPECT_EQ(slave_.stop(), "");
  ASSERT_TRUE(eventually([this] { return slave_.state() == "Stopped" && master_.state() == "Stopped"; }))
      << outputs();
  EXPECT_EQ(slave_.set("command.force_guard_n", "10"), "");
  EXPECT_NE(slave_.set("command.force_guard_n", "1000"), "");  // tightened only
  EXPECT_NE(slave_.set("command.force_guard_n", "nan"), "");
  EXPECT_NE(slave_.set("loop.rate_hz", "500").find("restart"), std::string::npos);
  EXPECT_EQ(master_.engage(), "");
  ASSERT_TRUE(both_engaged()) << outputs();
  EXPECT_EQ(master_.stop(), "");
  EXPECT_TRUE(eventually([this] { return slave_.state() == "Stopped"; })) << outputs();
}

TEST_F(Station, TheDelayChangesLive) {
  start_slave();
  start_master({"--operator", "none", "--engage"});
  ASSERT_TRUE(both_engaged()) << outputs();
  EXPECT_EQ(slave_.set_delay(0.3), "");
  EXPECT_EQ(master_.set_delay(0.2), "");
  EXPECT_TRUE(eventually([this] {
    const auto status = master_.status();
    return status && status->link().rtt_known() && status->link().rtt_s() > 0.5 &&
           status->link().rtt_s() < 0.7;
  })) << outputs();
}

TEST_F(Station, EndsCleanlyWhenAsked) {
  start_slave();
  start_master({"--operator", "none"});
  ASSERT_TRUE(eventually([this] { return master_.counter("accepted") > 0; })) << outputs();
  master_program_->signal(SIGINT);
  slave_program_->signal(SIGTERM);
  EXPECT_EQ(master_program_->wait(std::chrono::seconds(20)), 0) << outputs();
  EXPECT_EQ(slave_program_->wait(std::chrono::seconds(20)), 0) << outputs();
}

}  // namespace
}  // namespace longreach::loop_test
