#include "master/mapping/resume_gate.hpp"

#include <gtest/gtest.h>

namespace longreach::resume_gate_test {
namespace {

constexpr double kTick_s = 1e-3;

/// How long the goal is kept when an engagement in contact follows a hold, s. `felt_before`: a surface was rendered
/// before the hold.
double kept_s(double hand_m_per_s, double felt_after_s, bool in_contact = true, bool felt_before = true) {
  ResumeGate gate;
  HandleState handle;
  (void)gate.step(true, in_contact, felt_before, handle, kTick_s);
  EXPECT_FALSE(gate.step(false, in_contact, false, handle, kTick_s));
  handle.velocity_m_per_s = {hand_m_per_s, 0.0, 0.0};
  double kept_s = 0.0;
  while (gate.step(true, in_contact, kept_s > felt_after_s, handle, kTick_s)) kept_s += kTick_s;
  return kept_s;
}

TEST(ResumeGate, KeepsTheGoalUntilTheForceIsBackAndTheHandRests) {
  EXPECT_EQ(kept_s(0.0, -1.0), 0.0) << "felt, and at rest";
  EXPECT_EQ(kept_s(0.1, 0.2, false), 0.0) << "no contact";
  EXPECT_NEAR(kept_s(0.0, 0.2), 0.2, 2e-3) << "a hand that has not begun to move yet";
  EXPECT_NEAR(kept_s(0.1, 0.2), 0.5, 2e-3) << "a hand that moves";
  EXPECT_EQ(kept_s(0.0, 1e9, true, false), 0.0) << "nothing was felt before";
  EXPECT_NEAR(kept_s(0.0, 1e9), 0.5, 2e-3) << "no force comes";
}

TEST(ResumeGate, DoesNotKeepItAgainInTheSameEngagement) {
  ResumeGate gate;
  HandleState handle;
  EXPECT_FALSE(gate.step(true, true, true, handle, kTick_s));
  EXPECT_FALSE(gate.step(true, true, false, handle, kTick_s)) << "a surface that is no longer rendered";
}

}  // namespace
}  // namespace longreach::resume_gate_test
