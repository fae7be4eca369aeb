#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "common/core/random.hpp"
#include "slave/estimation/contact.hpp"
#include "tests/unit/slave/space_arm.hpp"

namespace longreach::contact_test {
namespace {

constexpr double kDt = 1e-3;

// A tool that is moved against a Hunt-Crossley wall at x = 0.1 m; the force law is written out here on its
// own.
struct Bench {
  double stiffness_n_per_m = 1000.0;  // secant at 1 mm
  double n = 1.0;
  double a = 0.1;
  double noise_n = 0.05;
  Random random{1};
  double x_m = 0.1 - 1e-3;
  double v_m_per_s = 0.0;

  double depth(double force) const { return 1e-3 * std::pow(force / (1e-3 * stiffness_n_per_m), 1.0 / n); }
  double secant(double depth_m) const { return stiffness_n_per_m * std::pow(depth_m / 1e-3, n - 1.0); }
  double tangent_at(const Vector3& p_WE) const { return n * secant(p_WE.x() - 0.1); }
  double force() const {
    const double p = x_m - 0.1;
    return p > 0.0 ? std::max(0.0, secant(p) * p * (1.0 + a * v_m_per_s)) : 0.0;
  }
  void step(SlaveContact& contact, double v) {
    v_m_per_s = v;
    x_m += v * kDt;
    const Vector3 noise(noise_n * random.normal(), noise_n * random.normal(), noise_n * random.normal());
    contact.step({Vector3(x_m, 3.0, -1.0), Vector3(v, 0, 0), Vector3(-force(), 0, 0) + noise, 0.0, 1.0, kDt});
  }
};

struct Walls {
  double stiffness, n, force, speed;
};

void PrintTo(const Walls& w, std::ostream* out) {
  *out << "k " << w.stiffness << " n " << w.n << " F " << w.force << " v " << w.speed;
}

EstimatorConfig free_exponent() {
  EstimatorConfig config;
  config.kind = EstimatorKind::kMaximumLikelihood;
  return config;
}

class ContactAccuracy : public testing::TestWithParam<Walls> {};

TEST_P(ContactAccuracy, SettlesWithinThreePercentAndFindsTheSurface) {
  const Walls wall = GetParam();
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Bench bench{wall.stiffness, wall.n, 0.1, 0.05, Random(seed)};
    // n is known: then a light press tells more.
    EstimatorConfig config;
    config.kind = EstimatorKind::kFixedExponent;
    config.exponent = wall.n;
    SlaveContact contact(SensingConfig{}, config);
    const double rest = 0.1 + bench.depth(wall.force);
    double touched = -1.0, surface_error = 1.0, t = 0.0;
    const auto tick = [&](double v) {
      bench.step(contact, v);
      t += kDt;
      if (touched < 0.0 && contact.in_contact()) touched = t;
      if (touched > 0.0 && t - touched < 1.0) surface_error = contact.foremost().depth_of({0.1, 3.0, -1.0});
    };
    // The approach ends smoothly, then tenths of a millimetre about the force at 0.25 Hz.
    while (bench.x_m < rest - 2e-5) tick(std::min(wall.speed, std::max(4.0 * (rest - bench.x_m), 1e-5)));
    const double amplitude = std::min(3e-4, 0.5 * (rest - 0.1));
    const double w = 2 * test::kPi * 0.25;
    for (int i = 0; i < 12000; ++i) tick(amplitude * w * std::cos(w * i * kDt));

    const double truth = bench.tangent_at(contact.foremost().reported_at_m());
    EXPECT_NEAR(contact.foremost().reported().stiffness_n_per_m() / truth, 1.0, 0.03) << "seed " << seed;
    const double allowed = wall.stiffness < 2000.0 ? 1e-4 : 3e-5;
    EXPECT_LT(std::abs(surface_error), allowed) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Walls, ContactAccuracy,
                         testing::Values(Walls{500, 1, 0.6, 1e-3}, Walls{500, 1, 3, 2e-3},
                                         Walls{1000, 1, 1.5, 1e-3}, Walls{5000, 1, 0.6, 2e-3},
                                         Walls{5000, 1, 3, 2e-3}, Walls{500, 1.5, 1.0, 1e-3},
                                         Walls{500, 1.5, 3, 2e-3}, Walls{5000, 1.5, 0.6, 1e-3},
                                         Walls{5000, 1.5, 3, 2e-3}));

/// RMS over noise and materials of the error over its sd, after so many ticks; a is drawn with sd `a_sd`,
/// s/m.
double honesty(const EstimatorConfig& config, double n, double a_sd, int ticks) {
  double squares = 0.0;
  constexpr int kSeeds = 100;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const double a = a_sd * std::abs(Random(seed).child("material").normal());
    Bench bench{1000.0, n, a, 0.05, Random(seed)};
    SlaveContact contact(SensingConfig{}, config);
    for (int i = 0; i < ticks; ++i) {
      const double w = 2 * test::kPi * 0.5;
      bench.step(contact, i < 2000 ? 1.5e-3 * (1.0 - i / 2000.0) + 1e-3 : 2e-4 * w * std::cos(w * i * kDt));
    }
    const ContactEstimate e = contact.foremost().estimate();
    EXPECT_TRUE(e.valid) << "seed " << seed;
    const double truth = n * bench.secant(bench.x_m - 0.1);
    squares += std::pow((e.stiffness_n_per_m - truth) / e.stiffness_sd_n_per_m, 2);
  }
  return std::sqrt(squares / kSeeds);
}

// a is presumed to be 0 ± 2.5 s/m. Of materials that are more viscous than that it holds once the speed has
// changed.
TEST(SlaveContact, ItsStandardDeviationIsHonest) {
  for (const double n : {1.0, 1.5}) {
    EstimatorConfig given;
    given.kind = EstimatorKind::kFixedExponent;
    given.exponent = n;
    for (const EstimatorConfig& config : {given, free_exponent()}) {
      for (const double a_sd : {3.0, 10.0}) {
        for (const int ticks : {1500, 4000, 9000}) {
          if (a_sd > 3.0 && ticks < 4000) continue;
          const double rms = honesty(config, n, a_sd, ticks);
          const std::string what = std::string(name_of(config.kind)) + " n " + std::to_string(n) + " a " +
                                   std::to_string(a_sd) + " after " + std::to_string(ticks);
          // No exponent is below 1: a free one errs to one side there.
          const bool bounded = n == 1.0 && config.kind == EstimatorKind::kMaximumLikelihood;
          EXPECT_GT(rms, bounded ? 0.4 : 0.5) << what;
          EXPECT_LT(rms, 2.0) << what;
          RecordProperty(what, std::to_string(rms));
        }
      }
    }
  }
}

// Ten minutes of a still hold on encoder steps, with the shortest memory that may be configured.
TEST(SlaveContact, AStillQuantisedHoldWindsNothingUp) {
  for (const double forgetting : {0.9998, 0.99}) {
    Bench bench{1000.0, 1.5, 0.1, 0.05, Random(3)};
    EstimatorConfig config = free_exponent();
    config.forgetting = forgetting;
    SlaveContact contact(SensingConfig{}, config);
    for (int i = 0; i < 3000; ++i) bench.step(contact, 1e-3);
    for (int i = 0; i < 8000; ++i) bench.step(contact, 3e-4 * std::cos(2 * test::kPi * 0.5 * i * kDt));
    bench.noise_n = 0.0;
    for (int i = 0; i < 4000; ++i) bench.step(contact, 0.0);
    const ContactEstimate before = contact.foremost().estimate();
    const double reported = contact.foremost().reported().stiffness_n_per_m();
    ASSERT_TRUE(before.valid);
    for (int i = 0; i < 600000; ++i) bench.step(contact, 0.0);
    const ContactEstimate after = contact.foremost().estimate();
    ASSERT_TRUE(std::isfinite(after.stiffness_n_per_m)) << forgetting;
    EXPECT_NEAR(after.stiffness_n_per_m / before.stiffness_n_per_m, 1.0, 0.01) << forgetting;
    EXPECT_EQ(contact.foremost().reported().stiffness_n_per_m(), reported) << forgetting;
    EXPECT_TRUE(after.valid);
  }
}

TEST(SlaveContact, ANoisyHoldKeepsTheReportedValue) {
  Bench bench{1000.0, 1.0, 0.1, 0.05, Random(4)};
  SlaveContact contact(SensingConfig{}, free_exponent());
  for (int i = 0; i < 3500; ++i) bench.step(contact, 1e-3);
  for (int i = 0; i < 8000; ++i) bench.step(contact, 3e-4 * std::cos(2 * test::kPi * 0.5 * i * kDt));
  const double reported = contact.foremost().reported().stiffness_n_per_m();
  ASSERT_GT(reported, 0.0);
  for (int i = 0; i < 300000; ++i) bench.step(contact, 0.0);
  EXPECT_EQ(contact.foremost().reported().stiffness_n_per_m(), reported);
  EXPECT_NEAR(contact.foremost().estimate().stiffness_n_per_m, 1000.0, 30.0);
}

TEST(SlaveContact, SaysThatDampingIsUnknownUntilItIsExcited) {
  Bench quiet{1000.0, 1.0, 2.0, 0.05, Random(5)};
  SlaveContact contact(SensingConfig{}, free_exponent());
  for (int i = 0; i < 4000; ++i) quiet.step(contact, 1e-3);
  EXPECT_NE(contact.foremost().estimate().lambda_verdict, Verdict::kIdentified);

  Bench shaken{1000.0, 1.0, 2.0, 0.05, Random(5)};
  SlaveContact other(SensingConfig{}, free_exponent());
  for (int i = 0; i < 9000; ++i) {
    const double w = 2 * test::kPi * 2.0;
    shaken.step(other, i < 4500 ? 1e-3 : 2e-3 * w * std::cos(w * i * kDt));
  }
  EXPECT_EQ(other.foremost().estimate().lambda_verdict, Verdict::kIdentified);
  EXPECT_NEAR(other.foremost().estimate().lambda / other.foremost().estimate().k, 2.0, 0.4);
  EXPECT_NEAR(other.foremost().estimate().stiffness_n_per_m, 1000.0, 20.0);
}

TEST(SlaveContact, SurvivesEveryScaleAndExponent) {
  for (const double k : {1e1, 1e3, 1e5, 1e8}) {
    for (const double n : {1.0, 2.0, 3.0}) {
      Bench bench{k, n, 0.0, 0.05, Random(6)};
      SlaveContact contact(SensingConfig{}, free_exponent());
      const double rest = bench.depth(3.0);
      bench.x_m = 0.1;
      for (int i = 0; i < 6000; ++i)
        bench.step(contact, rest / 3.0 * (i < 3000 ? 1.0 : 0.3 * std::cos(i * 3e-3)));
      const ContactEstimate e = contact.foremost().estimate();
      ASSERT_TRUE(e.valid) << "k " << k << " n " << n;
      EXPECT_NEAR(e.stiffness_n_per_m / (n * bench.secant(bench.x_m - 0.1)), 1.0, 0.03)
          << "k " << k << " n " << n;
    }
  }
}

TEST(SlaveContact, LeavesOutWhatIsNotFinite) {
  Bench bench{1000.0, 1.0, 0.1, 0.0, Random(8)};
  SlaveContact contact(SensingConfig{}, free_exponent());
  for (int i = 0; i < 4000; ++i) bench.step(contact, 1e-3);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const Vector3 p(bench.x_m, 3.0, -1.0), v(1e-3, 0.0, 0.0), f(-bench.force(), 0.0, 0.0);
  for (const double bad : {nan, inf, -inf, 1e300}) {
    contact.step({Vector3(bad, 3.0, -1.0), v, f, 0.0, 1.0, kDt});
    contact.step({p, Vector3(bad, 0.0, 0.0), f, 0.0, 1.0, kDt});
  }
  contact.step({p, v, Vector3(nan, 0.0, 0.0), 0.0, 1.0, kDt});
  contact.step({p, v, Vector3(inf, 0.0, 0.0), 0.0, 1.0, kDt});
  for (int i = 0; i < 1000; ++i) bench.step(contact, 2e-4);
  EXPECT_NEAR(contact.foremost().estimate().stiffness_n_per_m, 1000.0, 1.0);
}

// A first guess of the surface may lie anywhere: it must neither be held for a hold nor keep the fit away.
TEST(SlaveContact, IsKnownSoonWhateverTheNoiseOfTheTouch) {
  for (const double n : {1.0, 1.5, 2.0}) {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
      Bench bench{500.0, n, 0.1, 0.05, Random(seed)};
      SlaveContact contact(SensingConfig{}, free_exponent());
      while (bench.force() < 3.0) bench.step(contact, 1.6e-3);
      ASSERT_GT(contact.foremost().reported().stiffness_n_per_m(), 0.0) << "n " << n << " seed " << seed;
      const double truth = bench.tangent_at(contact.foremost().reported_at_m());
      EXPECT_NEAR(contact.foremost().reported().stiffness_n_per_m() / truth, 1.0, 0.15)
          << "n " << n << " seed " << seed;
    }
  }
}

