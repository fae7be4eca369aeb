// When a tool that does not come nearer to its goal gives up, and when it goes on.

#include "slave/command/stall_detector.hpp"

#include <gtest/gtest.h>

namespace longreach::stall_detector_test {
namespace {

constexpr double kDt = 1e-3, kReachM = 2.0;

Pose at(double x) { return {{x, 0.0, 0.0}, Quaternion::Identity()}; }

// Seconds until patience ends, at most `most_s`; the tool at x(t), the goal at g(t).
template <typename Tool, typename Goal>
double lasts_s(double most_s, const Tool& x, const Goal& g) {
  StallDetector stall_detector(kReachM);
  double t = 0.0;
  while (t < most_s && !stall_detector.ends(at(x(t)), at(g(t)), kDt)) t += kDt;
  return t;
}

TEST(StallDetector, TriggersAfterThreeSecondsWithoutProgress) {
  EXPECT_NEAR(lasts_s(
                  10.0, [](double) { return 0.0; }, [](double) { return 1.0; }),
              3.0, 0.01);
}

TEST(StallDetector, TriggersForOscillatingTool) {
  EXPECT_NEAR(lasts_s(
                  10.0, [](double t) { return 0.2 * std::sin(40.0 * t); }, [](double) { return 1.0; }),
              3.0, 0.1);
}

TEST(StallDetector, DoesNotTriggerWhileToolApproaches) {
  EXPECT_GE(lasts_s(
                60.0, [](double t) { return 1e-3 * t; }, [](double) { return 1.0; }),
            60.0);
}

TEST(StallDetector, DoesNotTriggerWhileGoalMoves) {
  EXPECT_GE(lasts_s(
                60.0, [](double) { return 0.0; }, [](double t) { return 1.0 + 0.01 * t; }),
            60.0);
}

TEST(StallDetector, DoesNotTriggerAtGoal) {
  EXPECT_GE(
      lasts_s(
          60.0, [](double) { return 0.0; }, [](double) { return 0.9 * StallDetector::kThere * kReachM; }),
      60.0);
}

TEST(StallDetector, CountsAngles) {
  StallDetector stall_detector(kReachM);
  const Pose turned{Vector3::Zero(), exp_rotation(Vector3(0.0, 0.0, 0.1))};
  double t = 0.0;
  while (t < 10.0 && !stall_detector.ends(at(0.0), turned, kDt)) t += kDt;
  EXPECT_NEAR(t, 3.0, 0.01);
}

TEST(StallDetector, RestartsWhenGoalHasMoved) {
  StallDetector stall_detector(kReachM);
  while (!stall_detector.ends(at(0.0), at(1.0), kDt)) {
  }
  EXPECT_TRUE(stall_detector.ends(at(0.0), at(1.0 + 0.9 * StallDetector::kMoved * kReachM), kDt));
  EXPECT_FALSE(stall_detector.ends(at(0.0), at(1.0 + 1.1 * StallDetector::kMoved * kReachM), kDt));
}

TEST(StallDetector, IgnoresNonFiniteGoal) {
  StallDetector stall_detector(kReachM);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int n = 0; n < 10'000; ++n) ASSERT_FALSE(stall_detector.ends(at(0.0), at(nan), kDt));
}

}  // namespace
}  // namespace longreach::stall_detector_test
