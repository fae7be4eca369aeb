// The table of slave/sensing/sensor_watch.hpp, row by row: what no contact could do is not believed, and what
// one could is.
#include "slave/sensing/sensor_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace longreach::sensor_watch_test {
namespace {

constexpr double kDt = 1e-3;

Wrench reading(const Vector3& force_n, const Vector3& moment_nm = Vector3::Zero()) {
  return {moment_nm, force_n};
}

struct Sensor {
  SensingConfig sensing{};
  CommandConfig command{};
  SensorWatch::Motion motion{.elapsed_s = kDt};
  SensorWatch watch{sensing, command};

  void configure() { watch.configure(sensing, command); }
  bool read(const Wrench& wrench, double ms = 1.0, double moves_m = 0.0) {
    motion.elapsed_s = 1e-3 * ms;
    motion.p_WE.x() += moves_m;
    return watch.read(wrench, motion);
  }
};

TEST(SensorWatch, WhatIsNoNumberIsNotBelieved) {
  for (const double value :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Sensor s;
    EXPECT_TRUE(s.read(reading(Vector3(1, 2, 3))));
    EXPECT_FALSE(s.read(reading(Vector3(1, value, 3))));
    EXPECT_FALSE(s.read(reading(Vector3(1, 2, 3), Vector3(0, 0, -value))));
    EXPECT_TRUE(s.read(reading(Vector3(1, 2, 3))));
  }
}

TEST(SensorWatch, EachChannelHasARange) {
  Sensor s;
  s.sensing.force_range_n = 100.0;
  s.sensing.force_resolution_n = 0.5;
  s.sensing.moment_range_nm = 10.0;
  s.sensing.moment_resolution_nm = 0.1;
  s.configure();
  EXPECT_TRUE(s.read(reading(Vector3(100.4, -100.4, 0), Vector3(0, 10.05, -10.05))));
  for (int i = 0; i < 3; ++i) {
    Vector3 beyond = Vector3::Zero();
    beyond[i] = -100.6;
    EXPECT_FALSE(s.read(reading(beyond))) << i;
    beyond[i] = 10.2;
    EXPECT_FALSE(s.read(reading(Vector3::Zero(), beyond))) << i;
  }
}

// 1e5 N and what the tool adds, 2 m (|g| + a); 10 m of that as a moment.
TEST(SensorWatch, ASensorOfUnknownRangeBearsWhatNoArmExceeds) {
  Sensor s;
  s.sensing.tool.mass_kg = 1000.0;
  s.sensing.gravity_m_per_s2 = Vector3(0, 0, -9.81);
  s.command.acceleration_max_m_per_s2 = 2.0;
  s.configure();
  const double most_n = 1e5 + 2000.0 * 11.81;
  EXPECT_TRUE(s.read(reading(Vector3(0, -most_n, 0), Vector3(10.0 * most_n, 0, 0))));
  EXPECT_FALSE(s.read(reading(Vector3(0, -1.001 * most_n, 0))));
  EXPECT_FALSE(s.read(reading(Vector3::Zero(), Vector3(10.01 * most_n, 0, 0))));
}

TEST(SensorWatch, AtTheEndOfItsRangeItIsBelievedForFiftyMilliseconds) {
  Sensor s;
  s.sensing.force_range_n = 100.0;
  s.sensing.force_resolution_n = 0.5;
  s.configure();
  for (int i = 0; i < 49; ++i) ASSERT_TRUE(s.read(reading(Vector3(0, 99.6 + 1e-3 * i, 0)))) << i;
  EXPECT_TRUE(s.read(reading(Vector3(0, 90.0, 0)))) << "a break";
  bool accepted_value = true;
  for (int i = 0; i < 52; ++i) accepted_value = s.read(reading(Vector3(0, -99.6 - 1e-3 * i, 0)));
  EXPECT_FALSE(accepted_value);
  Sensor endless;
  for (int i = 0; i < 200; ++i) ASSERT_TRUE(endless.read(reading(Vector3(0, 99.6, 0)))) << "no range, no end";
}

const Vector3 kFirst_nm(0.1, 0.2, 0.3);

Wrench varying_moment(const Vector3& force_n, int i) {
  return reading(force_n, (1.0 + 0.01 * i) * kFirst_nm);
}

TEST(SensorWatch, FrozenIsWhatStaysTheSameWhileTheToolGoesOn) {
  struct Case {
    const char* what;
    double noise_n, resolution_n, force_n, moves_m;
    bool accepted_value;
  };
  for (const Case& c :
       {Case{"frozen", 0.05, 0.0, 3.0, 1e-4, false}, Case{"at rest", 0.05, 0.0, 3.0, 1e-6, true},
        Case{"frozen at zero", 0.05, 0.0, 0.0, 1e-4, false},
        Case{"without noise it may repeat", 0.0, 0.0, 3.0, 1e-4, true},
        Case{"coarse digits repeat", 0.05, 0.11, 3.0, 1e-4, true}}) {
    Sensor s;
    s.sensing.force_noise_n = c.noise_n;
    s.sensing.force_resolution_n = c.resolution_n;
    s.configure();
    ASSERT_TRUE(s.read(reading(Vector3(1, 2, 3), kFirst_nm)));
    for (int i = 0; i < 45; ++i)
      ASSERT_TRUE(s.read(varying_moment(c.force_n * Vector3(1, -1, 0.5), i), 1.0, c.moves_m)) << c.what << i;
    bool accepted_value = true;
    for (int i = 0; i < 20; ++i)
      accepted_value =
          s.read(varying_moment(c.force_n * Vector3(1, -1, 0.5), i), 1.0, c.moves_m) && accepted_value;
    EXPECT_EQ(accepted_value, c.accepted_value) << c.what;
    EXPECT_TRUE(s.read(reading(Vector3(1, 2, 3), kFirst_nm), 1.0, c.moves_m)) << c.what << ": it has changed";
  }
  Sensor slow;  // 50 ms and 1 mm, both
  EXPECT_TRUE(slow.read(reading(Vector3(0, 2, 3))));
  EXPECT_TRUE(slow.read(reading(Vector3(1, 2, 3))));
  EXPECT_TRUE(slow.read(reading(Vector3(1, 2, 3)), 20.0, 0.01)) << "not long";
  EXPECT_FALSE(slow.read(reading(Vector3(1, 2, 3)), 40.0));
}

// The adapter repeats the last force in W while the tool turns, or the sensor repeats it in its own axes.
TEST(SensorWatch, RepeatedForceIsFrozenInEitherFrame) {
  for (const bool in_W : {true, false}) {
    Sensor s;
    ASSERT_TRUE(s.read(varying_moment(Vector3(3, 2, 1), 0)));
    bool accepted = true;
    for (int i = 1; i < 100; ++i) {
      s.motion.q_WE = exp_rotation(1e-3 * i * Vector3(0, 0.6, 0.8));
      const Vector3 force_n = in_W ? s.motion.q_WE.conjugate() * Vector3(1, 2, 3) : Vector3(1, 2, 3);
      accepted = s.read(varying_moment(force_n, i), 1.0, 1e-4) && accepted;
    }
    EXPECT_FALSE(accepted) << in_W;
  }
}

// A sensor, or one of its six channels, that stops varying while the tool is at rest.
TEST(SensorWatch, ChannelThatRepeatsForAQuarterSecondIsStuck) {
  for (int channel = -1; channel < 6; ++channel) {
    for (const double last : {0.0, 5.0}) {
      Sensor s;
      int accepted_ms = -1;
      for (int i = 0; i < 1000 && accepted_ms < 0; ++i) {
        Vector6 w = Vector6::NullaryExpr(
            [i](Eigen::Index k) { return std::sin(1.0 + i * (2.0 + static_cast<double>(k))); });
        if (i >= 100 && channel < 0) w = last * Vector6::Ones();
        if (i >= 100 && channel >= 0) w[channel] = last;
        if (!s.read({w.tail<3>(), w.head<3>()})) accepted_ms = i - 100;
      }
      EXPECT_NEAR(accepted_ms, 251, 2) << channel;
    }
  }
}

// A stall of the adapter, or one that delivers 125 times a second, repeats whole samples.
TEST(SensorWatch, RepeatedSamplesOfASlowAdapterAreAccepted) {
  for (const int each_ms : {8, 100, 200}) {
    Sensor s;
    for (int i = 0; i < 2000; ++i) {
      const double x = std::sin(1.0 + i / each_ms);
      ASSERT_TRUE(s.read(reading(Vector3(x, 2 * x, 3 * x), Vector3(x, -x, x)), 1.0, 1e-6)) << each_ms;
    }
  }
  Sensor frozen_slave;  // one tick after a second
  EXPECT_TRUE(frozen_slave.read(reading(Vector3(1, 2, 3), Vector3(1, 2, 3))));
  EXPECT_TRUE(frozen_slave.read(reading(Vector3(2, 1, 3), Vector3(2, 2, 3))));
  EXPECT_TRUE(frozen_slave.read(reading(Vector3(2, 1, 3), Vector3(2, 2, 3)), 1000.0));
}

TEST(SensorWatch, ConstantSensorIsNotUsed) {
  struct Case {
    const char* what;
    double force_noise_n, moment_noise_nm, resolution_n;
    bool force, moment, force_varies, moment_varies;
    double value;  // -1: it is used
  };
  for (const Case& c : {Case{"six axes", 0.05, 0.005, 0.0, true, true, true, true, -1},
                        Case{"zero for ever", 0.05, 0.005, 0.0, true, true, false, false, 0},
                        Case{"three axes", 0.05, 0.005, 0.0, true, true, true, false, 1},
                        Case{"three axes, reported", 0.05, 0.005, 0.0, true, false, true, false, -1},
                        Case{"no sensor, reported", 0.05, 0.005, 0.0, false, true, false, false, -1},
                        Case{"simulated without noise", 0.0, 0.0, 0.0, true, true, false, false, -1},
                        Case{"coarse", 0.05, 0.0, 0.2, true, true, false, false, -1}}) {
    for (const double at_n : {0.0, -7.0}) {
      Sensor s;
      s.sensing.force_noise_n = c.force_noise_n;
      s.sensing.moment_noise_nm = c.moment_noise_nm;
      s.sensing.force_resolution_n = c.resolution_n;
      s.sensing.force = c.force;
      s.sensing.moment = c.moment;
      s.watch = SensorWatch(s.sensing, s.command);
      for (int i = 0; i < 500; ++i) {
        const Vector3 n = Vector3::Constant(at_n + (c.force_varies ? 1e-3 * i : 0.0));
        const Vector3 nm = Vector3::Constant(0.1 * at_n + (c.moment_varies ? 1e-3 * i : 0.0));
        ASSERT_TRUE(s.read(reading(n, nm), 1.0, 1e-4)) << c.what;
        if (i == 1 && c.value < 0) {
          EXPECT_EQ(s.watch.constant(), HoldCause::kNone) << c.what;
        }
        if (i == 100 && c.value >= 0) {
          EXPECT_EQ(s.watch.constant(), HoldCause::kSensorZeroing) << c.what;
        }
      }
      const Reason why = s.watch.constant();
      EXPECT_EQ(why, c.value < 0 ? HoldCause::kNone : HoldCause::kSensorConstant) << c.what;
      if (c.value >= 0) {
        EXPECT_EQ(why.value, c.value) << c.what;
      }
    }
  }
}

// G + 10 sigma + 2 r + u + T (1e7 N/m v + k_max 0.1 m/s)
TEST(SensorWatch, NoContactLeapsByMoreThanHardnessAndWay) {
  for (const double speed : {0.0, 0.05}) {
    for (const double ms : {1.0, 10.0}) {
      Sensor s;
      s.sensing.force_resolution_n = 0.25;
      s.configure();
      s.motion.speed_m_per_s = speed;
      s.motion.elapsed_s = 1e-3 * ms;
      constexpr double kUncertainty_n = 2.0;
      const double leap_n = 20.0 + 0.5 + 0.5 + kUncertainty_n + 1e-3 * ms * (1e7 * speed + 2e3);
      const Vector3 n = Vector3(1, 2, -2) / 3.0;
      EXPECT_TRUE(s.watch.felt(1e4 * n, s.motion, kUncertainty_n)) << "what is first felt may be anything";
      EXPECT_TRUE(s.watch.felt((1e4 + 0.999 * leap_n) * n, s.motion, kUncertainty_n));
      EXPECT_FALSE(s.watch.felt((1e4 + 2.0 * leap_n) * n, s.motion, kUncertainty_n));
      EXPECT_TRUE(s.watch.felt(Vector3::Zero(), s.motion, kUncertainty_n))
          << "an edge, a latch: gone at once";
      EXPECT_TRUE(s.watch.felt(0.999 * leap_n * n, s.motion, kUncertainty_n));
      EXPECT_TRUE(s.watch.felt(-0.999 * leap_n * n, s.motion, kUncertainty_n))
          << "another contact, from none";
      EXPECT_FALSE(s.watch.felt(1.001 * leap_n * n, s.motion, kUncertainty_n));
      EXPECT_TRUE(s.watch.felt(0.3 * leap_n * n, s.motion, kUncertainty_n)) << "less";
    }
  }
}

TEST(SensorWatch, WhatIsConfiguredCountsFromThenOn) {
  Sensor s;
  EXPECT_TRUE(s.read(reading(Vector3(60, 0, 0))));
  s.sensing.force_range_n = 50.0;
  s.configure();
  EXPECT_FALSE(s.read(reading(Vector3(60, 0, 0))));
}

}  // namespace
}  // namespace longreach::sensor_watch_test
