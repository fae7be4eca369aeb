#include "slave/sensing/force_sign_test.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/unit/slave/sensing/pressed_tool.hpp"

namespace longreach::force_sign_test_test {
namespace {

using test::PressedTool;
using Verdict = ForceSignTest::Verdict;

const Vector3 kIn = Vector3::UnitX();
constexpr double kBrake_m_per_s2 = 1.25;

/// The tool goes on until the force grows as it should not; then it brakes and gives way, as the slave does
/// in a trial.
struct Tried {
  PressedTool tool;
  ForceSignTest trial{};
  double noise_n = 0.05;

  explicit Tried(double stiffness_n_per_m) : tool(stiffness_n_per_m) {}
  bool press(const Vector3& m_per_s, double until_n = 15.0) {
    while (!tool.suspected && tool.force_n() < until_n) tool.go(m_per_s);
    return tool.suspected;
  }
  void step() { trial.step(tool.watch, reaction(), {.noise_n = noise_n}, 1e-3); }
  Verdict brake(Vector3 m_per_s, double seconds = 0.3) {
    trial.begin(tool.watch);
    for (int i = 0; i < std::lround(1e3 * seconds); ++i) {
      m_per_s += clamp_norm(trial.ease_m_per_s() * reaction() - m_per_s, 1e-3 * kBrake_m_per_s2);
      tool.go(stuck ? Vector3::Zero() : m_per_s);
      step();
    }
    return trial.verdict();
  }
  bool stuck = false;  // the robot stands, whatever is asked of it

