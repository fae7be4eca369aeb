#include "slave/kinematics/least_aside.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace longreach::least_aside_test {
namespace {

TEST(LeastAside, StaysWhereNothingIsMissed) {
  EXPECT_EQ(least_aside(3.0, [](double h) { return std::abs(h) - 0.2; }), 0.0);
}

TEST(LeastAside, GoesToTheNearEdgeOfWhatReaches) {
  const auto miss = [](double h) { return std::max(std::abs(h + 0.5) - 0.3, 0.0); };  // reaches -0.8 to -0.2
  EXPECT_NEAR(least_aside(3.0, miss), -0.2, 1e-12);
  EXPECT_LE(miss(least_aside(3.0, miss)), 0.0);
}

TEST(LeastAside, FindsANarrowValleyAndTheLeastWhereNothingReaches) {
  const auto narrow = [](double h) { return std::max(std::abs(h - 1.234) - 1e-7, 0.0); };
  EXPECT_NEAR(least_aside(3.0, narrow), 1.234 - 1e-7, 1e-12);
  EXPECT_NEAR(least_aside(3.0, [](double h) { return 0.1 + std::abs(h - 0.7); }), 0.7, 1e-9);
}

}  // namespace
}  // namespace longreach::least_aside_test