/// Presses until 2 N, probes at up to `speed`, m/s, then what is touched becomes `other` N/m.
void exchange(Bench& bench, SlaveContact& contact, double speed, double other, double seconds) {
  while (bench.force() < 2.0) bench.step(contact, 2e-3);
  const auto probe = [&](double duration_s) {
    for (double t = 0.0; t < duration_s; t += kDt) {
      bench.step(contact, speed * std::cos(2 * test::kPi * 0.5 * t));
    }
  };
  probe(4.0);
  EXPECT_NEAR(contact.foremost().reported().stiffness_n_per_m(), bench.stiffness_n_per_m,
              0.1 * bench.stiffness_n_per_m);
  bench.stiffness_n_per_m = other;
  probe(seconds);
}

// By a tenth of a millimetre.
TEST(SlaveContact, FindsAnotherObjectUnderTheTool) {
  for (const EstimatorKind kind : kEstimatorKinds) {
    for (const double other : {300.0, 4000.0, 20000.0}) {
      Bench bench{1000.0, 1.0, 0.1, 0.05, Random(9)};
      EstimatorConfig config;
      config.kind = kind;
      SlaveContact contact(SensingConfig{}, config);
      exchange(bench, contact, 4e-4, other, 3.0);
      EXPECT_NEAR(contact.foremost().reported().stiffness_n_per_m(), other, 0.2 * other) << name_of(kind);
      EXPECT_TRUE(contact.in_contact());
    }
  }
}

