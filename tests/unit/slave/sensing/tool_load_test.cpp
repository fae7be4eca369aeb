#include "slave/sensing/tool_load.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace longreach::tool_load_test {
namespace {

ToolLoadConfig gripper() { return {3.0, {0.02, -0.05, 0.12}, {0.03, 0.04, 0.01}}; }

/// A smooth motion of the sensor in W.
Pose pose(double t) {
  return {Vector3(0.3 * std::sin(2.0 * t), 0.2 * std::cos(3.0 * t), 0.1 * t * t),
          exp_rotation({std::sin(t), 0.5 * std::cos(2.0 * t), 0.3 * t})};
}

template <class F>
Vector3 slope(const F& f, double t) {
  constexpr double h = 1e-4;
  return (8.0 * (f(t + h) - f(t - h)) - (f(t + 2.0 * h) - f(t - 2.0 * h))) / (12.0 * h);
}

Vector3 angular(double t) {  // ω in W
  constexpr double h = 1e-4;
  const auto turned = [&](double s) -> Vector3 {
    return log_rotation(pose(t + s).q * pose(t - s).q.conjugate()) / (2.0 * s);
  };
  return (4.0 * turned(h) - turned(2.0 * h)) / 3.0;
}

/// Of the sensor at t, all in its own frame.
SensorMotion motion(double t, const Vector3& gravity_W) {
  const Quaternion q = pose(t).q.conjugate();
  const auto velocity = [](double s) { return slope([](double u) { return pose(u).p; }, s); };
  return {q * gravity_W, q * slope(velocity, t), q * angular(t), q * slope(angular, t)};
}

TEST(ToolLoad, IsWhatChangesTheMomentaOfTheTool) {
  const ToolLoadConfig tool = gripper();
  const Vector3 gravity(0.5, -1.0, -9.0);
  const auto com = [&](double t) { return Vector3(pose(t).p + pose(t).q * tool.com_m); };
  const auto spin = [&](double t) {  // angular momentum about the centre of mass, W
    const Quaternion q = pose(t).q;
    return Vector3(q * tool.inertia_kg_m2.cwiseProduct(q.conjugate() * angular(t)));
  };
  const auto com_velocity = [&](double t) { return slope(com, t); };
  for (const double t : {0.1, 0.7, 1.9}) {
    // Newton and Euler in W: what the sensor does to the tool; the tool does the opposite to it.
    const Vector3 force = tool.mass_kg * (slope(com_velocity, t) - gravity);
    const Vector3 moment = slope(spin, t) + (com(t) - pose(t).p).cross(force);
    const Wrench by_tool = tool_wrench(tool, motion(t, gravity));
    EXPECT_LT((pose(t).q * by_tool.force + force).norm(), 1e-5) << t;
    EXPECT_LT((pose(t).q * by_tool.moment + moment).norm(), 1e-5) << t;
  }
}

TEST(SensorMotionEstimate, FollowsASmoothMotion) {
  SensorMotionEstimate estimate;
  const Vector3 gravity(0.0, 0.0, -9.81);
  constexpr double dt = 1e-3;
  SensorMotion reported;
  double t = 0.0;
  for (int n = 0; n < 700; ++n, t += dt) {
    const Twist V{angular(t), slope([](double u) { return pose(u).p; }, t)};
    reported = estimate.step(pose(t).q, V, gravity, 0.0, dt);
  }
  const SensorMotion truth = motion(t - 1.5 * dt, gravity);  // a backward difference is half a sample late
  EXPECT_LT((reported.gravity - motion(t - dt, gravity).gravity).norm(), 1e-9);
  EXPECT_LT((reported.acceleration - truth.acceleration).norm(), 0.01);
  EXPECT_LT((reported.angular_acceleration - truth.angular_acceleration).norm(), 0.01);
}

TEST(SensorMotionEstimate, SaysNothingOfAccelerationAtFirst) {
  SensorMotionEstimate estimate;
  const SensorMotion reported =
      estimate.step(Quaternion::Identity(), {Vector3::Ones(), Vector3::Ones()}, {0, 0, -1}, 0.0, 1e-3);
  EXPECT_EQ(reported.acceleration, Vector3::Zero());
  EXPECT_EQ(reported.angular_acceleration, Vector3::Zero());
}

/// Velocity of the sensor in W.
Twist velocity(double t) {
  return {angular(t), slope([](double u) { return pose(u).p; }, t)};
}

/// What a sensor with this tool and bias reads in W, `t` after it began to move; its acceleration is that of
/// its samples.
class Reading {
 public:
  explicit Reading(const SensingConfig& config) : config_(config) {}
  Wrench at(double t, const Wrench& environment, const Wrench& bias) {
    const Quaternion q = pose(t).q;
    const Wrench tool =
        tool_wrench(config_.tool, motion_.step(q, velocity(t), config_.gravity_m_per_s2, 0.0, 1e-3));
    return {environment.moment + q * (tool.moment + bias.moment),
            environment.force + q * (tool.force + bias.force)};
  }

