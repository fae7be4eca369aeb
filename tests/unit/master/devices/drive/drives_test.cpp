#include "master/devices/drive/drives.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace longreach::drives_test {
namespace {

constexpr DriveConfig kIdeal{.inertia_kg_m2 = 0.0,
                             .viscous_nm_s_per_rad = 0.0,
                             .coulomb_nm = 0.0,
                             .resolution_rad = 0.0,
                             .torque_max_nm = 1.0,
                             .bandwidth_hz = 0.0};

TEST(Drives, LimitTheTorqueAndAskForNothingWhereItIsNotFinite) {
  Drives drives(kIdeal, 0);
  drives.command({0.5, 3.0, -1e300});
  EXPECT_EQ(drives.run(1e-3), Vector3(0.5, 1.0, -1.0));
  drives.command({0.5, std::nan(""), 0.0});
  EXPECT_EQ(drives.run(1e-3), Vector3::Zero());
  drives.command({std::numeric_limits<double>::infinity(), 0.0, 0.0});
  EXPECT_EQ(drives.run(1e-3), Vector3::Zero());
}

TEST(Drives, LetACommandWaitItsSamples) {
  for (const std::uint32_t delay : {0u, 1u, 3u}) {
    Drives drives(kIdeal, delay);
    for (int k = 1; k <= 6; ++k) {
      drives.command(Vector3::Constant(0.1 * k));
      EXPECT_EQ(drives.run(1e-3).x(), 0.1 * std::max(0, k - static_cast<int>(delay))) << delay;
    }
  }
}

TEST(Drives, GiveTheMeanTorqueOfAFirstOrderLag) {
  DriveConfig config = kIdeal;
  config.bandwidth_hz = 100.0;
  const double lag_s = 1.0 / (2.0 * std::numbers::pi * 100.0);
  Drives drives(config, 0);
  drives.command(Vector3::Constant(1.0));
  // Integral of 1 - exp(-t/lag) over each millisecond.
  for (int k = 0; k < 5; ++k) {
    const double a = k * 1e-3, b = a + 1e-3;
    const double mean = 1.0 + lag_s * (std::exp(-b / lag_s) - std::exp(-a / lag_s)) / 1e-3;
    EXPECT_NEAR(drives.run(1e-3).x(), mean, 1e-12) << k;
  }
}

TEST(Drives, HoldBelowCoulombFrictionAndDissipateBeyond) {
  DriveConfig config = kIdeal;
  config.coulomb_nm = 0.01;
  Drives drives(config, 0);
  EXPECT_EQ(drives.friction(Vector3::Zero()), Vector3::Zero());
  const double held = drives.friction(Vector3::Constant(1e-4)).x();
  for (int i = 0; i < 1000; ++i) EXPECT_NEAR(drives.friction(Vector3::Constant(1e-4)).x(), held, 1e-16);
  EXPECT_LT(std::abs(held), 0.01);
  // There and back: the friction takes 2 x torque x way, less what the elastic range returns.
  double work_j = 0.0, theta = 1e-4;
  const auto go = [&](double to) {
    const double step = (to - theta) / 1000.0;
    for (int i = 0; i < 1000; ++i) {
      const double before = drives.friction(Vector3::Constant(theta)).x();
      theta += step;
      work_j += 0.5 * (before + drives.friction(Vector3::Constant(theta)).x()) * step;
    }
  };
  go(0.1);
  work_j = 0.0;  // now slipping
  go(0.6);
  EXPECT_NEAR(work_j, -0.01 * 0.5, 1e-12);
}

TEST(Drives, RoundTheAnglesToTheEncodersResolution) {
  DriveConfig config = kIdeal;
  config.resolution_rad = 1e-3;
  const Drives drives(config, 0);
  EXPECT_LT((drives.encoder({0.01249, -0.0125001, 0.0}) - Vector3(0.012, -0.013, 0.0)).norm(), 1e-15);
  EXPECT_EQ(Drives(kIdeal, 0).encoder({0.01249, -1.0, 2.0}), Vector3(0.01249, -1.0, 2.0));
}

}  // namespace
}  // namespace longreach::drives_test
