// The table of slave/sensing/sensor_watch.hpp, row by row: what no contact could do is not believed, and what
// one could is.
#include "slave/sensing/sensor_watch.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace longreach {
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

TEST(SensorWatch, FrozenIsWhatStaysTheSameWhileTheToolGoesOn) {
  struct Case {
    const char* what;
    double noise_n, resolution_n, force_n, moves_m;
    bool accepted_value;
  };
  for (const Case& c :
       {Case{"frozen", 0.05, 0.0, 3.0, 1e-4, false}, Case{"at rest", 0.05, 0.0, 3.0, 1e-6, true},
        Case{"nothing is felt", 0.05, 0.0, 0.0, 1e-4, true},
        Case{"without noise it may repeat", 0.0, 0.0, 3.0, 1e-4, true},
        Case{"coarse digits repeat", 0.05, 0.11, 3.0, 1e-4, true}}) {
    Sensor s;
    s.sensing.force_noise_n = c.noise_n;
    s.sensing.force_resolution_n = c.resolution_n;
    s.configure();
    for (int i = 0; i < 45; ++i)
      ASSERT_TRUE(s.read(reading(c.force_n * Vector3(1, -1, 0.5)), 1.0, c.moves_m));
    bool accepted_value = true;
    for (int i = 0; i < 20; ++i)
      accepted_value = s.read(reading(c.force_n * Vector3(1, -1, 0.5)), 1.0, c.moves_m) && accepted_value;
    EXPECT_EQ(accepted_value, c.accepted_value) << c.what;
    EXPECT_TRUE(s.read(reading(Vector3(1, 2, 3)), 1.0, c.moves_m)) << c.what << ": it has changed";
  }
  Sensor slow;  // 50 ms and 1 mm, both
  EXPECT_TRUE(slow.read(reading(Vector3(1, 2, 3))));
  EXPECT_TRUE(slow.read(reading(Vector3(1, 2, 3)), 20.0, 0.01)) << "not long";
  EXPECT_FALSE(slow.read(reading(Vector3(1, 2, 3)), 40.0));
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
}  // namespace longreach
