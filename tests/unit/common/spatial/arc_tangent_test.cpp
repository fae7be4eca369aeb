#include "common/spatial/arc_tangent.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "common/core/random.hpp"

namespace longreach::arc_tangent_test {
namespace {

// The C library in long double is the oracle.
double units_off(double y, double x) {
  const long double exact = std::atan2(static_cast<long double>(y), static_cast<long double>(x));
  const double rounded = std::abs(static_cast<double>(exact));
  const double unit = std::nextafter(rounded, 10.0) - rounded;
  return static_cast<double>(std::abs(static_cast<long double>(arc_tangent(y, x)) - exact)) / unit;
}

TEST(ArcTangent, IsWithinTwoAndAHalfUnitsInEveryDirection) {
  Random random(1);
  double worst = 0.0;
  for (int i = 0; i < 50'000; ++i) {
    const double y = random.normal() * std::pow(10.0, random.uniform(-12, 12));
    const double x = random.normal() * std::pow(10.0, i % 2 == 0 ? 0.0 : random.uniform(-12, 12));
    worst = std::max(worst, units_off(y, x));
  }
  EXPECT_LE(worst, 2.5);
}

TEST(ArcTangent, IsExactOnTheAxesAndDiagonals) {
  const double pi = std::acos(-1.0);
  EXPECT_EQ(arc_tangent(0.0, 1.0), 0.0);
  EXPECT_EQ(arc_tangent(1.0, 0.0), pi / 2);
  EXPECT_EQ(arc_tangent(-1.0, 0.0), -pi / 2);
  EXPECT_EQ(arc_tangent(0.0, -1.0), pi);
  EXPECT_EQ(arc_tangent(-0.0, -1.0), -pi);
  EXPECT_EQ(arc_tangent(1e9, 1e9), pi / 4);
  EXPECT_EQ(arc_tangent(-1e-9, -1e-9), -3 * pi / 4);
  EXPECT_EQ(arc_tangent(0.0, 0.0), 0.0);
}

TEST(ArcTangent, CarriesWhatIsNotANumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(arc_tangent(nan, 1.0)));
  EXPECT_TRUE(std::isnan(arc_tangent(1.0, nan)));
  EXPECT_TRUE(std::isnan(arc_tangent(nan, nan)));
}

TEST(ArcOfSmallSine, IsExactToARoundingOfTheSine) {
  for (int n = -1000; n <= 1000; ++n) {
    const double s = kSmallSine * n / 1000.0;
    const long double exact = std::asin(static_cast<long double>(s));
    EXPECT_LE(std::abs(static_cast<double>(arc_of_small_sine(s) - exact)), 2.3e-16 * std::abs(s)) << s;
  }
}

}  // namespace
}  // namespace longreach::arc_tangent_test
