#include "slave/simulation/force_sensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace longreach::force_sensor_test {
namespace {

SensingConfig perfect() {
  SensingConfig config;
  config.force_noise_n = config.moment_noise_nm = 0.0;
  return config;
}

const Wrench kWrench{Vector3(0.1, -0.2, 0.3), Vector3(1.0, -2.0, 30.0)};

TEST(ForceSensor, TellsTheTruthWithoutFaults) {
  ForceSensor sensor(perfect(), Random(1));
  const Wrench reading = sensor.step(kWrench, 1e-3);
  EXPECT_EQ(reading.force, kWrench.force);
  EXPECT_EQ(reading.moment, kWrench.moment);
}

TEST(ForceSensor, HasNoiseOfTheDeviationThatIsAskedFor) {
  SensingConfig config = perfect();
  config.force_noise_n = 0.5;
  config.moment_noise_nm = 0.02;
  ForceSensor sensor(config, Random(2));
  constexpr int kSamples = 20000;
  double force2 = 0.0, moment2 = 0.0;
  for (int n = 0; n < kSamples; ++n) {
    const Wrench w = sensor.step(kWrench, 1e-3);
    force2 += (w.force - kWrench.force).squaredNorm() / 3.0;
    moment2 += (w.moment - kWrench.moment).squaredNorm() / 3.0;
  }
  EXPECT_NEAR(std::sqrt(force2 / kSamples), 0.5, 0.01);
  EXPECT_NEAR(std::sqrt(moment2 / kSamples), 0.02, 4e-4);
}

TEST(ForceSensor, ApproachesAStepWithItsBandwidth) {
  SensingConfig config = perfect();
  config.bandwidth_hz = 100.0;
  ForceSensor sensor(config, Random(3));
  sensor.step({}, 1e-3);
  Wrench w;
  for (int n = 0; n < 5; ++n) w = sensor.step(kWrench, 1e-3);
  const double share = 1.0 - std::exp(-2.0 * std::numbers::pi * 100.0 * 5e-3);
  EXPECT_LT((w.force - share * kWrench.force).norm(), 1e-12);
  EXPECT_LT((w.moment - share * kWrench.moment).norm(), 1e-12);
}

TEST(ForceSensor, StartsWithItsBiasAndDriftsWithTheRootOfTime) {
  SensingConfig config = perfect();
  config.force_bias_n = 0.7;
  config.moment_bias_nm = -0.1;
  ForceSensor still(config, Random(4));
  EXPECT_LT((still.step({}, 1e-3).force - Vector3::Constant(0.7)).norm(), 1e-15);
  EXPECT_LT((still.step({}, 1e-3).moment - Vector3::Constant(-0.1)).norm(), 1e-15);

  config.force_drift_n = 0.2;
  double after2 = 0.0;
  constexpr int kRuns = 400;
  for (int run = 0; run < kRuns; ++run) {
    ForceSensor sensor(config, Random(5).child(std::to_string(run)));
    for (int n = 0; n < 400; ++n) sensor.step({}, 0.01);
    after2 += (sensor.bias().force - Vector3::Constant(0.7)).squaredNorm() / 3.0;
    EXPECT_EQ(sensor.bias().moment, Vector3::Constant(-0.1));
  }
  EXPECT_NEAR(std::sqrt(after2 / kRuns), 0.2 * std::sqrt(4.0), 0.03);
}

TEST(ForceSensor, TellsStepsOfItsResolutionUpToItsRange) {
  SensingConfig config = perfect();
  config.force_resolution_n = 0.25;
  config.force_range_n = 20.0;
  ForceSensor sensor(config, Random(6));
  const Wrench reading = sensor.step({Vector3::Zero(), Vector3(0.3, -0.13, 30.0)}, 1e-3);
  EXPECT_EQ(reading.force, Vector3(0.25, -0.25, 20.0));
  EXPECT_EQ(sensor.step({Vector3::Zero(), Vector3(0.0, -25.0, 0.0)}, 1e-3).force, Vector3(0.0, -20.0, 0.0));
}

TEST(ForceSensor, KeepsWhatItFeltWhenTheTruthIsNoNumber) {
  SensingConfig config = perfect();
  config.bandwidth_hz = 50.0;
  ForceSensor sensor(config, Random(7));
  const Wrench before = sensor.step(kWrench, 1e-3);
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    const Wrench w = sensor.step({Vector3(0.0, bad, 0.0), kWrench.force}, 1e-3);
    EXPECT_EQ(w.force, before.force);
    EXPECT_EQ(w.moment, before.moment);
  }
}

}  // namespace
}  // namespace longreach::force_sensor_test
