#include "slave/sensing/load_identifier.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/core/random.hpp"
#include "slave/sensing/tool_load.hpp"

namespace longreach::load_identifier_test {
namespace {

constexpr double kDt = 1e-3, kMost_kg = 30.0;
const Vector3 kAlong(0.8, 0.6, 0.0);

/// A mass on a spring and damper behind a sensor that moves along x and y, without turning.
class Carried {
 public:
  Carried(double mass_kg, const Vector3& com_m, double noise_n, const Vector3& gravity = Vector3::Zero())
      : mass_(mass_kg), com_m_(com_m), noise_n_(noise_n), gravity_(gravity) {
    sensing_.force_noise_n = noise_n;
    sensing_.moment_noise_nm = 0.1 * noise_n;
  }

  /// `seconds` of a hand that goes to and fro with speeds of `v`, or of rest.
  void go(LoadIdentifier& load, double seconds, double v, bool free = true) {
    for (double t = 0.0; t < seconds; t += kDt) {
      // Trapezes of speed: 0.5 s each way, with a ramp of 50 ms.
      const double phase = std::fmod(t, 1.0);
      const double sense = phase < 0.5 ? 1.0 : -1.0, in = std::fmod(phase, 0.5);
      const double speed = v * sense * std::clamp(std::min(in, 0.45 - in) / 0.05, 0.0, 1.0);
      const Vector3 before = velocity_;
      velocity_ = speed * kAlong;
      tool_ += kDt * velocity_;
      const Vector3 bond = kBond * (tool_ - place_) + kDamping * (velocity_ - follows_);
      // Implicit in its own speed, so that light loads are stable.
      const Vector3 faster = (follows_ + kDt / mass_ * (bond + kDamping * follows_ + mass_ * gravity_)) /
                             (1.0 + kDt / mass_ * kDamping);
      Wrench read;
      read.force = mass_ * (gravity_ - (faster - follows_) / kDt);
      follows_ = faster;
      place_ += kDt * follows_;
      read.moment = com_m_.cross(read.force);
      for (int i = 0; i < 3; ++i) {
        read.force[i] += noise_n_ * random_.normal() + bias_n_[i];
        read.moment[i] += 0.1 * noise_n_ * random_.normal();
      }
      SensorMotion motion;
      motion.gravity = gravity_;
      motion.acceleration = (velocity_ - before) / kDt;
      load.step(closed ? read : Wrench{Vector3::Zero(), bias_n_}, motion, free, kDt);
    }
  }

  [[nodiscard]] const SensingConfig& sensing() const { return sensing_; }
  bool closed = true;

