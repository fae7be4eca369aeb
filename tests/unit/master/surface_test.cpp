#include "master/rendering/surface.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace longreach {
namespace {

/// The goal moves along `direction` by 0.1 mm a command, from zero at sequence 1.
GoalHistory moving(const Vector3& direction, int commands) {
  GoalHistory history(1024);
  for (int i = 0; i < commands; ++i) history.push(static_cast<std::uint64_t>(i) + 1, 1e-4 * i * direction);
  return history;
}

ContactStiffness contact(const Vector3& n, double k, double sequence) {
  ContactStiffness c;
  c.stiffness = k * n * n.transpose();
  c.touch_sequence = sequence;
  c.touch = 1;
  c.in_contact = true;
  return c;
}

TEST(GoalHistory, InterpolatesBetweenCommandsAndKnowsItsEnds) {
  const GoalHistory history = moving(Vector3::UnitX(), 100);
  EXPECT_NEAR(history.at(50.25)->x(), 49.25e-4, 1e-15);
  EXPECT_TRUE(history.at(1.0).has_value());
  EXPECT_TRUE(history.at(100.0).has_value());
  EXPECT_FALSE(history.at(0.5).has_value());
  EXPECT_FALSE(history.at(100.5).has_value());
  EXPECT_FALSE(history.at(std::nan("")).has_value());
  EXPECT_FALSE(history.at(1e300).has_value());
}

TEST(GoalHistory, ForgetsTheOldestWhenFull) {
  GoalHistory history(16);
  for (std::uint64_t i = 1; i <= 40; ++i) history.push(i, Vector3(static_cast<double>(i), 0.0, 0.0));
  EXPECT_FALSE(history.at(24.0).has_value());
  EXPECT_NEAR(history.at(25.0)->x(), 25.0, 1e-12);
  EXPECT_NEAR(history.at(40.0)->x(), 40.0, 1e-12);
}

TEST(Surface, LiesWhereTheGoalWasAtTheTouchAndFacesTheMotion) {
  const Vector3 n = Vector3(1.0, 2.0, -2.0).normalized();
  const GoalHistory history = moving(n, 200);
  Surface surface;
  EXPECT_EQ(surface.on_report(contact(n, 1000.0, 101.5), 0, history, true, 0.005), SurfaceChange::kNew);
  EXPECT_NEAR((surface.inward() - n).norm(), 0.0, 1e-9);
  EXPECT_NEAR(surface.offset_m(), 100.5e-4, 1e-12);
  EXPECT_NEAR(surface.stiffness_n_per_m(), 1000.0, 1e-9);
  // The same tensor met from the other side.
  Surface other;
  other.on_report(contact(n, 1000.0, 101.5), 0, moving(-n, 200), true, 0.005);
  EXPECT_NEAR((other.inward() + n).norm(), 0.0, 1e-9);
}

TEST(Surface, IsRememberedAfterTheContactAndForgottenWhenProvenGone) {
  const GoalHistory history = moving(Vector3::UnitX(), 400);
  Surface surface;
  surface.on_report(contact(Vector3::UnitX(), 1000.0, 101.0), 0, history, true, 0.005);
  EXPECT_EQ(surface.on_report({}, 120, history, true, 0.005), SurfaceChange::kNone);  // 1.9 mm behind
  EXPECT_TRUE(surface.known());
  EXPECT_EQ(surface.on_report({}, 160, history, true, 0.005), SurfaceChange::kGone);  // 5.9 mm behind
  EXPECT_FALSE(surface.known());
}

TEST(Surface, DoesNotTurnWhileForceIsRendered) {
  const GoalHistory history = moving(Vector3(1.0, 1.0, 0.0), 400);
  Surface surface;
  surface.on_report(contact(Vector3::UnitX(), 1000.0, 101.0), 0, history, true, 0.005);
  EXPECT_EQ(surface.on_report(contact(Vector3::UnitY(), 900.0, 150.0), 0, history, false, 0.005),
            SurfaceChange::kNew);
  EXPECT_EQ(surface.inward(), Vector3::UnitX());
}

TEST(Surface, RejectsWhatIsNotFiniteOrWasNeverCommanded) {
  const GoalHistory history = moving(Vector3::UnitX(), 100);
  Surface surface;
  ContactStiffness bad = contact(Vector3::UnitX(), 1000.0, 50.0);
  bad.stiffness(1, 2) = std::nan("");
  EXPECT_EQ(surface.on_report(bad, 0, history, true, 0.005), SurfaceChange::kRejected);
  bad = contact(Vector3::UnitX(), 1000.0, std::nan(""));
  EXPECT_EQ(surface.on_report(bad, 0, history, true, 0.005), SurfaceChange::kRejected);
  EXPECT_EQ(surface.on_report(contact(Vector3::UnitX(), 1000.0, 5000.0), 0, history, true, 0.005),
            SurfaceChange::kRejected);
  EXPECT_FALSE(surface.known());
}

TEST(Surface, TakesNothingFromAContactThatIsNotIdentifiedYet) {
  const GoalHistory history = moving(Vector3::UnitX(), 100);
  Surface surface;
  EXPECT_EQ(surface.on_report(contact(Vector3::UnitX(), 0.0, 50.0), 0, history, true, 0.005),
            SurfaceChange::kNone);
  EXPECT_EQ(surface.on_report(contact(Vector3::UnitX(), -100.0, 50.0), 0, history, true, 0.005),
            SurfaceChange::kNone);
  EXPECT_FALSE(surface.known());
}

}  // namespace
}  // namespace longreach
