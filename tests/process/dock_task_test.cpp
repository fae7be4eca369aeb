// A person at the keyboard of the real programs grasps, drags and docks a spacecraft; `longreach task dock` judges it.

#include <chrono>
#include <thread>

#include "tests/process/task_station.hpp"

namespace longreach::dock_task_test {
namespace {

// Places of the tool from its start, by dock.xml: at the pin, and with the striker at the catch.
const Vector3 kPin{0.6, 0.1, 0.05}, kCatch{1.04, -0.35, 0.1};
const Vector3 kGoal{1.344, -0.35, 0.1};                // of the body
constexpr double kSmall_m = 0.0008, kLarge_m = 0.004;  // steps of the keys at a scale of 0.8

class Docking : public TaskStation {
 protected:
  void sleep(int milliseconds) { std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds)); }
  double force_n() {
    const auto now = slave_.status();
    return now ? now->force_n() : NAN;
  }
  static std::string key(int axis, bool up, bool large) {
    const std::string keys = up ? "war" : "sdf";
    const char small = keys[static_cast<std::size_t>(axis)];
    return {large ? static_cast<char>(std::toupper(small)) : small};
  }
  void type_times(const std::string& key, int times) {
    std::string keys;
    for (int i = 0; i < times; ++i) keys += key;
    terminal_.type(keys);
  }
  bool gripper_is(const std::string& words) {
    return eventually([&] {
      const auto now = slave_.status();
      return now && now->gripper().find(words) != std::string::npos;
    });
  }

  /// The tool has followed the hand and is at rest.
  void settle() {
    double before = NAN;
    EXPECT_TRUE(eventually([&] {
      sleep(150);
      const double now = at_m(0) + at_m(1) + at_m(2);
      const bool rests = std::abs(now - before) < 1e-4;
      before = now;
      return rests;
    }));
  }
  void take_mode(const std::string& mode) {
    terminal_.type("m");
    ASSERT_TRUE(mode_is(mode)) << outputs();
    if (mode == "rate") bring_home();
  }
  void bring_home() {
    terminal_.type(" ");
    ASSERT_TRUE(eventually([&] {
      return std::abs(hand_m(0)) < 0.003 && std::abs(hand_m(1)) < 0.003 && std::abs(hand_m(2)) < 0.003;
    })) << outputs();
  }

  /// Rate mode: holds the handle out until the tool is about there.
  void drive(int axis, double to_m) {
    if (HasFailure()) return;
    const bool up = to_m > at_m(axis);
    {
      const HeldKey held(terminal_.outer);
      type_times(key(axis, up, true), 4);
      EXPECT_TRUE(eventually([&] { return up ? at_m(axis) > to_m - 0.02 : at_m(axis) < to_m + 0.02; }))
          << "axis " << axis << " at " << at_m(axis) << " " << outputs();
      terminal_.type(" ");
    }
    bring_home();
    settle();
  }
  /// Position mode: steps of the hand, which is brought home with the clutch at the end of its range.
  void move(int axis, double to_m) {
    if (HasFailure()) return;
    EXPECT_TRUE(eventually([&] {
      settle();
      const double error_m = to_m - at_m(axis);
      if (std::abs(error_m) < 0.001) return true;
      if (std::abs(hand_m(axis)) > 0.045) {
        terminal_.type("c");
        bring_home();
        terminal_.type("c");
        return false;
      }
      const bool large = std::abs(error_m) > kLarge_m;
      const double steps = std::abs(error_m) / (large ? kLarge_m : kSmall_m);
      type_times(key(axis, error_m > 0.0, large), std::clamp(static_cast<int>(steps), 1, 5));
      return false;
    })) << "axis "
        << axis << " at " << at_m(axis) << ", not at " << to_m << " " << outputs();
  }
  void move(const Vector3& to_m) {
    for (const int axis : {1, 2, 0}) move(axis, to_m[axis]);
  }

  /// Small steps of a firm hand until the force has risen to 8 N and vanished.
  void press() {
    EXPECT_EQ(master_.set("hand.grip", "FIRM"), "");
    terminal_.type("c");
    bring_home();
    terminal_.type("c");
    double most_n = 0.0, felt_n = 0.0;
    bool vanished = false;
    EXPECT_TRUE(eventually([&] {
      terminal_.type("w");
      for (int i = 0; i < 5; ++i) {
        sleep(50);
        const double now_n = force_n();
        most_n = std::max(most_n, now_n);
        vanished = vanished || (most_n > 8.0 && now_n < 2.0);
        felt_n = std::max(felt_n, master_.status()->contact_n());
      }
      return vanished;
    })) << most_n
        << " N at the tool and " << felt_n << " N at the hand, tool at " << at_m(0) << " " << outputs();
    EXPECT_GT(felt_n, 3.0) << "the latch is felt";
  }

