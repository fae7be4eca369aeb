#include "master/input/hand_brace.hpp"

#include <gtest/gtest.h>

namespace longreach::hand_brace_test {
namespace {

constexpr double kStiffness_n_per_m = 400.0;
const Vector3 kTarget(0.01, 0.0, 0.0), kForce(-2.0, 0.0, 0.4), kBears(0.005, 0.0, -0.001);

Vector3 step(HandBrace& brace, const Vector3& target, const Vector3& force) {
  return brace.step(target, force, kStiffness_n_per_m);
}

TEST(HandBrace, BearsTheForceOfAHandThatBegins) {
  HandBrace brace(5e-4);
  EXPECT_EQ(step(brace, kTarget, Vector3::Zero()), Vector3::Zero());
  EXPECT_LT((step(brace, kTarget, 0.5 * kForce) - 0.5 * kBears).norm(), 1e-12);
  EXPECT_LT((step(brace, kTarget, kForce) - kBears).norm(), 1e-12);
  EXPECT_LT((step(brace, kTarget + Vector3(4e-4, 0.0, 0.0), kForce) - kBears).norm(), 1e-12);
}

TEST(HandBrace, OnlyDecreasesWithTheForceWhenTheHandHasMoved) {
  HandBrace brace(5e-4);
  step(brace, kTarget, kForce);
  const Vector3 moved = kTarget + Vector3(1e-3, 0.0, 0.0);
  EXPECT_LT((step(brace, moved, 2.0 * kForce) - kBears).norm(), 1e-12);
  EXPECT_LT((step(brace, kTarget, 2.0 * kForce) - kBears).norm(), 1e-12) << "it has moved before";
  EXPECT_LT((step(brace, moved, 0.5 * kForce) - 0.5 * kBears).norm(), 1e-12);
  EXPECT_EQ(step(brace, moved, Vector3::Zero()), Vector3::Zero());
  EXPECT_EQ(step(brace, moved, kForce), Vector3::Zero()) << "it presses by its own motion";
  brace.begin();
  EXPECT_LT((step(brace, moved, kForce) - kBears).norm(), 1e-12);
}

TEST(HandBrace, AReleasedHandleBearsNothing) {
  HandBrace brace(5e-4);
  step(brace, kTarget, kForce);
  EXPECT_EQ(brace.step(kTarget, kForce, 0.0), Vector3::Zero());
}

}  // namespace
}  // namespace longreach::hand_brace_test
