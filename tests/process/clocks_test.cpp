// Real programs that stand still: SIGSTOP and SIGCONT of either or both, free and in contact, with a black
// box between the slave and its robot. LONGREACH_FULL: 60 freezes of 10 ms to 60 s.
#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <optional>
#include <thread>

#include "common/core/random.hpp"
#include "deploy/lab/campaign_size.hpp"
#include "tests/process/robot_box.hpp"
#include "tests/support/station.hpp"

namespace longreach::clocks_test {
namespace {

// Of robots/cartesian.txtpb.
constexpr double kPeriod_s = 1e-3, kSpeed_m_per_s = 0.5, kAcceleration_m_per_s2 = 2.5,
                 kJerk_m_per_s3 = 1250.0;

/// Largest differences of setpoints that follow each other, as multiples of the limits.
struct Differences {
  double speed = 0.0, acceleration = 0.0, jerk = 0.0;
  double first_m = 0.0;  // of a first live one after others, from the tool
  std::size_t setpoints = 0;
};

Differences differences(const std::vector<ReportedSetpoint>& reported) {
  Differences worst;
  std::array<std::array<double, 3>, 4> x{};  // the newest first
  std::uint64_t last = 0;
  int run = 0;  // live setpoints in a row
  bool live = true;
  for (const ReportedSetpoint& t : reported) {
    if (t.live && !live) worst.first_m = std::max(worst.first_m, t.off);
    live = t.live;
    run = t.live ? (t.sequence == last + 1 ? run + 1 : 1) : 0;
    last = t.sequence;
    std::rotate(x.begin(), x.end() - 1, x.end());
    x[0] = t.joint;
    if (run < 4) continue;
    ++worst.setpoints;
    for (std::size_t i = 0; i < 3; ++i) {
      const double v = x[0][i] - x[1][i], before = x[1][i] - x[2][i], a = v - before;
      const double j = a - (before - (x[2][i] - x[3][i]));
      worst.speed = std::max(worst.speed, std::abs(v) / kPeriod_s / kSpeed_m_per_s);
      worst.acceleration =
          std::max(worst.acceleration, std::abs(a) / std::pow(kPeriod_s, 2) / kAcceleration_m_per_s2);
      worst.jerk = std::max(worst.jerk, std::abs(j) / std::pow(kPeriod_s, 3) / kJerk_m_per_s3);
    }
  }
  return worst;
}

struct Freeze {
  bool slave, master, contact;
  double seconds;
};

std::ostream& operator<<(std::ostream& out, const Freeze& f) {
  return out << (f.slave ? "slave " : "") << (f.master ? "master " : "") << f.seconds << " s"
             << (f.contact ? ", in contact" : ", free");
}

class ClocksOfPrograms : public Station {
 protected:
  /// The script moves, or presses against the wall of the reference robot.
  void start(bool contact) {
    master_program_.reset();
    slave_program_.reset();
    robot_ = std::make_unique<RobotBox>();
    if (contact) robot_->wall(0.01);
    start_slave({"--adapter", robot_->address(), "--set", "robot_file=robots/cartesian.txtpb", "--set",
                 "robot_adapter.silence_s=0.5"});
    start_master({"--operator", "script", "--set",
                  std::string("operator.rate_distance_m=") + (contact ? "0" : "0.8"), "--set",
                  "operator.approach_speed_m_per_s=0.01", "--set", "operator.probe_n=0"});
    ASSERT_TRUE(engaged()) << outputs();
    const double from_m = tool_m();
    ASSERT_TRUE(eventually([&] {
      const auto far = slave_.status();
      return far && (contact ? far->in_contact() && far->force_n() > 1.0 : tool_m() > from_m + 0.02);
    })) << outputs();
  }
  double tool_m() {
    const auto now = slave_.status();
    return now && !now->tool_m().empty() ? now->tool_m(0) : NAN;
  }
  void stand_still(const Freeze& f) {
    if (f.slave) slave_program_->signal(SIGSTOP);
    if (f.master) master_program_->signal(SIGSTOP);
    std::this_thread::sleep_for(std::chrono::duration<double>(f.seconds));
    if (f.slave) slave_program_->signal(SIGCONT);
    if (f.master) master_program_->signal(SIGCONT);
  }
  void expect_no_way_back(const Freeze& f, std::uint32_t engagement) {
    ASSERT_TRUE(eventually([this] { return slave_.state() == "Holding"; })) << f << outputs();
    for (int i = 0; i < 20; ++i) {
      EXPECT_NE(slave_.state(), "Engaged") << f << outputs();
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    EXPECT_EQ(slave_.status()->engagement(), engagement) << f;
    ASSERT_TRUE(engaged()) << f << outputs();
  }

  std::unique_ptr<RobotBox> robot_;
};

TEST_F(ClocksOfPrograms, StandStillHoldAndDoNotGoOnByThemselves) {
  std::vector<Freeze> freezes{{true, true, false, 3.0}, {true, false, false, 1.4}, {true, false, true, 0.3}};
  Random random(4);
  for (int i = 0; i < campaign(60, 0); ++i)
    freezes.push_back(
        {i % 3 != 1, i % 3 != 0, random.chance(0.5), 0.01 * std::pow(6000.0, random.uniform())});
  Differences worst;
  for (const Freeze& f : freezes) {
    start(f.contact);
    if (HasFatalFailure()) return;
    const std::uint32_t engagement = slave_.status()->engagement();
    stand_still(f);
    if (f.seconds > 1.2) expect_no_way_back(f, engagement);
    if (HasFatalFailure()) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    const Differences seen = differences(robot_->setpoints());
    worst.speed = std::max(worst.speed, seen.speed);
    worst.acceleration = std::max(worst.acceleration, seen.acceleration);
    worst.jerk = std::max(worst.jerk, seen.jerk);
    worst.setpoints += seen.setpoints;
    worst.first_m = std::max(worst.first_m, seen.first_m);
  }
  std::printf(
      "%zu freezes, %zu setpoints; of the limits: speed %.3f, acceleration %.3f, jerk %.3f; first ones %.1e "
      "m off the tool\n",
      freezes.size(), worst.setpoints, worst.speed, worst.acceleration, worst.jerk, worst.first_m);
  EXPECT_LE(worst.first_m, 1e-4);
  EXPECT_GT(worst.setpoints, 1000U);
  EXPECT_LE(worst.speed, 1.0 + 1e-6);
  EXPECT_LE(worst.acceleration, 1.0 + 1e-6);
  EXPECT_LE(worst.jerk, 1.0 + 1e-3);
}

TEST_F(ClocksOfPrograms, AnImpatientClientEngagesOnce) {
  start_slave({"--set", "link.impairment.delay_s=0.6"});
  start_master({"--operator", "none", "--set", "link.impairment.delay_s=0.6"});
  ASSERT_TRUE(eventually([this] { return master_.engage().empty(); })) << outputs();
  ASSERT_TRUE(eventually([this] {
    return master_.engage().empty() && slave_.state() == "Engaged" && master_.state() == "Engaged";
  })) << outputs();
  for (int i = 0; i < 5; ++i) EXPECT_EQ(master_.engage(), "");
  EXPECT_EQ(slave_.status()->engagement(), 1U);
  EXPECT_EQ(master_.state(), "Engaged");
}

}  // namespace
}  // namespace longreach::clocks_test