 private:
  [[nodiscard]] Vector3 reaction() const { return tool.reported_n.stableNormalized(); }
};

TEST(ForceSignTest, DetectsWrongSignOrQuarterTurnedFrame) {
  for (const double stiffness : {1e3, 5e3, 1e4}) {
    for (const Matrix3& sensor :
         {Matrix3(-Matrix3::Identity()), test::turned(0.5 * std::numbers::pi, Vector3::UnitZ()),
          test::turned(-0.5 * std::numbers::pi, Vector3::UnitY())}) {
      for (const double noise : {0.0, 0.05}) {
        Tried t(stiffness);
        t.tool.sensor = sensor;
        t.tool.noise_n = noise;
        const Vector3 velocity = std::min(0.02, 50.0 / stiffness) * kIn;
        ASSERT_TRUE(t.press(velocity)) << stiffness;
        EXPECT_EQ(t.brake(velocity), Verdict::kSign) << stiffness << '\n' << sensor;
      }
    }
  }
}

TEST(ForceSignTest, PendsForSixtyMillisecondsAndDecidesOnce) {
  Tried t(1e3);
  t.step();
  EXPECT_EQ(t.trial.verdict(), Verdict::kNone) << "nothing has begun";
  t.tool.sensor = -Matrix3::Identity();
  ASSERT_TRUE(t.press(0.01 * kIn));
  EXPECT_EQ(t.brake(0.01 * kIn, 0.055), Verdict::kPending);
  EXPECT_EQ(t.brake(Vector3::Zero(), 0.01), Verdict::kSign) << "it has begun once, not twice";
  t.tool.wall_m -= 0.01;
  EXPECT_EQ(t.brake(Vector3::Zero(), 0.1), Verdict::kSign);
  t.trial.reset();
  EXPECT_EQ(t.trial.verdict(), Verdict::kNone);
}

TEST(ForceSignTest, ClearsStiffWallInSlidingContact) {
  for (const double stiffness : {1e5, 1e6}) {
    Tried t(stiffness);
    const double slope =
        3e4 / stiffness;  // of the way: 3e4 N a metre of it, more than the stiffest that counts
    const Vector3 velocity = 0.002 * Vector3(slope, std::sqrt(1.0 - slope * slope), 0.0);
    ASSERT_TRUE(t.press(velocity)) << stiffness;
    while (t.tool.force_n() < 10.0) t.tool.go(velocity);
    const double pressed_n = t.tool.force_n();
    EXPECT_EQ(t.brake(0.05 * Vector3::UnitY(), 0.062), Verdict::kNone) << stiffness;
    EXPECT_EQ(t.tool.force_n(), pressed_n) << "it slid to rest, and did not give way";
  }
}

// It grows as before while the tool comes to rest, and falls where it gives way.
TEST(ForceSignTest, ClearsStiffWallInSlowSlidingByRetreat) {
  Tried t(5e4);
  const Vector3 velocity = 2e-4 * Vector3(0.3, std::sqrt(1.0 - 0.3 * 0.3), 0.0);
  ASSERT_TRUE(t.press(velocity));
  while (t.tool.force_n() < 10.0) t.tool.go(velocity);
  ASSERT_EQ(t.brake(velocity, 0.065), Verdict::kPending);
  for (int i = 0; i < 100 && t.trial.ease_m_per_s() == 0.0; ++i) t.brake(Vector3::Zero(), 1e-3);
  EXPECT_GT(t.trial.ease_m_per_s(), 0.0);
  const double before_n = t.tool.force_n();
  EXPECT_EQ(t.brake(Vector3::Zero()), Verdict::kNone);
  EXPECT_LT(t.tool.force_n(), before_n - 0.9);
  EXPECT_GT(t.tool.force_n(), 5.0) << "the contact lasts";
  EXPECT_EQ(t.trial.ease_m_per_s(), 0.0);
}

TEST(ForceSignTest, RobotThatCannotRetreatIsForcePersists) {
  Tried t(1e3);
  t.tool.sensor = test::turned(0.5 * std::numbers::pi, Vector3::UnitZ());
  ASSERT_TRUE(t.press(0.01 * kIn));
  ASSERT_EQ(t.brake(0.01 * kIn, 0.062), Verdict::kPending);
  t.stuck = true;
  EXPECT_EQ(t.brake(Vector3::Zero(), 0.4), Verdict::kPending);
  EXPECT_EQ(t.brake(Vector3::Zero(), 0.2), Verdict::kForcePersists);
  EXPECT_EQ(t.trial.ease_m_per_s(), 0.0);
}

TEST(ForceSignTest, ApproachingWallKeepsPushing) {
  Tried t(2e3);
  const Vector3 away = -0.002 * kIn;
  for (int i = 0; i < 2000 && !t.tool.suspected; ++i) {
    t.tool.wall_m -= 1e-3 * 0.01;
    t.tool.go(away);
  }
  ASSERT_TRUE(t.tool.suspected);
  ForceSignTest known = t.trial;  // to grow at rest
  t.trial.begin(t.tool.watch);
  known.begin(t.tool.watch);
  for (int i = 0; i < 160; ++i) {
    t.tool.wall_m -= 1e-3 * 0.01;
    t.tool.go(Vector3::Zero());
    t.step();
    known.step(t.tool.watch, -kIn, {.noise_n = 0.05}, 1e-3, true);
    if (i == 58) {
      EXPECT_EQ(known.verdict(), Verdict::kPending);
    }
  }
  EXPECT_EQ(t.trial.verdict(), Verdict::kForcePersists);
  EXPECT_EQ(known.verdict(), Verdict::kNone) << "its answer to giving way decides";
}

// It grows by less than noise does in 60 ms.
TEST(ForceSignTest, SlowlyApproachingWallIsNotSensorFault) {
  for (const Vector3& away : {Vector3(-0.001 * kIn), Vector3(0.001 * Vector3::UnitY())}) {
    Tried t(500.0);
    constexpr double kComing_m_per_s = 0.004;
    for (int i = 0; i < 8000 && !t.tool.suspected; ++i) {
      t.tool.wall_m -= 1e-3 * kComing_m_per_s;
      t.tool.go(away);
    }
    ASSERT_TRUE(t.tool.suspected);
    t.trial.begin(t.tool.watch);
    for (int i = 0; i < 450; ++i) {
      t.tool.wall_m -= 1e-3 * kComing_m_per_s;
      t.tool.go(Vector3::Zero());
      t.trial.step(t.tool.watch, -kIn, {.noise_n = 0.05}, 1e-3, i > 250);
      ASSERT_NE(t.trial.verdict(), Verdict::kSign) << i << ' ' << away.transpose();
    }
    EXPECT_EQ(t.trial.verdict(), Verdict::kNone);
  }
}

// What comes and stops: the sum may fit, the last of it does not.
TEST(ForceSignTest, ChangingForceAtEndIsNotSensorFault) {
  Tried t(1e3);
  t.tool.sensor = -Matrix3::Identity();
  t.noise_n = 0.0;
  ASSERT_TRUE(t.press(0.01 * kIn));
  t.tool.go(0.01 * kIn, 0.3);
  t.trial.begin(t.tool.watch);
  for (int i = 0; i < 160; ++i) {
    t.tool.wall_m += i < 40 ? 1.5e-5 : i < 57 ? -3.53e-5 : 0.0;  // 0.6 N less, then as before
    t.tool.go(Vector3::Zero());
    t.step();
  }
  EXPECT_EQ(t.trial.verdict(), Verdict::kForcePersists);
}

TEST(ForceSignTest, CarriedBodyForceEndsWithMotion) {
  Tried t(0.0);
  for (int i = 0; i < 200 && !t.tool.suspected; ++i) {
    t.tool.p_m += 1e-5 * kIn;
    t.tool.report((1.0 + 0.02 * i) * kIn);
  }
  ASSERT_TRUE(t.tool.suspected);
  t.trial.begin(t.tool.watch);
  const double from_n = t.tool.watch.size_n();
  for (int i = 0; i < 160; ++i) {
    t.tool.report(std::max(0.2, from_n - 0.05 * i) * kIn);
    t.step();
  }
  EXPECT_EQ(t.trial.verdict(), Verdict::kForcePersists);
}

}  // namespace
}  // namespace longreach::force_sign_test_test
