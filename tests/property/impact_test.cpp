// What a step of the contact integrator keeps, whatever the stiffness, the exponent, the damping and the
// step.

#include <gtest/gtest.h>

#include <limits>

#include "common/core/random.hpp"
#include "deploy/lab/campaign_size.hpp"
#include "deploy/lab/contact/contact_integrator.hpp"
#include "deploy/lab/contact/impact_oracle.hpp"

namespace longreach::impact_test {
namespace {

double decades(Random& random, double from, double to) { return std::pow(10.0, random.uniform(from, to)); }

struct Case {
  ContactMass contact;
  double speed, dt;
  [[nodiscard]] test::ImpactOracle oracle() const {
    return {contact.mass_kg, contact.law.k, contact.law.n, contact.law.a, speed};
  }
};

// kappa = k (v dt)^(n-1) dt²/m from 1e-6 to 1e6, n from 1 to 3, a v from 0 to 10, in any units.
Case any_case(Random& random) {
  Case c;
  c.contact.mass_kg = decades(random, -3.0, 4.0);
  c.speed = decades(random, -4.0, 1.0);
  c.dt = decades(random, -6.0, -1.0);
  const double n = random.uniform() < 0.2 ? 1.0 : random.uniform(1.0, 3.0);
  const double av = random.uniform() < 0.1   ? 0.0
                    : random.uniform() < 0.5 ? random.uniform(0.0, 10.0)
                                             : decades(random, -9.0, 1.0);
  const double kappa = decades(random, -6.0, 6.0);
  c.contact.law = {kappa * c.contact.mass_kg / (c.dt * c.dt) / std::pow(c.speed * c.dt, n - 1.0), n,
                   av / c.speed};
  return c;
}

double energy(const ContactMass& contact, const NormalMotion& at) {
  return 0.5 * contact.mass_kg * at.speed_m_per_s * at.speed_m_per_s + contact.law.energy_j(at.depth_m);
}

TEST(Impact, RestitutionIsExactAndEnergyNeverRisesForAnyStep) {
  double error_max = 0.0, rise_max = 0.0;
  long collisions = 0, steps = 0, evaluations = 0;
  for (int seed = 0; seed < 3000; ++seed) {
    Random random(seed);
    const Case c = any_case(random);
    NormalMotion at{-random.uniform() * c.speed * c.dt, c.speed};  // touches anywhere within a step
    const double before = energy(c.contact, at);
    bool left = false;
    for (int n = 0; n < 20000 && !left; ++n) {
      const NormalStep step = step_contact(Integrator::kDiscreteGradient, c.contact, at, 0.0, c.dt);
      ASSERT_TRUE(step.converged) << "seed " << seed;
      ASSERT_LE(step.motion.speed_m_per_s, at.speed_m_per_s) << "pulls, seed " << seed;
      rise_max = std::max(rise_max, (energy(c.contact, step.motion) - energy(c.contact, at)) / before);
      at = step.motion;
      left = at.depth_m <= 0.0 && at.speed_m_per_s < 0.0;
      ++steps;
      evaluations += step.evaluations;
    }
    ASSERT_TRUE(left) << "seed " << seed;
    const double error =
        std::abs(-at.speed_m_per_s / c.speed - static_cast<double>(c.oracle().restitution()));
    ASSERT_LE(error, 1e-10) << "seed " << seed;
    error_max = std::max(error_max, error);
    ++collisions;
  }
  EXPECT_LE(rise_max, 1e-12);
  std::printf(
      "restitution error at most %.2g, rise of energy in a step at most %.2g; a collision takes %.1f steps, "
      "%.1f evaluations a step\n",
      error_max, rise_max, static_cast<double>(steps) / static_cast<double>(collisions),
      static_cast<double>(evaluations) / static_cast<double>(steps));
}

TEST(Impact, DepthAndSeparationAreRightWithSixtyFourSteps) {
  double depth_error = 0.0, time_error = 0.0, bound_low = 1.0;
  for (int seed = 0; seed < campaign(3000, 200); ++seed) {
    Random random(seed);
    const Case c = any_case(random);
    const double duration = static_cast<double>(c.oracle().duration());
    const double deepest = static_cast<double>(c.oracle().penetration_max());
    bound_low = std::min(bound_low, contact_time_s(c.contact, c.speed) / duration);
    ASSERT_LE(contact_time_s(c.contact, c.speed), duration * (1.0 + 1e-6)) << "seed " << seed;
    const double dt = duration / 64.0;
    NormalMotion at{0.0, c.speed};
    double depth = 0.0, time = 0.0;
    while (at.depth_m > 0.0 || at.speed_m_per_s > 0.0) {
      const NormalMotion next = step_contact(Integrator::kDiscreteGradient, c.contact, at, 0.0, dt).motion;
      depth = std::max(depth, next.depth_m);
      time += next.depth_m > 0.0 ? dt : dt * at.depth_m / (at.depth_m - next.depth_m);
      at = next;
      ASSERT_LE(time, 2.0 * duration) << "seed " << seed;
    }
    ASSERT_NEAR(depth, deepest, 0.01 * deepest) << "seed " << seed;
    ASSERT_NEAR(time, duration, 0.01 * duration) << "seed " << seed;
    depth_error = std::max(depth_error, std::abs(depth / deepest - 1.0));
    time_error = std::max(time_error, std::abs(time / duration - 1.0));
  }
  std::printf(
      "64 steps a contact: depth within %.2g, separation within %.2g of the contact's time; its bound is at "
      "least %.2f of it\n",
      depth_error, time_error, bound_low);
}

// A servo presses the mass onto the contact and probes: a spring and a damper, sampled once a step. What the
// mass has more than before came from the servo.
TEST(Impact, EnergyUnderAServoComesFromTheServoOnly) {
  double rise_max = 0.0, euler_rise = 0.0;
  for (int seed = 0; seed < campaign(3000, 300); ++seed) {
    Random random(seed);
    const Case c = any_case(random);
    const double m = c.contact.mass_kg, dt = c.dt;
    const double spring = m * std::pow(random.uniform(0.0, 0.5) / dt, 2.0), damper = 0.3 * m / dt;
    const double reach = c.speed * dt;
    NormalMotion at{-reach, c.speed}, naive = at;
    for (int n = 0; n < 1000; ++n) {
      const double target = reach * (2.0 + 3.0 * std::sin(0.05 * n));
      const auto servo = [&](const NormalMotion& x) {
        return spring * (target - x.depth_m) - damper * x.speed_m_per_s;
      };
      const double external = servo(at), scale = energy(c.contact, at) + std::abs(external) * reach;
      const NormalStep step = step_contact(Integrator::kDiscreteGradient, c.contact, at, external, dt);
      ASSERT_TRUE(step.converged) << "seed " << seed << " step " << n;
      const double rise = energy(c.contact, step.motion) - energy(c.contact, at) - step.external_work_j;
      ASSERT_LE(rise, 1e-12 * (scale + std::abs(step.external_work_j))) << "seed " << seed << " step " << n;
      const double pull = step.motion.speed_m_per_s - at.speed_m_per_s - external * dt / m;
      ASSERT_LE(pull, 1e-14 * (std::abs(at.speed_m_per_s) + std::abs(external) * dt / m)) << "seed " << seed;
      rise_max = std::max(rise_max, rise / scale);
      at = step.motion;
      const NormalStep euler = step_contact(Integrator::kExplicitEuler, c.contact, naive, servo(naive), dt);
      euler_rise = std::max(
          euler_rise,
          (energy(c.contact, euler.motion) - energy(c.contact, naive) - euler.external_work_j) / scale);
      naive = euler.motion;
    }
  }
  EXPECT_GT(euler_rise, 1.0);  // the audit can fail
  std::printf("generated energy under a servo: at most %.2g of what there is in a step\n", rise_max);
}

// Thrown onto the surface by a constant force again and again, it comes up no higher than it was.
TEST(Impact, BouncesUnderAConstantForceNeverGrow) {
  for (int seed = 0; seed < campaign(1000, 100); ++seed) {
    Random random(seed);
    Case c = any_case(random);
    if (seed % 2 == 0) c.contact.law.a = 0.0;
    const double m = c.contact.mass_kg;
    const double force = m * c.speed / c.dt * decades(random, -4.0, -1.0);
    NormalMotion at{0.0, c.speed};
    const auto total = [&] { return energy(c.contact, at) - force * at.depth_m; };
    const double start = total();
    double before = start;
    for (int n = 0; n < 20000; ++n) {
      at = step_contact(Integrator::kDiscreteGradient, c.contact, at, force, c.dt).motion;
      ASSERT_LE(total(), start * (1.0 + 1e-9)) << "seed " << seed << " step " << n;
      before = total();
    }
    if (c.contact.law.a == 0.0) {
      EXPECT_NEAR(before, start, 1e-9 * start) << "seed " << seed;
    }
  }
}

TEST(Impact, StaysFiniteWhateverItIsGiven) {
  const double extremes[] = {0.0,
                             5e-324,
                             1e-9,
                             1.0,
                             1e9,
                             1e200,
                             std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::quiet_NaN()};
  for (const NormalMotion at : {NormalMotion{}, {1e-3, 0.1}, {1e-3, -0.1}, {-1e-3, 0.1}}) {
    for (const double k : extremes) {
      for (const double mass : extremes) {
        for (const double dt : extremes) {
          for (const double external : {0.0, -1e9, 1e300}) {
            const NormalStep step =
                step_contact(Integrator::kDiscreteGradient, {{k, 1.5, 0.5}, mass}, at, external, dt);
            EXPECT_TRUE(std::isfinite(step.motion.depth_m) && std::isfinite(step.motion.speed_m_per_s) &&
                        std::isfinite(step.external_work_j))
                << k << " " << mass << " " << dt << " " << external;
          }
        }
      }
    }
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(step_contact(Integrator::kDiscreteGradient, {}, {nan, 0.0}, 0.0, 1e-3).converged);
}

}  // namespace
}  // namespace longreach::impact_test