 private:
  static constexpr double kBond = 2e4, kDamping = 1500.0;
  double mass_;
  Vector3 com_m_;
  double noise_n_;
  Vector3 gravity_;
  SensingConfig sensing_{};
  Vector3 bias_n_{0.4, -1.1, 0.7};
  Vector3 tool_ = Vector3::Zero(), velocity_ = Vector3::Zero();
  Vector3 place_ = Vector3::Zero(), follows_ = Vector3::Zero();
  Random random_{7};
};

TEST(LoadIdentifier, FindsTheMassAndCentreOfALoadOnItsBond) {
  for (const double mass_kg : {0.5, 2.0, 8.0, 30.0}) {
    Carried carried(mass_kg, {0.06, 0.02, -0.03}, 0.05);
    LoadIdentifier load(carried.sensing(), kMost_kg);
    load.grip(true);
    carried.go(load, 6.0, 0.05);
    ASSERT_TRUE(load.known()) << mass_kg << " kg, told " << load.load().mass_kg << " sd " << load.sd_kg();
    EXPECT_TRUE(load.holds());
    EXPECT_NEAR(load.load().mass_kg, mass_kg, 3.0 * load.sd_kg());
    EXPECT_NEAR(load.load().mass_kg, mass_kg, 0.05 * mass_kg + 0.02);
    // Where it lies along the way is not told by it.
    EXPECT_LT((load.load().com_m - Vector3(0.06, 0.02, -0.03)).cross(kAlong).norm(), 0.02) << mass_kg;
  }
}

// A light load that moves slowly is known within 20 %, not within 10 %. It is reported, with that uncertainty.
TEST(LoadIdentifier, AMassOfThreeStandardDeviationsIsReported) {
  Carried carried(0.6, {0.06, 0.0, 0.0}, 0.05);
  LoadIdentifier load(carried.sensing(), kMost_kg);
  load.grip(true);
  carried.go(load, 0.5, 0.0);
  EXPECT_FALSE(load.measured());
  carried.go(load, 2.5, 0.006);
  ASSERT_FALSE(load.known()) << load.load().mass_kg << " kg, sd " << load.sd_kg();
  EXPECT_TRUE(load.measured());
  EXPECT_NEAR(load.load().mass_kg, 0.6, 3.0 * load.sd_kg());
}

TEST(LoadIdentifier, TheFirstPushBoundsTheMass) {
  Carried carried(5.0, {0.06, 0.0, 0.0}, 0.05);
  LoadIdentifier load(carried.sensing(), kMost_kg);
  EXPECT_EQ(load.bound_kg(), 0.0);
  load.grip(true);
  carried.go(load, 0.4, 0.0);
  EXPECT_NEAR(load.bound_kg(), kMost_kg, 0.1);
  carried.go(load, 0.4, 0.05);
  EXPECT_LT(load.bound_kg(), 0.6 * kMost_kg);
  EXPECT_GE(load.bound_kg(), 5.0);
}

TEST(LoadIdentifier, KnowsNothingOfALoadThatRests) {
  Carried carried(5.0, {0.06, 0.0, 0.0}, 0.05);
  LoadIdentifier load(carried.sensing(), kMost_kg);
  load.grip(true);
  carried.go(load, 20.0, 0.0);
  EXPECT_FALSE(load.known());
  EXPECT_FALSE(load.holds());
  EXPECT_EQ(load.load().mass_kg, 0.0);
  EXPECT_NEAR(load.uncertainty_kg(), kMost_kg, 1.0) << "anything that it may hold";
}

TEST(LoadIdentifier, AGripperThatClosedOnNothingHoldsNothing) {
  Carried carried(1e-3, Vector3::Zero(), 0.05);
  LoadIdentifier load(carried.sensing(), kMost_kg);
  load.grip(true);
  carried.go(load, 6.0, 0.05);
  EXPECT_TRUE(load.known());
  EXPECT_FALSE(load.holds());
}

TEST(LoadIdentifier, AWeightIsKnownAtRest) {
  Carried carried(5.0, {0.06, 0.0, 0.0}, 0.05, {0.0, 0.0, -9.81});
  LoadIdentifier load(carried.sensing(), kMost_kg);
  carried.closed = false;
  carried.go(load, 5.0, 0.0);
  carried.closed = true;
  load.grip(true);
  carried.go(load, 5.0, 0.0);
  ASSERT_TRUE(load.known());
  EXPECT_NEAR(load.load().mass_kg, 5.0, 0.25);
}

// A weight of 49 N that hangs beside the sensor, turned about two of its axes. What is left when it is taken
// out is what the environment would do.
TEST(LoadIdentifier, AWeightThatIsTurnedIsFoundWithItsCentre) {
  const ToolLoadConfig truth{5.0, {0.06, 0.02, -0.03}, Vector3::Constant(0.01)};
  const Vector3 bias_n(0.4, -1.1, 0.7), gravity(0.0, 0.0, -9.81);
  SensingConfig sensing;
  LoadIdentifier load(sensing, kMost_kg);
  Random random(11);
  double left_n = 0.0, left_nm = 0.0;
  for (const bool closed : {false, true}) {
    load.grip(closed);
    for (int i = 0; i < 20000; ++i) {
      const double t = kDt * i, rate = 0.8, most = 0.6;
      const Vector3 axis = std::sin(0.5 * rate * t) < 0.0 ? Vector3::UnitX() : Vector3::UnitY();
      SensorMotion motion;
      motion.gravity = exp_rotation(-most * std::sin(rate * t) * axis) * gravity;
      motion.angular = most * rate * std::cos(rate * t) * axis;
      motion.angular_acceleration = -most * rate * rate * std::sin(rate * t) * axis;
      const Wrench carried = closed ? tool_wrench(truth, motion) : Wrench{};
      Wrench read = carried;
      for (int k = 0; k < 3; ++k) {
        read.force[k] += bias_n[k] + 0.05 * random.normal();
        read.moment[k] += 0.005 * random.normal();
      }
      load.step(read, motion, true, kDt);
      if (!closed || i < 10000) continue;
      const Wrench found = tool_wrench(load.load(), motion);
      left_n = std::max(left_n, (found.force - carried.force).norm());
      left_nm = std::max(left_nm, (found.moment - carried.moment).norm());
    }
  }
  ASSERT_TRUE(load.known());
  EXPECT_NEAR(load.load().mass_kg, 5.0, 3.0 * load.sd_kg());
  EXPECT_NEAR(load.load().mass_kg, 5.0, 0.05);
  EXPECT_LT((load.load().com_m - truth.com_m).norm(), 2e-3);
  EXPECT_LT(left_n, 0.3);
  EXPECT_LT(left_nm, 0.05);
}

// As much noise in an eighth of the samples is 2.8 times the deviation.
TEST(LoadIdentifier, ReckonsWithTheTimeBetweenSamples) {
  const auto sd_kg = [](double dt) {
    SensingConfig sensing;
    sensing.force_noise_n = 20.0;  // so that nothing else counts
    sensing.moment_noise_nm = 2.0;
    LoadIdentifier load(sensing, kMost_kg);
    load.grip(true);
    for (int i = 0; i * dt < 6.0; ++i) {
      SensorMotion motion;
      motion.acceleration.x() = 0.5 * std::sin(3.0 * i * dt);
      load.step({Vector3::Zero(), -0.5 * motion.acceleration}, motion, true, dt);
    }
    return load.sd_kg();
  };
  EXPECT_NEAR(sd_kg(8e-3) / sd_kg(1e-3), std::sqrt(8.0), 0.5);
}

TEST(LoadIdentifier, ForgetsWhatItLetsGo) {
  Carried carried(5.0, {0.06, 0.0, 0.0}, 0.05);
  LoadIdentifier load(carried.sensing(), kMost_kg);
  load.grip(true);
  carried.go(load, 6.0, 0.05);
  load.grip(false);
  EXPECT_EQ(load.load().mass_kg, 0.0);
  EXPECT_EQ(load.uncertainty_kg(), 0.0);
  load.grip(true);
  EXPECT_FALSE(load.known());
}

TEST(LoadIdentifier, LearnsNothingWhileSomethingIsTouched) {
  Carried carried(5.0, {0.06, 0.0, 0.0}, 0.05);
  LoadIdentifier load(carried.sensing(), kMost_kg);
  load.grip(true);
  carried.go(load, 6.0, 0.05, false);
  EXPECT_EQ(load.load().mass_kg, 0.0);
  EXPECT_FALSE(load.known());
}

TEST(LoadIdentifier, NonsenseChangesNothing) {
  Carried carried(5.0, {0.06, 0.0, 0.0}, 0.05);
  LoadIdentifier load(carried.sensing(), kMost_kg);
  load.grip(true);
  carried.go(load, 6.0, 0.05);
  const double before_kg = load.load().mass_kg;
  Wrench nonsense;
  nonsense.force.x() = NAN;
  for (int i = 0; i < 500; ++i) load.step(nonsense, {}, true, kDt);
  EXPECT_EQ(load.load().mass_kg, before_kg);
}

}  // namespace
}  // namespace longreach::load_identifier_test
