#include "slave/sensing/bond_lag.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/core/random.hpp"

namespace longreach::bond_lag_test {
namespace {

constexpr double kDt = 1e-3;
const Vector3 kAlong(0.8, 0.6, 0.0);

/// A load behind a first-order lag on a biased and noisy sensor; the gripper accelerates in jolts of up to `most`.
class Bond {
 public:
  Bond(double mass_kg, double lag_s, double noise_n) : mass_kg_(mass_kg), lag_s_(lag_s) {
    sensing_.force_noise_n = noise_n;
  }
  void go(BondLag& lag, double seconds, double most, bool free = true) {
    for (double t = 0.0; t < seconds; t += kDt) {
      const double phase = std::fmod(t, 0.4);
      const double a = phase < 0.03 ? most : phase >= 0.2 && phase < 0.23 ? -most : 0.0;
      follows_ -= std::expm1(-kDt / lag_s_) * (a - follows_);
      Vector3 force_n = Vector3(0.4, -1.1, 0.7) - mass_kg_ * follows_ * kAlong;
      for (double& f : force_n) f += sensing_.force_noise_n * random_.normal();
      lag.step(force_n, a * kAlong, free, sensing_, kDt);
    }
  }
  [[nodiscard]] const SensingConfig& sensing() const { return sensing_; }

 private:
  double mass_kg_, lag_s_;
  double follows_ = 0.0;
  SensingConfig sensing_{};
  Random random_{5};
};

TEST(BondLag, IsFoundWithinTheStepOfTheBank) {
  for (const double lag_s : {0.003, 0.006, 0.01, 0.02, 0.035}) {
    Bond bond(5.0, lag_s, 0.05);
    BondLag lag;
    bond.go(lag, 4.0, 1.0);
    EXPECT_LT(std::abs(std::log2(lag.lag_s() / lag_s)), 0.5) << lag_s;
  }
}

TEST(BondLag, AStiffBondIsTheQuickestOfTheBank) {
  Bond bond(2.0, 1e-4, 0.05);
  BondLag lag;
  bond.go(lag, 4.0, 1.0);
  EXPECT_NEAR(lag.lag_s(), 0.25 * BondLag::kUsual_s, 1e-9);
}

TEST(BondLag, IsUsualUntilTheForceIsWellAboveTheNoise) {
  for (const double most : {0.0, 0.02}) {
    Bond bond(2.0, 0.035, 0.1);
    BondLag lag;
    bond.go(lag, 4.0, most);
    EXPECT_NEAR(lag.lag_s(), BondLag::kUsual_s, 1e-9) << most;
  }
}

TEST(BondLag, LearnsNothingDuringContact) {
  Bond bond(5.0, 0.035, 0.05);
  BondLag lag;
  bond.go(lag, 4.0, 1.0, false);
  EXPECT_NEAR(lag.lag_s(), BondLag::kUsual_s, 1e-9);
}

TEST(BondLag, FollowsABondThatBecomesSofter) {
  BondLag lag;
  Bond(5.0, 0.005, 0.05).go(lag, 4.0, 1.0);
  Bond(5.0, 0.03, 0.05).go(lag, 60.0, 1.0);
  EXPECT_LT(std::abs(std::log2(lag.lag_s() / 0.03)), 0.5);
}

TEST(BondLag, SamplesThatAreNotFiniteChangeNothing) {
  Bond bond(5.0, 0.02, 0.05);
  BondLag lag;
  bond.go(lag, 4.0, 1.0);
  const double before_s = lag.lag_s();
  for (int i = 0; i < 100; ++i) lag.step({NAN, 0.0, 0.0}, Vector3::Zero(), true, bond.sensing(), kDt);
  for (int i = 0; i < 100; ++i) lag.step(Vector3::Zero(), {0.0, INFINITY, 0.0}, true, bond.sensing(), kDt);
  lag.step(Vector3::Zero(), Vector3::Zero(), true, bond.sensing(), 0.0);
  bond.go(lag, 1.0, 1.0);
  EXPECT_EQ(lag.lag_s(), before_s);
}

}  // namespace
}  // namespace longreach::bond_lag_test
