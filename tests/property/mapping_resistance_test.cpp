// Whatever the operator changes while moving, the resistance of the mapping gives back no more than it was
// given, and its force does not step.

#include <gtest/gtest.h>

#include "deploy/lab/campaign_size.hpp"
#include "master/rendering/resistance.hpp"
#include "tests/property/mapping_walk.hpp"

namespace longreach::mapping_resistance_test {
namespace {

RenderingConfig any_rendering(Random& random) {
  RenderingConfig config;
  config.load_factor = random.chance(0.2) ? 0.0 : random.uniform(0.1, 4.0);
  config.friction_n = random.chance(0.2) ? 0.0 : random.uniform(0.01, 0.5);
  config.home_spring = random.chance(0.3);
  config.fade_s = random.uniform(0.05, 1.0);
  return config;
}

/// Mapping and resistance in the hand of somebody who fumbles with everything.
struct ErraticOperator {
  explicit ErraticOperator(std::uint64_t seed)
      : random(seed), config(any_rendering(random)), mapping(any_mapping(random)), resistance(config) {
    mapping.reset(in.handle);
    resistance.reset(in.handle);
  }

  Wrench tick() {
    wander(in.handle, random, 0.1, 1.0);
    in.load = random.chance(0.02) ? !in.load : in.load;
    in.scale = random.chance(0.02) ? twentieths(random) : in.scale;
    frozen = random.chance(0.02) ? !frozen : frozen;
    if (random.chance(0.02))
      in.mode = in.mode == MotionMode::kRate ? MotionMode::kPosition : MotionMode::kRate;
    mapping.step({in.handle, in.mode, in.scale, frozen}, kTick_s);
    in.centre_m = mapping.centre_m();
    in.centre_rotation = mapping.centre_rotation();
    in.frozen = frozen;
    return resistance.step(in, kTick_s);
  }

  Random random;
  RenderingConfig config;
  Mapping mapping;
  Resistance resistance;
  ResistanceInput in{};
  bool frozen = true;
};

/// Stiffest that the hand can meet at once: spring and friction.
double stiffest(double spring, double friction, const RenderingConfig& config) {
  return spring * std::max(1.0, config.load_factor) + friction;
}

/// What a damper that is held for a sample gives back when the motion has turned round.
double turned_round_j(double damping, const Vector3& rate_before, const Vector3& moved) {
  return damping * std::max(0.0, -rate_before.dot(moved));
}

TEST(ResistanceProperty, GivesBackNoMoreEnergyThanItWasGivenInAnyTick) {
  const int seeds = campaign(2000, 100);
  for (int seed = 1; seed <= seeds; ++seed) {
    ErraticOperator f(static_cast<std::uint64_t>(seed));
    const double k = stiffest(f.config.rate_stiffness_n_per_m, f.config.friction_stiffness_n_per_m, f.config);
    const double k_rad =
        stiffest(f.config.rotational_stiffness_nm_per_rad, f.config.friction_stiffness_nm_per_rad, f.config);
    const double b = f.config.rate_damping_n_s_per_m, b_rad = f.config.rotational_damping_nm_s_per_rad;
    double port_j = 0.0;
    double stored_j = 0.0, stored_rad_j = 0.0;
    Wrench last;
    HandleState before = f.in.handle;
    for (int i = 0; i < 3000; ++i) {
      const Wrench F = f.tick();
      const Vector3 moved = f.in.handle.p_MH - before.p_MH;
      const Vector3 turned = log_rotation(f.in.handle.q_MH * before.q_MH.conjugate());
      // Into the port, f[k-1] (x[k] - x[k-1]), and what springs and dampers that are held for a sample give
      // back.
      const double entered_j = -last.force.dot(moved) + 0.5 * k * moved.squaredNorm() +
                               turned_round_j(b, before.velocity_m_per_s, moved);
      const double entered_rad_j = -last.moment.dot(turned) + 0.5 * k_rad * turned.squaredNorm() +
                                   turned_round_j(b_rad, before.angular_rad_per_s, turned);
      ASSERT_GE(entered_j, f.resistance.energy_j() - stored_j - 1e-12) << "seed " << seed << " tick " << i;
      ASSERT_GE(entered_rad_j, f.resistance.rotation_energy_j() - stored_rad_j - 1e-12)
          << "seed " << seed << " tick " << i;
      port_j -= last.force.dot(moved);
      stored_j = f.resistance.energy_j();
      stored_rad_j = f.resistance.rotation_energy_j();
      last = F;
      before = f.in.handle;
    }
    EXPECT_GT(port_j, 0.0);
  }
}

TEST(ResistanceProperty, ItsForceDoesNotStep) {
  const int seeds = campaign(2000, 100);
  for (int seed = 1; seed <= seeds; ++seed) {
    ErraticOperator f(static_cast<std::uint64_t>(seed));
    const RenderingConfig& c = f.config;
    const double k = stiffest(c.rate_stiffness_n_per_m, c.friction_stiffness_n_per_m, c);
    const double k_rad = stiffest(c.rotational_stiffness_nm_per_rad, c.friction_stiffness_nm_per_rad, c);
    const double share = kTick_s / c.fade_s;
    Wrench last;
    HandleState before = f.in.handle;
    for (int i = 0; i < 3000; ++i) {
      const Wrench F = f.tick();
      const HandleState& h = f.in.handle;
      const double speed = h.velocity_m_per_s.norm(), speed_rad = h.angular_rad_per_s.norm();
      // What motion and damping explain, and a share of what is there to fade: spring, friction, damping.
      const double most_n = k * 0.15 + c.friction_n / 0.05 + c.rate_damping_n_s_per_m * speed;
      const double most_nm = k_rad * 1.0 + c.friction_nm / 0.05;
      const double step_n = k * (h.p_MH - before.p_MH).norm() +
                            c.rate_damping_n_s_per_m * (h.velocity_m_per_s - before.velocity_m_per_s).norm();
      const double step_nm =
          2.0 * k_rad * angle_between(h.q_MH, before.q_MH) +
          c.rotational_damping_nm_s_per_rad * (h.angular_rad_per_s - before.angular_rad_per_s).norm();
      ASSERT_LE((F.force - last.force).norm(), step_n + share * most_n) << "seed " << seed << " tick " << i;
      ASSERT_LE((F.moment - last.moment).norm(), step_nm + share * (most_nm + 0.02 * speed_rad))
          << "seed " << seed << " tick " << i;
      last = F;
      before = h;
    }
  }
}

}  // namespace
}  // namespace longreach::mapping_resistance_test
