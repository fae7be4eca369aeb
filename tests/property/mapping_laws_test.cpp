// What holds of the mapping for every motion of the handle.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "deploy/lab/campaign_size.hpp"
#include "tests/property/mapping_walk.hpp"

namespace longreach::mapping_laws_test {
namespace {

constexpr double kCount_m = 1e-5;  // of an encoder, at the handle
constexpr double kCount_rad = 1e-4;

/// What the person may change from tick to tick.
void change_something(MappingInput& in, Random& random) {
  if (random.chance(0.01)) in.scale = twentieths(random);
  if (random.chance(0.01)) in.frozen = !in.frozen;
  if (random.chance(0.01)) in.mode = in.mode == MotionMode::kRate ? MotionMode::kPosition : MotionMode::kRate;
}

/// A count more or less in each axis.
HandleState shaken(HandleState h, Random& random) {
  const auto counts = [&random] {
    return Vector3(std::floor(random.uniform(-1.0, 2.0)), std::floor(random.uniform(-1.0, 2.0)),
                   std::floor(random.uniform(-1.0, 2.0)));
  };
  h.p_MH += kCount_m * counts();
  h.q_MH = exp_rotation(kCount_rad * counts()) * h.q_MH;
  return h;
}

TEST(MappingProperty, RotatingTheBaseRotatesTheOutput) {
  const int seeds = campaign(1000, 30);
  for (int seed = 1; seed <= seeds; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    MappingConfig config = any_mapping(random);
    const Vector3 axis = config.base_rotation_rad.normalized();
    const Eigen::AngleAxisd base(config.base_rotation_rad.norm(), axis);
    Mapping rotated(config);
    config.base_rotation_rad.setZero();
    Mapping parallel(config);
    MappingInput in;
    for (int i = 0; i < 1000; ++i) {
      wander(in.handle, random, 0.1, 1.0);
      change_something(in, random);
      const Goal& g = rotated.step(in, kTick_s);
      const Goal& straight = parallel.step(in, kTick_s);
      ASSERT_LE((g.position_m - base * straight.position_m).norm(), 1e-12) << "seed " << seed;
      ASSERT_LE(angle_between(g.rotation, Quaternion(base) * straight.rotation * Quaternion(base.inverse())),
                1e-10)
          << "seed " << seed;
    }
  }
}

TEST(MappingProperty, NoiseInsideTheDeadZoneMovesNothing) {
  const int seeds = campaign(200, 10);
  for (int seed = 1; seed <= seeds; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    const MappingConfig config = any_mapping(random);
    Mapping mapping(config);
    MappingInput in{.mode = MotionMode::kRate};
    mapping.step(in, kTick_s);
    HandleState inside;
    inside.p_MH = (config.dead_zone_m - 4.0 * kCount_m) * normal_vector(random, 1.0).normalized();
    inside.q_MH =
        exp_rotation((config.dead_zone_rad - 4.0 * kCount_rad) * normal_vector(random, 1.0).normalized());
    for (int i = 0; i < 5000; ++i) {
      in.handle = shaken(inside, random);
      mapping.step(in, kTick_s);
    }
    EXPECT_TRUE(mapping.goal().position_m.isZero(0.0)) << "seed " << seed;
    EXPECT_EQ(mapping.goal().rotation.coeffs(), Quaternion::Identity().coeffs()) << "seed " << seed;
  }
}

/// Steps of the goal, translation and rotation, over ticks with the handle shaken about a place.
struct Jitter {
  double least_m = 1e9, most_m = 0.0, least_rad = 1e9, most_rad = 0.0;  // step of a tick
  int starts_m = 0, starts_rad = 0;                                     // from rest to motion
};

Jitter shake(Mapping& mapping, MappingInput in, const HandleState& about, Random& random, int ticks) {
  Jitter seen;
  bool moving_m = false, moving_rad = false;
  for (int i = 0; i < ticks; ++i) {
    const Goal before = mapping.goal();
    in.handle = shaken(about, random);
    const Goal& after = mapping.step(in, kTick_s);
    const double step_m = (after.position_m - before.position_m).norm();
    const double step_rad = angle_between(after.rotation, before.rotation);
    seen.least_m = std::min(seen.least_m, step_m);
    seen.most_m = std::max(seen.most_m, step_m);
    seen.least_rad = std::min(seen.least_rad, step_rad);
    seen.most_rad = std::max(seen.most_rad, step_rad);
    seen.starts_m += step_m > 0.0 && !moving_m;
    seen.starts_rad += step_rad > 0.0 && !moving_rad;
    moving_m = step_m > 0.0;
    moving_rad = step_rad > 0.0;
  }
  return seen;
}

/// The hand at the edge of the dead zone, with its noise.
TEST(MappingProperty, NoiseAtTheEdgeOfTheDeadZoneDoesNotChatter) {
  const int seeds = campaign(500, 20);
  const double reach_m = 1.01 * std::sqrt(3.0) * kCount_m, reach_rad = 1.01 * std::sqrt(3.0) * kCount_rad;
  for (int seed = 1; seed <= seeds; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    MappingConfig config;
    HandleState edge;
    edge.p_MH = config.dead_zone_m * normal_vector(random, 1.0).normalized();
    edge.q_MH = exp_rotation(config.dead_zone_rad * normal_vector(random, 1.0).normalized());
    const MappingInput in{.mode = MotionMode::kRate};
    for (const RateLaw law : {RateLaw::kContinuous, RateLaw::kLiteral}) {
      config.rate_law = law;
      Mapping mapping(config);
      mapping.step(in, kTick_s);
      const Jitter seen = shake(mapping, in, edge, random, 2000);
      if (law == RateLaw::kLiteral) {
        EXPECT_LE(seen.starts_m, 1) << "seed " << seed;
        EXPECT_LE(seen.starts_rad, 1) << "seed " << seed;
      } else {
        EXPECT_LE(seen.most_m, kTick_s * config.kv_per_s * reach_m) << "seed " << seed;
        EXPECT_LE(seen.most_rad, kTick_s * config.kv_rotation_per_s * reach_rad) << "seed " << seed;
      }
    }
  }
}

TEST(MappingProperty, FineMotionScalesNoiseAndDoesNotDrift) {
  const int seeds = campaign(200, 10);
  const double reach_m = 2.0 * std::sqrt(3.0) * kCount_m, reach_rad = 2.0 * std::sqrt(3.0) * kCount_rad;
  for (int seed = 1; seed <= seeds; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    Mapping mapping({.speed_max_m_per_s = 10.0, .speed_max_rad_per_s = 10.0});
    const MappingInput in{.mode = MotionMode::kPosition, .scale = 0.05};
    const HandleState at{};
    shake(mapping, in, at, random, 5000);
    EXPECT_LE(mapping.goal().position_m.norm(), 0.05 * reach_m * 1.01) << "seed " << seed;
    EXPECT_LE(angle_between(mapping.goal().rotation, Quaternion::Identity()), 0.05 * reach_rad * 1.01)
        << "seed " << seed;
  }
}

/// Any number, most of them absurd.
double hostile(Random& random) {
  constexpr std::array kValues = {0.0,
                                  1e-9,
                                  1e9,
                                  1e300,
                                  -1e300,
                                  std::numeric_limits<double>::max(),
                                  std::numeric_limits<double>::infinity(),
                                  -std::numeric_limits<double>::infinity(),
                                  std::numeric_limits<double>::quiet_NaN(),
                                  std::numeric_limits<double>::denorm_min(),
                                  -1e-310};
  if (random.chance(0.5)) return random.normal() * std::exp(random.uniform(-20.0, 5.0));
  return kValues[static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(kValues.size())))];
}

