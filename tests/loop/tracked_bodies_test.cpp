// The poses of free bodies that the master shows are those of one delay ago, while the bodies drift, and while one is
// dragged; what the datagrams cost the link.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "common/config/config.hpp"
#include "common/link/byte_budget.hpp"
#include "common/recording/mcap_reader.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/laboratory.hpp"
#include "deploy/lab/recording/replay.hpp"
#include "slave/simulation/scene/bodies.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::tracked_bodies_test {
namespace {

constexpr double kNear_m = 0.005;
// Position of the spacecraft in dock.xml, relative to the start of the tool.
const Vector3 kSpacecraft{0.9, 0.1, 0.05};

std::vector<std::string> dock_over(const std::string& profile, std::vector<std::string> more = {}) {
  more.insert(more.begin(), {"profile=" + profile, "scene_file=scenes/dock.txtpb", "mapping.mode=POSITION",
                             "mapping.scale=1", "safety.engage_at_start=true"});
  return more;
}

/// A laboratory that compares in every tick what the master shows with what was true one delay ago.
class Watched {
 public:
  explicit Watched(const std::vector<std::string>& settings)
      : config_(configure(settings, LONGREACH_DEPLOY)),
        delay_s_(config_.master().link().impairment().delay_s()),
        lab(to_struct(config_.master()), to_struct(config_.slave()), 3) {
    lab.drive({});  // instead of the script
  }

  void step() {
    lab.step();
    truth_.push_back(true_pose());
    const auto& shown = lab.master().bodies.body[0];
    if (!shown) return;
    ++shown_;
    const auto ago = static_cast<std::size_t>(std::llround(delay_s_ / lab.period_s()));
    const Pose& was = truth_[truth_.size() > ago ? truth_.size() - 1 - ago : 0];
    off_m = std::max(off_m, (shown->X_WB.p - was.p).norm());
    off_rad = std::max(off_rad, log_rotation(shown->X_WB.q * was.q.conjugate()).norm());
    age_max_s = std::max(age_max_s, shown->age_s);
    moved_m = std::max(moved_m, (was.p - truth_.front().p).norm());
    turned_rad = std::max(turned_rad, log_rotation(was.q * truth_.front().q.conjugate()).norm());
  }
  void run(double seconds) {
    for (const double end_s = lab.now_s() + seconds; lab.now_s() < end_s;) step();
  }
  [[nodiscard]] double delay_s() const { return delay_s_; }
  [[nodiscard]] FreeBodies& bodies() { return *lab.arm().bodies(); }
  [[nodiscard]] int shown() const { return shown_; }

  void expect_near(const std::string& what) const {
    EXPECT_GT(shown_, 1000) << what;
    EXPECT_LT(off_m, kNear_m) << what;
    EXPECT_LT(off_rad, 0.01) << what;
    EXPECT_LT(age_max_s, 0.2) << what;
    EXPECT_GT(moved_m, 4 * kNear_m) << what << ": the control: a body that stays would be near, too";
    std::printf("%s: %.2f mm, %.2f mrad from the truth, age at most %.3f s; moved by %.0f mm, %.0f mrad\n",
                what.c_str(), 1e3 * off_m, 1e3 * off_rad, age_max_s, 1e3 * moved_m, 1e3 * turned_rad);
  }

 private:
  /// From the motion of the centre of mass, not by Bodies::pose.
  Pose true_pose() {
    const Pose moved = bodies().displaced(0), &start = lab.arm().start_pose();
    const Vector3 centre = bodies().body(0).X_start.p;
    return {start.p + centre + moved.p + moved.q * (kSpacecraft - centre), moved.q};
  }

  proto::LabConfig config_;
  double delay_s_;
  std::vector<Pose> truth_{};
  int shown_ = 0;

 public:
  Laboratory lab;
  double off_m = 0.0, off_rad = 0.0, age_max_s = 0.0, moved_m = 0.0, turned_rad = 0.0;
};

TEST(TrackedBodies, AreShownWhereTheyDriftedOneDelayAgo) {
  for (const char* profile : {"lab", "moon"}) {
    Watched w(dock_over(profile));
    w.bodies().push(0, {0.02, -0.03, 0.01}, {0.05, 0.02, -0.05});
    w.run(6.0 + 2.0 * w.delay_s());
    w.expect_near(std::string("drifting, ") + profile);
    EXPECT_GT(w.turned_rad, 0.2) << profile;
  }
}

TEST(TrackedBodies, AreShownWhereTheyWereDraggedOneDelayAgo) {
  for (const char* profile : {"lab", "moon"}) {
    Watched w(dock_over(profile));
    const Pose X = w.bodies().state(0).X;
    w.bodies().place(0, {X.p - w.bodies().to_fixture_m(), X.q});  // the pin is in the gripper
    w.run(1.0);
    while (w.lab.master().state != SafetyState::kEngaged && w.lab.now_s() < 30.0) w.step();
    ASSERT_EQ(w.lab.master().state, SafetyState::kEngaged) << profile;
    w.lab.requests().grip = true;
    w.run(1.0 + 2.0 * w.delay_s());
    ASSERT_TRUE(w.bodies().contact().holds) << profile;
    const double begin_s = w.lab.now_s();
    while (w.lab.now_s() < begin_s + 12.0 + 2.0 * w.delay_s()) {
      const double phase = 2.0 * std::numbers::pi * (w.lab.now_s() - begin_s) / 8.0;
      HandTarget hand;
      hand.grip = Grip::kFirm;
      hand.position_m.x() = -0.02 * (1.0 - std::cos(phase));
      w.lab.drive(hand);
      w.step();
    }
    EXPECT_TRUE(w.bodies().contact().holds) << profile;
    w.expect_near(std::string("dragged, ") + profile);
  }
}

/// Counts what the slave sends.
class Counter : public FaultHooks {
 public:
  void on_wire(MemoryChannelPair& wire) override {
    while (const auto size = wire.a().receive(buffer_)) {
      const auto datagram = std::span(buffer_).first(*size);
      const auto type = std::to_integer<std::size_t>(datagram[1]);
      ++count[type];
      bits[type] += 8.0 * static_cast<double>(*size + kIpUdpBytes);
      sent_.emplace_back(datagram.begin(), datagram.end());
    }
    for (const auto& datagram : sent_) wire.b().send(datagram);
    sent_.clear();
  }
  std::array<int, 256> count{};
  std::array<double, 256> bits{};