 private:
  SensingConfig config_;
  SensorMotionEstimate motion_;
};

SensingConfig carried() {
  SensingConfig config;
  config.tool = gripper();
  config.gravity_m_per_s2 = {0.0, 0.0, -9.81};
  return config;
}

TEST(ToolCompensation, LeavesTheEnvironmentsWrench) {
  ToolCompensation compensation(carried());
  Reading reading(carried());
  const Wrench environment{Vector3(0.1, 0.2, -0.3), Vector3(-5.0, 2.0, 1.0)};
  for (int n = 0; n < 500; ++n) {
    const double t = 1e-3 * n;
    const Wrench left = compensation.step(reading.at(t, environment, {}), pose(t).q, velocity(t), 1e-3);
    ASSERT_LT((left.force - environment.force).norm(), 1e-11) << n;
    ASSERT_LT((left.moment - environment.moment).norm(), 1e-11) << n;
  }
}

TEST(ToolCompensation, ZeroesTheBiasWhileTheToolMoves) {
  SensingConfig config = carried();
  config.zero_s = 0.2;
  ToolCompensation compensation(config);
  Reading reading(config);
  const Wrench bias{Vector3(0.02, -0.01, 0.03), Vector3(1.0, -2.0, 0.5)};
  compensation.zero();
  Wrench left;
  for (int n = 0; n < 202; ++n) {
    if (n != 200) {  // 200 ms are 200 samples but for rounding
      EXPECT_EQ(compensation.ready(), n > 200) << n;
    }
    const double t = 1e-3 * n;
    left = compensation.step(reading.at(t, {}, bias), pose(t).q, velocity(t), 1e-3);
  }
  EXPECT_LT(left.force.norm(), 1e-11);
  EXPECT_LT(left.moment.norm(), 1e-11);
  EXPECT_LT((compensation.bias().force - bias.force).norm(), 1e-11);
  EXPECT_LT((compensation.bias().moment - bias.moment).norm(), 1e-11);
}

TEST(ToolCompensation, KeepsTheLastZeroWhenTheNextIsAbandonedOrReadsNonsense) {
  SensingConfig config;
  config.zero_s = 0.01;
  ToolCompensation compensation(config);
  const auto read = [&](int samples, double force_n) {
    for (int n = 0; n < samples; ++n)
      compensation.step({Vector3::Zero(), Vector3(force_n, 0.0, 0.0)}, Quaternion::Identity(), {}, 1e-3);
  };
  compensation.zero();
  read(20, 1.0);
  compensation.zero();
  EXPECT_TRUE(compensation.ready()) << "the last zero holds";
  read(5, 50.0);
  compensation.abandon();
  read(20, 1.0);
  EXPECT_EQ(compensation.bias().force.x(), 1.0);

  compensation.zero();
  read(20, std::nan(""));
  EXPECT_TRUE(compensation.zeroing()) << "nothing was read";
  read(20, 2.0);
  EXPECT_EQ(compensation.bias().force.x(), 2.0);
}

TEST(ToolCompensation, ZeroTakenUnderLoadHidesAtMostItsBound) {
  SensingConfig config;
  config.zero_s = 0.01;
  ToolCompensation compensation(config, {.zero_n = 10.0});
  const auto read = [&](double force_n) {
    compensation.zero();
    for (int n = 0; n < 20; ++n)
      compensation.step({Vector3::Zero(), Vector3(force_n, 0.0, 0.0)}, Quaternion::Identity(), {}, 1e-3);
    return compensation.bias().force.x();
  };
  EXPECT_EQ(read(-30.0), -10.0);
  EXPECT_EQ(read(-4.0), -8.0) << "later zeros move by a fifth";
  EXPECT_EQ(read(-30.0), -12.0);
  EXPECT_EQ(read(-11.0), -11.0);
}

TEST(ToolCompensation, AZeroThatIsAskedForLaterMakesNothingUnready) {
  SensingConfig config;
  ToolCompensation compensation(config);
  config.zero_s = 100.0;
  compensation.configure(config, {.zero_n = 10.0});
  compensation.zero();
  EXPECT_TRUE(compensation.zeroing());
  EXPECT_TRUE(compensation.ready());
}

TEST(ToolCompensation, HandsOnWhatASensorWithoutToolAndZeroReads) {
  ToolCompensation compensation(SensingConfig{});
  compensation.zero();
  EXPECT_TRUE(compensation.ready());
  const Wrench reading{Vector3(0.1, 0.2, 0.3), Vector3(1.0, 2.0, 3.0)};
  const Wrench left = compensation.step(reading, exp_rotation({1.0, 2.0, 3.0}), velocity(0.3), 1e-3);
  EXPECT_EQ(left.force, reading.force);
  EXPECT_EQ(left.moment, reading.moment);
}

// The filtered force that decides on a touch still contains the force of before the load was identified.
TEST(ToolCompensation, TheInertiaOfALoadIsNoTouchWhenItsMassBecomesKnown) {
  SensingConfig config;
  constexpr double kDt = 1e-3, kMass_kg = 12.0;
  for (double phase = 0.0; phase < 3.0; phase += 0.25) {
    ToolCompensation compensation(config, {}, 30.0);
    compensation.grip(true);
    Vector3 filtered_n = Vector3::Zero(), p_m = Vector3::Zero(), v = Vector3::Zero();
    double most = 0.0;
    for (int i = 0; i < 2000; ++i) {
      const double a = i < 400 ? 0.0 : std::sin(8.0 * kDt * (i - 400) + phase);
      v.x() += a * kDt;
      p_m += v * kDt;
      const Wrench left =
          compensation.step({Vector3::Zero(), {-kMass_kg * a, 0.0, 0.0}}, Quaternion::Identity(),
                            {Vector3::Zero(), v}, kDt, {true, {p_m, Quaternion::Identity()}, 0.3});
      filtered_n -= std::expm1(-kDt / config.filter_s) * (left.force - filtered_n);
      most = std::max(most, filtered_n.norm() - compensation.uncertainty_n());
    }
    EXPECT_GT(compensation.load().load().mass_kg, 0.0);
    EXPECT_LT(most, 0.25) << "the least touch threshold, " << phase;
  }
}

TEST(AccelerationPeak, LastsAtLeastThreeTenthsOfASecond) {
  AccelerationPeak peak;
  for (int i = 0; i < 1000; ++i) {
    const double now = i == 0 ? 5.0 : i == 200 ? 3.0 : 0.0;
    peak.step(now, 1e-3);
    const double least = i <= 300 ? 5.0 : i <= 500 ? 3.0 : 0.0, most = i < 400 ? 5.0 : i < 610 ? 3.0 : 0.0;
    EXPECT_GE(peak.m_per_s2(), least) << i;
    EXPECT_LE(peak.m_per_s2(), most) << i;
  }
}

}  // namespace
}  // namespace longreach::tool_load_test
