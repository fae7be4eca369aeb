#include "slave/estimation/reported_tangent.hpp"

#include <gtest/gtest.h>

#include "common/link/stiffness_report.hpp"

namespace longreach::reported_tangent_test {
namespace {

TEST(ReportedTangent, AppearsWhenKnownHoldsAndIsRenewedWhenItsSdHasHalved) {
  ReportedTangent reported(EstimatorConfig{});
  Vector3 normal = Vector3::UnitX();
  const auto step = [&](double stiffness_n_per_m, double fraction, bool elsewhere = false) {
    ContactAnswer answer;
    answer.valid = true;
    answer.stiffness = {stiffness_n_per_m, fraction * stiffness_n_per_m};
    return reported.step(answer, normal, 0.0, elsewhere, EstimatorConfig{}.first_sd);
  };
  EXPECT_FALSE(step(1000, 0.04));
  EXPECT_TRUE(step(1000, 0.025));
  EXPECT_FALSE(step(1070, 0.02));   // within the dead band
  EXPECT_FALSE(step(1085, 0.029));  // within 3 sd
  EXPECT_FALSE(step(1015, 0.004));  // well known, but less than 2 % off
  EXPECT_TRUE(step(1030, 0.004));   // its sd has halved
  EXPECT_EQ(reported.sd(), 0.004);
  EXPECT_FALSE(step(1060, 0.004));       // it has not
  EXPECT_TRUE(step(1060, 0.004, true));  // of another depth
  EXPECT_TRUE(step(1150, 0.004));        // more than the dead band
  EXPECT_FALSE(step(3000, 0.16));        // hardly known
  EXPECT_FALSE(step(1600, 0.06));        // nearly surely wrong
  EXPECT_TRUE(step(3000, 0.09));         // what was told is wrong, surely
  EXPECT_TRUE(step(1150, 0.01));
  EXPECT_EQ(reported.stiffness_n_per_m(), 1150.0);
  reported.begin(true);
  normal = exp_rotation(0.01 * Vector3::UnitZ()) * normal;
  EXPECT_FALSE(step(1150, 0.004));  // a direction that is 1.4 % off in the norm
  normal = exp_rotation(0.01 * Vector3::UnitZ()) * normal;
  EXPECT_TRUE(step(1150, 0.004));  // 2.8 %
  reported.begin(false);
  EXPECT_EQ(reported.stiffness_n_per_m(), 0.0);
}

// A force that changes while the tool does not move gives such values; a report with one would be refused as a
// whole, and the master would receive none.
TEST(ReportedTangent, ReportsNoStiffnessBeyondTheRangeOfAReport) {
  ReportedTangent reported(EstimatorConfig{});
  ContactAnswer answer;
  answer.valid = true;
  answer.depth_m = 1e-14;
  answer.stiffness = {2.8e15, 1e13};
  EXPECT_FALSE(reported.step(answer, Vector3::UnitX(), 1e-14, false, EstimatorConfig{}.first_sd));
  EXPECT_EQ(reported.stiffness_n_per_m(), 0.0);
  answer.stiffness = {kStiffnessMaxNPerM, 1e9};
  EXPECT_TRUE(reported.step(answer, Vector3::UnitX(), 1e-14, false, EstimatorConfig{}.first_sd));
}

TEST(ReportedTangent, KeepsTangentUnlessNoLawFitsBothSlopes) {
  constexpr double kAsked_m = 2e-3;
  const auto after = [&](double stiffness_n_per_m, double depth_m, double fraction) {
    ReportedTangent reported(EstimatorConfig{});
    ContactAnswer answer;
    answer.valid = true;
    answer.depth_m = kAsked_m;
    answer.stiffness = {2000.0, 20.0};
    reported.step(answer, Vector3::UnitX(), kAsked_m, false, EstimatorConfig{}.first_sd);
    answer.depth_m = depth_m;
    answer.stiffness = {stiffness_n_per_m, fraction * stiffness_n_per_m};
    reported.step(answer, Vector3::UnitX(), kAsked_m, false, EstimatorConfig{}.first_sd);
    return reported.stiffness_n_per_m();
  };
  EXPECT_EQ(after(1000.0, 0.5e-3, 0.02), 2000.0);   // n = 1.5 on its way in
  EXPECT_EQ(after(1000.0, 0.5e-3, 0.001), 2000.0);  // however well it is known there
  EXPECT_EQ(after(1000.0, 2e-3, 0.02), 1000.0);     // at the same depth
  EXPECT_EQ(after(6000.0, 0.5e-3, 0.1), 6000.0);    // stiffer though not as deep: another thing
  EXPECT_EQ(after(1000.0, 4e-3, 0.1), 1000.0);      // softer though deeper: likewise
  EXPECT_EQ(after(7000.0, 4e-3, 0.02), 2000.0);     // n < 3
}

}  // namespace
}  // namespace longreach::reported_tangent_test