 private:
  std::array<std::byte, kDatagramMaxBytes> buffer_{};
  std::vector<std::vector<std::byte>> sent_;
};

constexpr std::size_t kReports = 2, kTelemetry = 3, kBodies = 4;

TEST(TrackedBodies, AreSent30TimesPerSecond) {
  Watched w(dock_over("lab"));
  Counter counter;
  w.lab.set_fault_hooks(counter);
  w.run(10.0);
  EXPECT_NEAR(counter.count[kBodies], 300, 3);
  EXPECT_LT(counter.bits[kBodies] / counter.count[kBodies], 8.0 * 200.0);
}

TEST(TrackedBodies, WithoutBodiesNothingIsSent) {
  Laboratory lab(to_struct(configure({}, LONGREACH_DEPLOY).master()),
                 to_struct(configure({}, LONGREACH_DEPLOY).slave()), 3);
  Counter counter;
  lab.set_fault_hooks(counter);
  while (lab.now_s() < 5.0) lab.step();
  EXPECT_EQ(counter.count[kBodies], 0);
  EXPECT_GT(counter.count[kTelemetry], 100);
  EXPECT_TRUE(lab.master().bodies.empty());
}

/// On a link that is too narrow for all, a tenth of the budget is reserved for bodies; the others lose at most this tenth.
TEST(TrackedBodies, LeaveTheBudgetToTheReports) {
  constexpr double kSeconds = 20.0, kBudget_kbit_per_s = 64.0;
  const std::vector<std::string> narrow = {"slave.link.budget_kbit_per_s=64",
                                           "slave.link.heartbeat_free_hz=20"};
  Counter with, without;
  Watched w(dock_over("lab", narrow));
  w.lab.set_fault_hooks(with);
  w.run(kSeconds);
  std::vector<std::string> empty = dock_over("lab", narrow);
  empty.emplace_back("scene_file=scenes/free.txtpb");
  const proto::LabConfig config = configure(empty, LONGREACH_DEPLOY);
  Laboratory lab(to_struct(config.master()), to_struct(config.slave()), 3);
  lab.set_fault_hooks(without);
  while (lab.now_s() < kSeconds) lab.step();
  EXPECT_LE(with.bits[kBodies], 0.105 * 1e3 * kBudget_kbit_per_s * kSeconds);
  EXPECT_GT(with.count[kBodies], 2.0 * kSeconds);
  EXPECT_GE(with.count[kReports], 0.9 * without.count[kReports]);
  EXPECT_GE(with.count[kTelemetry], 0.9 * without.count[kTelemetry]);
  EXPECT_LE(with.bits[kBodies] + with.bits[kReports] + with.bits[kTelemetry],
            1.01e3 * kBudget_kbit_per_s * kSeconds);
  std::printf("bodies %.1f kbit/s, %.1f per second; reports %d instead of %d, telemetry %d instead of %d\n",
              1e-3 * with.bits[kBodies] / kSeconds, with.count[kBodies] / kSeconds, with.count[kReports],
              without.count[kReports], with.count[kTelemetry], without.count[kTelemetry]);
}

TEST(TrackedBodies, AreRecordedAndReplayedBitForBit) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "bodies.mcap";
  Watched w(dock_over("lab"));
  w.lab.record(file);
  w.bodies().push(0, {0.02, -0.03, 0.01}, {0.05, 0.02, -0.05});
  w.run(5.0);
  w.lab.end_recording();
  const FileReplay replayed = replay_file(file);
  ASSERT_EQ(replayed.sides.size(), 2u);
  for (const SideReplay& side : replayed.sides) {
    EXPECT_FALSE(side.difference) << side.side << " " << side.difference->field;
    EXPECT_EQ(side.stopped, "") << side.side;
  }
  std::uint64_t bodies = 0, master = 0;
  McapReader reader(file);
  while (const auto message = reader.next())
    if (message->channel->topic == "/master/received_bodies") ++bodies;
  for (const SideReplay& side : replayed.sides)
    if (side.side == "master") master = side.messages;
  EXPECT_NEAR(static_cast<double>(bodies), 150.0, 8.0);
  EXPECT_GT(master, bodies);
}

}  // namespace
}  // namespace longreach::tracked_bodies_test