// Noise and a change of the material can leave a fit whose surface may be anywhere.
TEST(SlaveContact, TellsNoSurfaceFartherThanTheToolHasGone) {
  int reported = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Random random(seed);
    Bench bench{1000.0, random.uniform(1.0, 2.0), 0.1, std::pow(10.0, random.uniform(-2.0, 0.5)),
                Random(seed).child("noise")};
    SlaveContact contact(SensingConfig{}, EstimatorConfig{});
    double deepest_m = 0.0, speed = 2e-3;
    for (int i = 0; i < 3000; ++i) {
      if (i > 1000 && i % 200 == 199) {
        bench.stiffness_n_per_m = std::pow(10.0, random.uniform(1.0, 6.0));
        bench.noise_n = std::pow(10.0, random.uniform(-2.0, 0.5));
        speed = random.uniform(-1e-3, 1e-3);
      }
      bench.step(contact, bench.force() > 10.0 ? -5e-4 : bench.force() < 0.5 ? 2e-3 : speed);
      deepest_m = std::max(deepest_m, bench.x_m - 0.1);
      for (const ReportedSurface& s : contact.report(Vector3(0.1, 3.0, -1.0))) {
        if (s.stiffness <= 0.0) continue;
        ++reported;
        ASSERT_LT(std::abs(s.offset), 6e-3 + 3.0 * deepest_m) << "seed " << seed << " at " << i;
      }
    }
  }
  EXPECT_GT(reported, 30000);
}

