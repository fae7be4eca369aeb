#include "slave/command/held_back.hpp"

#include <gtest/gtest.h>

namespace longreach::held_back_test {
namespace {

TEST(HeldBack, IsSeenAfterATenthOfASecondOfALimitAndADistance) {
  HeldBack held(2e-3);
  const auto after = [&held](double missing_m, bool limited, int ticks) {
    for (int i = 0; i < ticks; ++i)
      held.step(Vector3::Zero(), {0.0, missing_m, 0.0}, limited, Vector3::Zero(), 1e-3);
    return held.direction();
  };
  EXPECT_TRUE(after(0.1, false, 1000).isZero(0.0)) << "behind by its speed alone";
  EXPECT_TRUE(after(1.9e-3, true, 1000).isZero(0.0));
  EXPECT_TRUE(after(3e-3, true, 98).isZero(0.0));
  EXPECT_EQ(after(3e-3, true, 5), Vector3(Vector3::UnitY()));
  EXPECT_TRUE(after(1e-3, true, 1).isZero(0.0));
}

TEST(HeldBack, CountsTheWayAlongTheLimit) {
  HeldBack held(2e-3);
  for (int i = 0; i < 200; ++i) held.step(Vector3::Zero(), {1e-3, 0.05, 0.0}, true, Vector3::UnitX(), 1e-3);
  EXPECT_TRUE(held.direction().isZero(0.0));
  for (int i = 0; i < 200; ++i) held.step(Vector3::Zero(), {3e-3, 0.05, 0.0}, true, Vector3::UnitX(), 1e-3);
  EXPECT_EQ(held.direction(), Vector3(Vector3::UnitX()));
}

TEST(HeldBack, IsNotSeenAtAToolThatIsOnlySlow) {
  HeldBack held(2e-3);
  const auto moving_at = [&held](double m_per_s) {
    for (int i = 0; i < 500; ++i)
      held.step({1e-3 * m_per_s * i, 0.0, 0.0}, {0.05, 0.0, 0.0}, true, Vector3::Zero(), 1e-3);
    return !held.direction().isZero(0.0);
  };
  EXPECT_FALSE(moving_at(0.01));
  held.reset();
  EXPECT_TRUE(moving_at(0.001));
  held.reset();
  EXPECT_TRUE(moving_at(-0.01)) << "pushed back";
}

}  // namespace
}  // namespace longreach::held_back_test