  void grasp_drag_and_dock() {
    type_times(".", 4);  // kv times 2.4
    drive(1, kPin.y());
    drive(2, kPin.z());
    drive(0, kPin.x() - 0.06);
    take_mode("position");
    move(kPin);
    if (HasFailure()) return;
    terminal_.type("g");
    ASSERT_TRUE(gripper_is("holds")) << outputs();
    const Vector3 off_m = Vector3(at_m(0), at_m(1), at_m(2)) - kPin;  // of the grasp from the pin
    take_mode("rate");
    drive(1, kCatch.y());
    drive(2, kCatch.z());
    take_mode("position");
    move(1, kCatch.y() + off_m.y());
    move(2, kCatch.z() + off_m.z());
    take_mode("rate");
    drive(0, kCatch.x() - 0.06);
    take_mode("position");
    move(0, kCatch.x() - 0.01);
    if (HasFailure()) return;
    press();
    settle();
    terminal_.type("g");
    ASSERT_TRUE(gripper_is("open")) << outputs();
    move(0, kCatch.x() - 0.08);
  }

  /// The figures follow from the telemetry and the poses of the body that the master recorded.
  void expect_as_recorded(const StudyRow& row) {
    const RecordedTask recorded = recording();
    const auto& all = recorded.telemetry;
    const auto from_body_m = [&](std::size_t i) {
      return (all[i].tool_m - recorded.body_at(all[i].t_s).p).norm();
    };
    std::size_t begin = 0, grasp = 0, left = 0, end = 0;
    for (std::size_t i = 0; i < all.size() && end == 0; ++i) {
      if (begin == 0 && (all[i].tool_m - start_m_).norm() > 0.005) begin = i;
      if (grasp == 0 && all[i].load) grasp = i;
      if (grasp > 0 && left == 0 && !all[i].load) left = i;
      if (left > 0 && from_body_m(i) - from_body_m(left) > 0.03) end = i;
    }
    ASSERT_GT(end, 0U);
    EXPECT_NEAR(row.number("grasp_s"), all[grasp].t_s - all[begin].t_s, 0.2);
    EXPECT_NEAR(row.number("time_s"), all[end].t_s - all[begin].t_s, 0.3);
    const double most_n = recorded.force_max_n(all[begin].t_s, all[end].t_s + 0.1);
    EXPECT_LE(row.number("tool_force_max_n"), most_n + 1e-6);
    EXPECT_GE(row.number("tool_force_max_n"), 0.9 * most_n);
    const Pose body = recorded.body_at(all[end].t_s);
    EXPECT_NEAR(row.number("position_error_m"), (body.p - start_m_ - kGoal).norm(), 5e-4);
    EXPECT_NEAR(row.number("angle_error_rad"), body.q.angularDistance(Quaternion::Identity()), 2e-3);
  }
};

TEST_F(Docking, ASpacecraftIsGraspedDraggedAndDocked) {
  start("dock", "rate");
  if (HasFatalFailure()) return;
  ClientRun task(client({"task", "dock", "--participant", "p07", "--csv", study_}));
  task.read("the time begins when the tool moves");
  grasp_drag_and_dock();
  ASSERT_FALSE(HasFailure());
  task.read();
  ASSERT_EQ(task.status(), 0) << task.out() << task.err() << outputs();
  for (const char* words :
       {"the body is held after", "the body is at its goal after", "the body is released", "docked after"})
    EXPECT_NE(task.out().find(words), std::string::npos) << words << " " << task.out();

  RecordProperty("said", task.out());
  const StudyRow row(study_);
  EXPECT_EQ(row.text("participant") + row.text("task") + row.text("trial") + row.text("mode"),
            "p07dock1hybrid");
  EXPECT_EQ(row.number("finished"), 1.0);
  EXPECT_EQ(row.number("holds"), 0.0);
  EXPECT_LE(row.number("position_error_m"), 0.02);
  EXPECT_LE(row.number("angle_error_rad"), 0.1);
  EXPECT_GT(row.number("seat_force_n"), 8.0);
  EXPECT_LE(row.number("tool_force_max_n"), 27.0) << "1.35 times the guard";
  EXPECT_GT(row.number("hand_force_max_n"), 3.0);
  expect_as_recorded(row);
}

}  // namespace
}  // namespace longreach::dock_task_test