// Over a cylinder of 50 mm, 10 mm/s, for 40 mm: the mean direction of the force is off by 25 degrees then.
TEST(SlaveContact, ASlideOverACurvedSurfaceIsNoDepth) {
  for (const EstimatorKind kind : {EstimatorKind::kFixedExponent, EstimatorKind::kMaximumLikelihood}) {
    Random random(11);
    EstimatorConfig config;
    config.kind = kind;
    SlaveContact contact(SensingConfig{}, config);
    constexpr double kRadiusM = 0.05, kStiffness = 1000.0;
    double depth_m = -5e-4, angle = 0.0;
    for (int i = 0; i < 12000; ++i) {
      const double t = i * kDt;
      const double inward = t < 3.0 ? 1.2e-3 : 2e-3 * std::cos(2 * test::kPi * 0.5 * t);
      const double turning = t < 8.0 ? 0.0 : 0.2;  // rad/s
      depth_m += inward * kDt;
      angle += turning * kDt;
      const Vector3 out(-std::cos(angle), std::sin(angle), 0.0);
      const Vector3 along(std::sin(angle), std::cos(angle), 0.0);
      const double r = kRadiusM - depth_m;
      const Vector3 noise(random.normal(), random.normal(), random.normal());
      const Vector3 force = std::max(kStiffness * depth_m, 0.0) * out + 0.05 * noise;
      contact.step({r * out, -inward * out + r * turning * along, force, 0.0, 1.0, kDt});
      if (t < 6.0) continue;
      ASSERT_NEAR(contact.foremost().reported().stiffness_n_per_m(), kStiffness, 0.1 * kStiffness)
          << name_of(kind) << " at " << t;
    }
    EXPECT_NEAR(contact.foremost().depth_m(), depth_m, 2e-4) << name_of(kind);
  }
}

TEST(SlaveContact, IdentifiesAnewWithAnotherEstimatorFromNowOn) {
  for (const EstimatorKind kind : kEstimatorKinds) {
    Bench bench{1000.0, 1.0, 0.1, 0.05, Random(10)};
    EstimatorConfig config = free_exponent();
    SlaveContact contact(SensingConfig{}, config);
    for (int i = 0; i < 2500; ++i) bench.step(contact, 1e-3);
    const double reported = contact.foremost().reported().stiffness_n_per_m();
    ASSERT_GT(reported, 0.0);
    config.kind = kind;
    contact.configure(SensingConfig{}, config);
    bench.step(contact, 1e-3);
    EXPECT_EQ(contact.foremost().reported().stiffness_n_per_m(), reported) << name_of(kind);
    for (int i = 0; i < 8000; ++i) bench.step(contact, 4e-3 * std::cos(2 * test::kPi * 0.5 * i * kDt));
    ASSERT_TRUE(contact.foremost().estimate().valid) << name_of(kind);
    EXPECT_NEAR(contact.foremost().estimate().stiffness_n_per_m, 1000.0, 50.0) << name_of(kind);
  }
}

}  // namespace
}  // namespace longreach::contact_test
