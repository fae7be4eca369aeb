// One of the real programs is killed in contact, and the other one does what it must; engagements without a
// step. LONGREACH_FULL: 100 times each.
#include <cmath>
#include <csignal>
#include <thread>

#include "deploy/lab/campaign_size.hpp"
#include "tests/support/station.hpp"

namespace longreach::safety_test {
namespace {

using std::chrono::milliseconds;

constexpr double kNoise_n = 0.3;  // six standard deviations of the force sensor

class SafetyOfPrograms : public Station {
 protected:
  /// The script presses against a wall that is near.
  void press() {
    master_program_.reset();
    slave_program_.reset();  // its ports are used again
    start_slave({"--set", "scene.material.wall.stiffness_n_per_m=2000", "--set",
                 "scene.surface.wall.plane.point_m=0.01,0,0", "--set", "command.hold_force_n=1"});
    start_master({"--operator", "script", "--engage", "--set", "operator.rate_distance_m=0", "--set",
                  "operator.approach_speed_m_per_s=0.01", "--set", "operator.probe_n=0"});
    ASSERT_TRUE(both_engaged()) << outputs();
    int steady = 0;
    ASSERT_TRUE(eventually([this, &steady] {
      const auto far = slave_.status(), near = master_.status();
      const bool presses = far && near && far->in_contact() && far->force_n() > 1.5 && near->force_n() > 0.5;
      steady = presses ? steady + 1 : 0;
      return steady == 10;
    })) << outputs();
  }
};

TEST_F(SafetyOfPrograms, AMasterKilledInContactLeavesTheHoldForceAndTheContact) {
  for (int i = 0; i < campaign(100, 3); ++i) {
    press();
    if (HasFatalFailure()) return;
    const std::uint64_t touches = slave_.counter("touches");
    master_program_->signal(SIGKILL);
    ASSERT_EQ(master_program_->wait(std::chrono::seconds(10)), 128 + SIGKILL);
    ASSERT_TRUE(eventually([this] { return slave_.state() == "Holding"; })) << outputs();
    std::this_thread::sleep_for(milliseconds(1000));
    for (int k = 0; k < 10; ++k) {
      const auto now = slave_.status();
      ASSERT_TRUE(now) << outputs();
      EXPECT_EQ(now->state(), "Holding") << i;
      EXPECT_EQ(now->cause(), "link silent") << i;
      ASSERT_TRUE(now->in_contact()) << i << ", " << now->force_n() << " N" << outputs();
      EXPECT_LE(now->force_n(), 1.0 + kNoise_n) << i;
      EXPECT_GE(now->force_n(), 0.4) << i;
      std::this_thread::sleep_for(milliseconds(30));
    }
    EXPECT_EQ(slave_.counter("touches"), touches) << i;
    EXPECT_EQ(slave_.counter("limit_violations"), 0u) << i;
  }
}

TEST_F(SafetyOfPrograms, KilledSlaveInContactReleasesForceAndReportsCause) {
  for (int i = 0; i < campaign(100, 1); ++i) {
    press();
    if (HasFatalFailure()) return;
    slave_program_->signal(SIGKILL);
    ASSERT_EQ(slave_program_->wait(std::chrono::seconds(10)), 128 + SIGKILL);
    ASSERT_TRUE(eventually([this] { return master_.state() == "Holding"; })) << outputs();
    ASSERT_TRUE(eventually([this] {
      const auto now = master_.status();
      return now && now->stiffness_n_per_m() < 10.0 && now->force_n() < 0.2;
    })) << outputs();
    EXPECT_EQ(master_.status()->cause(), "link silent");
    EXPECT_TRUE(says(*master_program_, "to=Holding cause=\"link silent\"")) << outputs();
    EXPECT_NE(master_.engage(), "");
  }
}

TEST_F(SafetyOfPrograms, EngagedAgainAndAgainTheRobotIsCommandedNoStep) {
  start_slave({"--set", "scene_file=scenes/free.txtpb"});
  start_master({"--operator", "none"});
  ASSERT_TRUE(eventually([this] { return slave_.state() == "Observing"; })) << outputs();
  const auto at = [this] {
    const auto now = slave_.status();
    return now ? std::vector<double>(now->goal_m().begin(), now->goal_m().end())
               : std::vector<double>(3, NAN);
  };
  for (int i = 0; i < campaign(100, 5); ++i) {
    const std::vector<double> before = at();
    std::this_thread::sleep_for(milliseconds(i % 10 == 9 ? 1200 : 50));
    ASSERT_NE(slave_.state(), "Engaged") << i;
    ASSERT_EQ(master_.engage(), "") << i << outputs();
    ASSERT_TRUE(both_engaged()) << i << outputs();
    const std::vector<double> after = at();
    ASSERT_EQ(after.size(), 3u);
    EXPECT_LE(std::hypot(after[0] - before[0], after[1] - before[1], after[2] - before[2]), 1e-4) << i;
    EXPECT_EQ(slave_.status()->engagement(), static_cast<unsigned>(i) + 1);
    ASSERT_EQ(i % 2 == 0 ? master_.stop() : slave_.stop(), "");
    ASSERT_TRUE(eventually([this] { return slave_.state() == "Stopped" && master_.state() == "Stopped"; }))
        << i;
  }
}

TEST_F(SafetyOfPrograms, AGapTimerTooShortForTheMasterIsRefusedWithASentence) {
  start_slave({"--set", "safety.gap_s=0.04"});
  start_master({"--operator", "none", "--engage", "--set", "link.send_hz=50"});
  ASSERT_TRUE(says(*master_program_,
                   "safety.gap_s = 0.04 is less than three send periods of a master with link.send_hz = 50: "
                   "set it to at least 0.06 at the slave, or increase link.send_hz at the master"))
      << outputs();
  EXPECT_EQ(slave_.state(), "Idle");
  start_master({"--operator", "none", "--engage"});
  ASSERT_TRUE(both_engaged()) << outputs();
  EXPECT_EQ(slave_.stop(), "");
  EXPECT_NE(slave_.set("safety.gap_s", "0.05"), "");  // loosens
  EXPECT_EQ(slave_.set("safety.gap_s", "0.03"), "");
  EXPECT_NE(slave_.set("safety.age_max_s", "31").find("a client can only tighten this limit"),
            std::string::npos);
}

TEST_F(SafetyOfPrograms, ADeadMansSwitchRefusesToEngageWithoutAHand) {
  start_slave();
  start_master({"--operator", "none", "--set", "safety.presence=HOLD"});
  ASSERT_TRUE(eventually([this] { return slave_.state() == "Observing"; })) << outputs();
  // That no session could be opened at first is shown until the status loop has seen that there is one.
  ASSERT_TRUE(eventually([this] {
    const auto now = master_.status();
    return now && now->state() == "Observing" && now->trouble().empty();
  })) << outputs();
  EXPECT_NE(master_.engage().find("no hand is on the handle"), std::string::npos);
  EXPECT_EQ(slave_.state(), "Observing");
}

}  // namespace
}  // namespace longreach::safety_test
