#include "common/spatial/sin_cos.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "common/core/random.hpp"

namespace longreach::sin_cos_test {
namespace {

constexpr double kUnit = 1.2e-16;  // half of the distance between 1 and the next number, and some

void expect_like_the_long_library(double x) {
  const SinCos v = sin_cos(x);
  const long double s = std::sin(static_cast<long double>(x)), c = std::cos(static_cast<long double>(x));
  ASSERT_LE(std::abs(static_cast<double>(v.s - s)), kUnit) << x;
  ASSERT_LE(std::abs(static_cast<double>(v.c - c)), kUnit) << x;
}

TEST(SinCos, IsExactToTheLastPlace) {
  Random random(3);
  for (int n = 0; n < 200'000; ++n) {
    expect_like_the_long_library(random.uniform(-4.0, 4.0));
    expect_like_the_long_library(random.uniform(-1e4, 1e4));
    expect_like_the_long_library(random.uniform(-2e5, 2e5));
  }
}

TEST(SinCos, IsExactAboutEveryQuarterTurn) {
  for (int quarter = -64; quarter <= 64; ++quarter) {
    const double centre = 0.78539816339744830962 * quarter;
    for (const double off : {0.0, 1e-300, 1e-16, 1e-9, -1e-9, 1e-3, -1e-3})
      expect_like_the_long_library(centre + off);
  }
}

TEST(SinCos, KeepsSmallAngles) {
  for (const double x : {1e-3, 1e-9, 1e-200, 5e-324, 0.0}) EXPECT_DOUBLE_EQ(sin_cos(x).s, std::sin(x));
}

TEST(SinCos, AnswersWhatIsTooLargeOrNotANumberLikeTheLibrary) {
  EXPECT_EQ(sin_cos(1e300).s, std::sin(1e300));
  EXPECT_TRUE(std::isnan(sin_cos(std::numeric_limits<double>::infinity()).c));
  EXPECT_TRUE(std::isnan(sin_cos(std::numeric_limits<double>::quiet_NaN()).s));
}

}  // namespace
}  // namespace longreach::sin_cos_test
