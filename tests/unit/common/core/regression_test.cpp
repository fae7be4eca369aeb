#include "common/core/regression.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "common/core/random.hpp"

namespace longreach::regression_test {
namespace {

// Anscombe (1973), first set: the published regression is y = 3.00 + 0.500 x, with 0.118 as the slope's
// standard error.
TEST(LineFit, ReproducesAnscombesPublishedRegression) {
  const double x[] = {10, 8, 13, 9, 11, 14, 6, 4, 12, 7, 5};
  const double y[] = {8.04, 6.95, 7.58, 8.81, 8.33, 9.96, 7.24, 4.26, 10.84, 4.82, 5.68};
  LineFit fit;
  for (int i = 0; i < 11; ++i) fit.add(x[i], y[i]);
  EXPECT_NEAR(fit.slope(), 0.500, 5e-4);
  EXPECT_NEAR(fit.intercept(), 3.00, 5e-3);
  EXPECT_NEAR(fit.slope_sd(), 0.118, 5e-4);
}

TEST(LineFit, AgreesWithAFactorisationOfAllSamples) {
  Random random(7);
  LineFit fit;
  Eigen::MatrixX2d a(500, 2);
  Eigen::VectorXd b(500);
  for (int i = 0; i < 500; ++i) {
    const double x = 0.03 + 0.002 * random.normal();
    const double y = 800.0 * x - 20.0 + 0.1 * random.normal();
    a.row(i) << 1.0, x;
    b[i] = y;
    fit.add(x, y);
  }
  const Eigen::Vector2d exact = a.householderQr().solve(b);
  EXPECT_NEAR(fit.intercept(), exact[0], 1e-8);
  EXPECT_NEAR(fit.slope(), exact[1], 1e-6);
}

TEST(LineFit, SharesTheSlopeBetweenGroupsThatLieApart) {
  // Two groups with slopes 1 and 4 over equal spreads: the pooled within-group slope is their mean.
  LineFit fit;
  fit.begin_group();  // of nothing: none
  for (const double x : {0.0, 1.0, 2.0}) fit.add(x, x);
  fit.begin_group();
  for (const double x : {10.0, 11.0, 12.0}) fit.add(x, 4.0 * x - 100.0);
  EXPECT_NEAR(fit.slope(), 2.5, 1e-12);
  EXPECT_EQ(fit.count(), 6U);
  EXPECT_EQ(fit.mean_x(), 11.0);
  // Residuals ±1.5 at both ends of each group: 4 * 2.25 over 6 - 3 and Sxx = 4.
  EXPECT_NEAR(fit.slope_sd(), std::sqrt(9.0 / (3.0 * 4.0)), 1e-12);
}

TEST(LineFit, KeepsTheSlopeFarFromTheOrigin) {
  LineFit fit;
  for (int i = 0; i < 1000; ++i) fit.add(1e9 + i, 5.0 * i - 1e9);
  EXPECT_NEAR(fit.slope(), 5.0, 1e-9);
}

TEST(LineFit, SaysWhenTheSamplesDetermineNoLine) {
  LineFit fit;
  EXPECT_FALSE(fit.valid());
  fit.add(1.0, 2.0);
  EXPECT_FALSE(fit.valid());
  fit.add(1.0, 3.0);  // vertical
  EXPECT_FALSE(fit.valid());
  EXPECT_EQ(fit.slope(), 0.0);
  EXPECT_EQ(fit.slope_sd(), 0.0);
  fit.add(2.0, 2.5);
  EXPECT_TRUE(fit.valid());
}

TEST(LineFit, LeavesOutWhatIsNotFinite) {
  LineFit fit;
  fit.add(0.0, 0.0);
  fit.add(std::numeric_limits<double>::quiet_NaN(), 1.0);
  fit.add(1.0, std::numeric_limits<double>::infinity());
  fit.add(1.0, 2.0);
  EXPECT_EQ(fit.count(), 2u);
  EXPECT_EQ(fit.ignored(), 2u);
  EXPECT_DOUBLE_EQ(fit.slope(), 2.0);
}

TEST(LineFit, GivesFiniteFiguresForExtremeSamples) {
  for (const double size : {1e300, 1e154, 1e-154, 1e-300, 5e-324}) {
    LineFit fit;
    fit.add(size, size);
    fit.add(-size, size);
    fit.add(0.0, -size);
    EXPECT_TRUE(std::isfinite(fit.slope())) << size;
    EXPECT_TRUE(std::isfinite(fit.intercept())) << size;
    EXPECT_TRUE(std::isfinite(fit.slope_sd())) << size;
  }
}

}  // namespace
}  // namespace longreach::regression_test
