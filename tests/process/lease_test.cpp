// One robot, two masters: the lease is acquired, taken, returned; the robot holds in between. The refusal of
// a second master: refusals_test.cpp.
#include <csignal>

#include "tests/support/station.hpp"

namespace longreach::lease_test {
namespace {

class Lease : public Station {
 protected:
  /// As start_master, with a port of its own for RPC.
  std::unique_ptr<RunningProgram> start_second(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {
        "--set",      "link.slave=" + link_address(),
        "--set",      "link.slave_rpc=127.0.0.1:" + std::to_string(ports_.slave_rpc),
        "--set",      "link.listen=127.0.0.1:0",
        "--set",      "rpc.listen=127.0.0.1:0",
        "--view",     "plain",
        "--operator", "none"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return std::make_unique<RunningProgram>("longreach-master", arguments);
  }
  std::string lease() {
    const auto status = slave_.status();
    return status ? status->lease() : "unreachable";
  }
};

TEST_F(Lease, PassesToTheNextWhenTheFirstReturnsIt) {
  start_slave();
  start_master({"--operator", "none", "--engage"});
  ASSERT_TRUE(both_engaged()) << outputs();
  const std::string first = lease();
  EXPECT_EQ(first.find("127.0.0.1:"), 0U) << first;
  const auto second = start_second({"--engage"});
  ASSERT_TRUE(says(*second, "another master has control of the robot (" + first + ")")) << second->output();
  master_program_->signal(SIGTERM);
  EXPECT_TRUE(eventually([&] { return slave_.counter("peer_restarts") == 1 && slave_.state() == "Engaged"; }))
      << second->output();
  EXPECT_NE(lease(), first);
}

TEST_F(Lease, IsTakenAndTheRobbedMasterKnowsByWhomAndWaits) {
  start_slave();
  start_master({"--operator", "none", "--engage"});
  ASSERT_TRUE(both_engaged()) << outputs();
  auto second = start_second({"--take"});
  ASSERT_TRUE(eventually([this] { return slave_.state() == "Holding"; })) << outputs() << second->output();
  EXPECT_EQ(slave_.status()->cause(), "preempted");
  ASSERT_TRUE(eventually([this] { return master_.status()->cause() == "preempted"; })) << outputs();
  const std::string holder = lease();
  EXPECT_EQ(master_.status()->lease(), holder);
  EXPECT_EQ(master_.status()->state(), "Holding");
  const std::string said = "another master (" + holder + ") took control of the robot";
  EXPECT_NE(master_.status()->trouble().find(said), std::string::npos) << master_.status()->trouble();
  EXPECT_TRUE(says(*master_program_, said)) << outputs();
  EXPECT_NE(master_.engage().find(said), std::string::npos) << "it is told so, too, and does not rob back";
  // A client of the site may look, as here, and stop, whoever has the robot.
  EXPECT_EQ(slave_.stop(), "");
  EXPECT_TRUE(eventually([this] { return slave_.state() == "Stopped"; }));
  EXPECT_EQ(lease(), holder);
  // When the other one returns it, the first has it again, and moves it when a person engages.
  second->signal(SIGTERM);
  ASSERT_TRUE(eventually([&] {
    return lease() != holder && lease() != "" && master_.status()->trouble().empty();
  })) << outputs();
  EXPECT_NE(slave_.state(), "Engaged");
  EXPECT_TRUE(engaged()) << outputs();
}

TEST_F(Lease, IsReturnedByAMasterThatEnds) {
  start_slave();
  start_master({"--operator", "none", "--engage"});
  ASSERT_TRUE(both_engaged()) << outputs();
  master_program_->signal(SIGINT);
  ASSERT_EQ(master_program_->wait(std::chrono::seconds(20)), 0) << outputs();
  EXPECT_TRUE(eventually([this] { return lease() == "" && slave_.state() == "Holding"; })) << outputs();
  EXPECT_TRUE(says(*slave_program_, "lease returned")) << outputs();
}

}  // namespace
}  // namespace longreach::lease_test
