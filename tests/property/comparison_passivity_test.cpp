// What the passive ones among the comparison laws promise, under hostile hands, delays and losses. Energy is
// summed here, from forces and motions alone.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/core/random.hpp"
#include "deploy/lab/campaign_size.hpp"
#include "deploy/lab/comparison/comparison_law.hpp"
#include "deploy/lab/comparison/coupling.hpp"
#include "deploy/lab/delay/delay_line.hpp"

namespace longreach::comparison_passivity_test {
namespace {

constexpr double kT_s = 1e-3;
constexpr int kTicks = 3000;

/// Anything from rest to violent.
Vector3 any_velocity(Random& random) {
  const double size = random.chance(0.1) ? 0.0 : std::pow(10.0, random.uniform(-9.0, 2.0));
  return size * Vector3(random.normal(), random.normal(), random.normal());
}

struct Link {
  DelayLine<ComparisonCommand> up;
  DelayLine<ComparisonReport> down;
  explicit Link(Random& random)
      : up(any(random), random.child("up")), down(any(random), random.child("down")) {}
  static DelayLineConfig any(Random& random) {
    return {static_cast<int>(random.uniform(0.0, 500.0)),
            random.chance(0.5) ? random.uniform(0.0, 20.0) : 0.0,
            random.chance(0.5) ? random.uniform(0.0, 0.9) : 0.0};
  }
};

/// Least energy that has been in the line between the two ends of the wave law, relative to all that went in.
double least_in_line(std::uint64_t seed, bool hold_what_is_lost) {
  Random random(seed);
  Link link(random);
  WaveLaw law({});
  WaveCoupling coupling({});
  ComparisonCommand last{};
  Vector3 tool_m = Vector3::Zero();
  double line_j = 0.0, entered_j = 1e-30, least = 0.0;
  for (int i = 0; i < kTicks; ++i) {
    const Vector3 v = any_velocity(random);
    const ComparisonOutput out = law.step({.velocity_m_per_s = v, .report = link.down.pop()}, kT_s);
    link.up.push(out.command);
    const double in_j = -out.force_n.dot(v) * kT_s;
    auto command = link.up.pop();
    if (!command && hold_what_is_lost) command = last;
    if (command) last = *command;
    const CouplingOutput far =
        coupling.step({.command = command, .force_n = 100.0 * any_velocity(random)}, kT_s);
    link.down.push(far.report);
    const Vector3 u = command ? command->wave : Vector3::Zero().eval();
    const Vector3 v_s = (far.setpoint_m - tool_m) / kT_s;
    tool_m = far.setpoint_m;
    const Vector3 push_n = std::sqrt(20.0) * u - 10.0 * v_s;  // b = 10 N s/m
    const double out_j = push_n.dot(v_s) * kT_s;
    line_j += in_j - out_j;
    entered_j += std::max(in_j, 0.0) + std::max(-out_j, 0.0);
    least = std::min(least, line_j / entered_j);
  }
  return least;
}

TEST(WavesProperty, CannotMakeEnergyWhateverTheLinkDoes) {
  for (int seed = 1; seed <= campaign(2000, 60); ++seed) {
    EXPECT_GE(least_in_line(static_cast<std::uint64_t>(seed), false), -1e-9) << "seed " << seed;
  }
}

TEST(WavesProperty, WouldMakeEnergyIfALostWaveWereHeld) {
  double least = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) least = std::min(least, least_in_line(seed, true));
  EXPECT_LT(least, -0.01);
}

TEST(PassivityProperty, TheHandIsNeverGivenMoreThanEnteredAtTheSlave) {
  for (int seed = 1; seed <= campaign(2000, 100); ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    PassivityLaw law({.handle_mass_kg = 1e30});  // no bound: the rest is exact
    ComparisonReport report{};
    double given_j = 0.0, gross_j = 0.0;
    for (int i = 0; i < kTicks; ++i) {
      if (random.chance(0.5)) {
        report.force_n = 10.0 * any_velocity(random);
        report.energy_j += random.chance(0.1) ? std::pow(10.0, random.uniform(-9.0, 3.0)) : 0.0;
      }
      const Vector3 v = any_velocity(random);
      const Vector3 f = law.step({.velocity_m_per_s = v, .report = report}, kT_s).force_n;
      given_j += f.dot(v) * kT_s;
      gross_j += std::abs(f.dot(v)) * kT_s;
      if (v.squaredNorm() == 0.0) continue;
      ASSERT_LE(given_j, report.energy_j + 1e-9 * (1.0 + gross_j)) << "seed " << seed << ", tick " << i;
    }
  }
}

/// Largest amount by which what is in the wall exceeds what the hand has put in.
template <class Law, class Coupling>
double excess_j(std::uint64_t seed, double wall_n_per_m) {
  Random random(seed);
  Link link(random);
  Law law({.handle_mass_kg = 1e30});
  Coupling coupling({});
  double x_m = -0.005, force_n = 0.0, tool_m = 0.0, entered_j = 0.0, most_j = 0.0;
  for (int i = 0; i < 3 * kTicks; ++i) {
    const double wall_n = -wall_n_per_m * std::max(0.0, tool_m);
    const CouplingOutput far =
        coupling.step({.command = link.up.pop(), .force_n = Vector3(wall_n, 0.0, 0.0)}, kT_s);
    tool_m = far.setpoint_m.x();
    link.down.push(far.report);
    // To and fro through the surface.
    const double v = 0.06 * std::cos(2e-3 * i * (1.0 + 0.2 * static_cast<double>(seed % 7)));
    x_m += v * kT_s;
    entered_j -= force_n * v * kT_s;
    const ComparisonOutput out = law.step(
        {.position_m = {x_m, 0.0, 0.0}, .velocity_m_per_s = {v, 0.0, 0.0}, .report = link.down.pop()}, kT_s);
    force_n = out.force_n.x();
    link.up.push(out.command);
    const double p_m = std::max(0.0, tool_m);
    most_j = std::max(most_j, 0.5 * wall_n_per_m * p_m * p_m - entered_j);
  }
  return most_j;
}

TEST(PassivityProperty, TheWallIsNeverGivenMoreThanTheHandPutIn) {
  // One step in front of the controller: 0.5 mm at 1000 N/m.
  for (int seed = 1; seed <= campaign(500, 20); ++seed)
    EXPECT_LE((excess_j<PassivityLaw, PassivityCoupling>(static_cast<std::uint64_t>(seed), 1000.0)), 1e-3)
        << "seed " << seed;
}

TEST(TankProperty, TheWallIsNeverGivenMoreThanTheHandPutIn) {
  for (int seed = 1; seed <= campaign(500, 20); ++seed)
    EXPECT_LE((excess_j<TankLaw, TankCoupling>(static_cast<std::uint64_t>(seed), 1000.0)), 2e-4)
        << "seed " << seed;
}

}  // namespace
}  // namespace longreach::comparison_passivity_test