TEST(MappingProperty, NothingMakesTheGoalFasterThanItsLimitsOrNotFinite) {
  const int seeds = campaign(2000, 50);
  for (int seed = 1; seed <= seeds; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    MappingConfig config = any_mapping(random);
    config.dead_zone_m = random.chance(0.3) ? 0.0 : config.dead_zone_m;
    Mapping mapping(config);
    MappingInput in;
    for (int i = 0; i < 1000; ++i) {
      change_something(in, random);
      if (random.chance(0.5)) {
        wander(in.handle, random, 0.1, 1.0);
        in.handle.p_MH = clamp_norm(in.handle.p_MH, 1.0);
      }
      MappingInput given = in;
      if (random.chance(0.3)) given.handle.p_MH = {hostile(random), hostile(random), hostile(random)};
      if (random.chance(0.3))
        given.handle.q_MH = Quaternion(hostile(random), hostile(random), hostile(random), hostile(random));
      const Goal before = mapping.goal();
      const Goal& after = mapping.step(given, kTick_s);
      ASSERT_TRUE(after.position_m.allFinite() && after.rotation.coeffs().allFinite()) << "seed " << seed;
      ASSERT_NEAR(after.rotation.norm(), 1.0, 1e-12) << "seed " << seed;
      ASSERT_LE((after.position_m - before.position_m).norm(),
                kTick_s * config.speed_max_m_per_s * (1.0 + 1e-9) + 1e-12)
          << "seed " << seed;
      ASSERT_LE(angle_between(after.rotation, before.rotation),
                kTick_s * config.speed_max_rad_per_s * (1.0 + 1e-9) + 1e-12)
          << "seed " << seed;
      const Pose ahead = mapping.forecast(3.0);
      ASSERT_TRUE(ahead.p.allFinite() && ahead.q.coeffs().allFinite()) << "seed " << seed;
    }
  }
}

TEST(MappingProperty, TellsWhichPlaceAndTurnOfTheHandleCommandsAGoal) {
  const int seeds = campaign(2000, 100);
  for (int seed = 1; seed <= seeds; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    MappingConfig config = any_mapping(random);
    config.speed_max_m_per_s = config.speed_max_rad_per_s = 1e4;
    Mapping mapping(config);
    MappingInput in{.scale = twentieths(random)};
    for (int i = 0; i < 300; ++i) {
      wander(in.handle, random, 0.1, 1.0);
      change_something(in, random);
      mapping.step(in, kTick_s);
    }
    in.mode = MotionMode::kPosition;
    in.frozen = false;
    mapping.step(in, kTick_s);
    for (int i = 0; i < 300; ++i) wander(in.handle, random, 0.1, 1.0);
    const Goal& goal = mapping.step(in, kTick_s);
    const Vector3 n = normal_vector(random, 1.0).normalized();
    const Vector3 n_M = exp_rotation(config.base_rotation_rad).conjugate() * n;
    EXPECT_NEAR(mapping.handle_offset_m(n, n.dot(goal.position_m)), n_M.dot(in.handle.p_MH), 1e-12)
        << "seed " << seed;
    EXPECT_LE((mapping.handle_rotation_at(goal.rotation) - log_rotation(in.handle.q_MH)).norm(), 1e-10)
        << "seed " << seed;
  }
}

}  // namespace
}  // namespace longreach::mapping_laws_test
