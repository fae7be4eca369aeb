#include "master/devices/handle_plausibility.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

namespace longreach::handle_plausibility_test {
namespace {

/// A handle that is read once per millisecond.
struct Handle {
  HandlePlausibility watch{DeviceConfig{}};
  HandleState state{};
  Time now{std::chrono::hours(1)};

  Reason read(double x_m, double ms = 1.0) {
    now += from_seconds(1e-3 * ms);
    state.p_MH.x() = x_m;
    return watch.check(state, now);
  }
};

// At rest 6 mm, and 2 mm while it moves and its readings change; up to the workspace of 75 mm.
TEST(HandlePlausibility, AStateThatIsNotFiniteOrFarTooLargeIsNotPossible) {
  EXPECT_TRUE(is_possible({}));
  std::array<HandleState, 8> states{};
  states[0].p_MH.x() = 11.0;
  states[1].velocity_m_per_s.y() = 2e4;
  states[2].angular_rad_per_s.z() = -2e4;
  states[3].p_MH.z() = NAN;
  states[4].velocity_m_per_s.x() = NAN;
  states[5].angular_rad_per_s.x() = NAN;
  states[6].q_MH.coeffs() *= 1.1;
  states[7].q_MH.coeffs().setConstant(NAN);
  for (const HandleState& state : states) EXPECT_FALSE(is_possible(state)) << &state - states.data();
}

TEST(HandlePlausibility, FindsJumpsOfMoreThan6mmAtRestAnd2mmInMotion) {
  for (const double jump_m : {1e-3, 2.5e-3, 5.9e-3, 6.1e-3, 0.01, 0.03, 0.06, -0.06, 0.1}) {
    Handle rests;
    for (int i = 0; i < 500; ++i) ASSERT_EQ(rests.read(0.0), HoldCause::kNone);
    const Reason why = rests.read(jump_m);
    EXPECT_EQ(why == HoldCause::kHandleJumped, std::abs(jump_m) > 6e-3) << jump_m;
    if (why == HoldCause::kHandleJumped) {
      EXPECT_NEAR(why.value, std::abs(jump_m), 1e-12);
    }
    EXPECT_EQ(rests.read(jump_m), HoldCause::kNone) << "reported once";
    Handle moves;
    double x_m = 0.0;
    for (int i = 0; i < 100; ++i) ASSERT_EQ(moves.read(x_m += 1e-4), HoldCause::kNone);  // 0.1 m/s
    EXPECT_EQ(moves.read(x_m + jump_m) == HoldCause::kHandleJumped, std::abs(jump_m) > 2.2e-3) << jump_m;
  }
}

// The fastest motions of a hand with a device, also coarse and read at a few hundred hertz.
TEST(HandlePlausibility, AcceptsMotionsOfAHand) {
  for (const double speed_m_per_s : {0.01, 0.3, 1.0, 2.0}) {
    for (const int each_ms : {1, 2, 5, 15}) {
      if (speed_m_per_s * each_ms > 5.0) continue;  // no pause while the hand reverses with more than a few g
      for (const double count_m : {1e-7, 1e-4}) {
        Handle h;
        const double rate = speed_m_per_s / 0.07;  // amplitude 70 mm
        double x_m = 0.0;
        for (int i = 0; i < 5000; ++i) {
          const double swing = std::min(1.0, 1e-3 * i) * 0.07 * std::sin(1e-3 * i * rate);
          if (i % each_ms == 0) x_m = count_m * std::round(swing / count_m);
          ASSERT_EQ(h.read(x_m), HoldCause::kNone) << speed_m_per_s << ' ' << each_ms << ' ' << i;
        }
      }
    }
  }
}

TEST(HandlePlausibility, AcceptsMotionDuringAPauseOfTheAdapter) {
  for (const double pause_ms : {5.0, 20.0, 60.0, 100.0}) {
    for (const bool late_tick : {false, true}) {
      Handle h;
      double x_m = 0.0;
      for (int i = 0; i < 100; ++i) ASSERT_EQ(h.read(x_m += 3e-4), HoldCause::kNone);  // 0.3 m/s
      for (int i = 1; !late_tick && i < pause_ms; ++i) ASSERT_EQ(h.read(x_m), HoldCause::kNone);
      EXPECT_EQ(h.read(x_m + 0.4e-3 * pause_ms, late_tick ? pause_ms : 1.0), HoldCause::kNone) << pause_ms;
    }
  }
}

TEST(HandlePlausibility, FindsTurnsThatNoHandMakes) {
  for (const double rad : {0.02, 0.3, 1.0}) {
    Handle h;
    for (int i = 0; i < 100; ++i) ASSERT_EQ(h.read(0.0), HoldCause::kNone);
    h.state.q_MH = exp_rotation(Vector3(0.0, rad, 0.0));
    EXPECT_EQ(h.read(0.0) == HoldCause::kHandleJumped, rad > 0.13) << rad;
  }
}

TEST(HandlePlausibility, FindsAnotherUnitAndAnotherQuaternion) {
  Handle mm;
  EXPECT_EQ(mm.read(0.112), HoldCause::kNone) << "1.5 times 75 mm";
  EXPECT_EQ(mm.read(0.113), HoldCause::kHandleOutside);
  EXPECT_EQ(mm.read(1.0), HoldCause::kHandleOutside) << "1 mm, reported as 1 m";
  Handle slow;  // a hand that moves at 4 mm/s, in millimetres
  Reason why;
  double x_m = 0.0;
  for (int i = 0; i < 1000 && why == HoldCause::kNone; ++i) why = slow.read(x_m += 4e-3);
  EXPECT_NE(why, HoldCause::kNone);
  EXPECT_LT(x_m, 0.12);
  Handle swapped;
  swapped.state.q_MH = Quaternion(0.0, 0.0, 0.0, 1.0);
  EXPECT_EQ(swapped.read(0.0), HoldCause::kHandleOutside);
}

TEST(HandlePlausibility, AfterAFailureTheHandleMayBeAnywhere) {
  Handle h;
  EXPECT_EQ(h.read(-0.05), HoldCause::kNone);
  h.watch.forget();
  EXPECT_EQ(h.read(0.05), HoldCause::kNone);
}

// Two readings with the same time have no speed.
TEST(HandlePlausibility, AcceptsTwoReadingsAtTheSameTime) {
  Handle h;
  for (int i = 0; i < 100; ++i) ASSERT_EQ(h.read(0.0), HoldCause::kNone);
  EXPECT_EQ(h.read(1e-3), HoldCause::kNone);
  EXPECT_EQ(h.read(2e-3, 0.0), HoldCause::kNone);
}

// Each step is short enough for the speed before it.
TEST(HandlePlausibility, FindsAHandleThatIsFasterThan5MetersPerSecond) {
  constexpr double kMs = 1e-3, kMean_s = 0.01;
  Handle h;
  double x_m = -0.07, m_per_s = 0.0;
  double same_s = 100.0 * kMs;  // since the last change
  for (int i = 0; i < 100; ++i) ASSERT_EQ(h.read(x_m), HoldCause::kNone);
  Reason why{};
  for (int i = 0; i < 40 && why == HoldCause::kNone; ++i) {
    ASSERT_LT(m_per_s, 5.5);
    const double step_m = 1.95e-3 + 1.95 * m_per_s * kMs;
    why = h.read(x_m += step_m);
    m_per_s += same_s / (same_s + kMean_s) * (step_m / same_s - m_per_s);
    same_s = kMs;
  }
  EXPECT_EQ(why, HoldCause::kHandleJumped);
  EXPECT_GT(m_per_s, 4.9);
}

}  // namespace
}  // namespace longreach::handle_plausibility_test
