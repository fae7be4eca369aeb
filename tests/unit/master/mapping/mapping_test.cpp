#include "master/mapping/mapping.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace longreach::mapping_test {
namespace {

constexpr double kTick_s = 0.001;

MappingInput at(const Vector3& x, MotionMode mode, double scale, bool frozen = false) {
  MappingInput in;
  in.handle.p_MH = x;
  in.mode = mode;
  in.scale = scale;
  in.frozen = frozen;
  return in;
}

TEST(RateLaw, IsZeroInsideTheDeadZoneAndContinuousAtItsEdge) {
  EXPECT_TRUE(rate_law({0.004, 0.0, 0.0}, 0.005, 0.05, RateLaw::kContinuous).isZero(0.0));
  EXPECT_NEAR(rate_law({0.005 + 1e-9, 0.0, 0.0}, 0.005, 0.05, RateLaw::kContinuous).x(), 1e-9, 1e-15);
  EXPECT_NEAR(rate_law({0.005 + 1e-9, 0.0, 0.0}, 0.005, 0.05, RateLaw::kLiteral).x(), 0.005, 1e-8);
}

TEST(RateLaw, CapsAtTheEffectiveRadiusAndKeepsTheDirection) {
  const Vector3 v = rate_law({3.0, 4.0, 0.0}, 0.005, 0.05, RateLaw::kContinuous);
  EXPECT_NEAR(v.norm(), 0.045, 1e-15);
  EXPECT_NEAR(v.y() / v.x(), 4.0 / 3.0, 1e-12);
}

TEST(Mapping, ScalesTheDisplacementOfTheHandleInPositionMode) {
  Mapping mapping({.speed_max_m_per_s = 10.0});
  mapping.reset({});
  mapping.step(at(Vector3::Zero(), MotionMode::kPosition, 0.5), kTick_s);
  EXPECT_NEAR(mapping.step(at({0.004, 0.0, -0.002}, MotionMode::kPosition, 0.5), kTick_s).position_m.x(),
              0.002, 1e-15);
  EXPECT_NEAR(mapping.goal().position_m.z(), -0.001, 1e-15);
}

TEST(Mapping, IntegratesTheRateOfADeflection) {
  Mapping mapping({.kv_per_s = 2.0, .dead_zone_m = 0.005, .radius_max_m = 0.05});
  mapping.reset({});
  mapping.step(at(Vector3::Zero(), MotionMode::kRate, 1.0), kTick_s);
  for (int i = 0; i < 1000; ++i) mapping.step(at({0.015, 0.0, 0.0}, MotionMode::kRate, 1.0), kTick_s);
  EXPECT_NEAR(mapping.goal().position_m.x(), 2.0 * 0.010, 1e-12);
}

TEST(Mapping, TurnsTheGoalByTheScaledRotationOfTheHandle) {
  Mapping mapping({.speed_max_rad_per_s = 1e4});
  mapping.reset({});
  MappingInput in = at(Vector3::Zero(), MotionMode::kPosition, 0.5);
  mapping.step(in, kTick_s);
  in.handle.q_MH = exp_rotation({0.0, 0.0, 0.6});
  EXPECT_NEAR(log_rotation(mapping.step(in, kTick_s).rotation).z(), 0.3, 1e-12);
}

/// Against the interpolation on the arc, by Eigen.
TEST(Mapping, ScalesARotationAboutAnyAxisFromAnyReference) {
  const Vector3 axis = Vector3(1.0, -2.0, 0.5).normalized();
  const Quaternion start(Eigen::AngleAxisd(0.4, Vector3::UnitY())), turn(Eigen::AngleAxisd(0.9, axis));
  Mapping mapping({.speed_max_rad_per_s = 1e4});
  MappingInput in = at(Vector3::Zero(), MotionMode::kPosition, 0.25);
  in.handle.q_MH = start;
  mapping.step(in, kTick_s);
  in.handle.q_MH = turn * start;
  const Quaternion quarter = Quaternion::Identity().slerp(0.25, turn);
  EXPECT_LT(mapping.step(in, kTick_s).rotation.angularDistance(quarter), 1e-12);
}

/// Constant rate for ten turns about a slanted axis: the closed form, and the norm does not creep.
TEST(Mapping, ComposesARateOfRotationExactly) {
  const Vector3 axis = Vector3(1.0, 2.0, -2.0) / 3.0;
  const MappingConfig config{.kv_rotation_per_s = 10.0, .dead_zone_rad = 0.05, .speed_max_rad_per_s = 1e3};
  Mapping mapping(config);
  MappingInput in = at(Vector3::Zero(), MotionMode::kRate, 1.0);
  mapping.step(in, kTick_s);
  in.handle.q_MH = exp_rotation(0.25 * axis);
  const int ticks = 31416;  // at 2 rad/s
  for (int i = 0; i < ticks; ++i) mapping.step(in, kTick_s);
  const Quaternion closed(Eigen::AngleAxisd(2.0 * kTick_s * ticks, axis));
  EXPECT_LT(mapping.goal().rotation.angularDistance(closed), 1e-9);
  EXPECT_NEAR(mapping.goal().rotation.norm(), 1.0, 1e-15);
}

TEST(Mapping, TurnsEveryMotionByTheBase) {
  Mapping mapping({.speed_max_m_per_s = 10.0,
                   .speed_max_rad_per_s = 1e4,
                   .base_rotation_rad = {0.0, 0.0, 0.5 * std::numbers::pi}});
  MappingInput in = at(Vector3::Zero(), MotionMode::kPosition, 1.0);
  mapping.step(in, kTick_s);
  in.handle.p_MH.x() = 0.01;
  in.handle.q_MH = exp_rotation({0.2, 0.0, 0.0});
  const Goal& goal = mapping.step(in, kTick_s);
  EXPECT_LT((goal.position_m - Vector3(0.0, 0.01, 0.0)).norm(), 1e-15);
  EXPECT_LT((log_rotation(goal.rotation) - Vector3(0.0, 0.2, 0.0)).norm(), 1e-12);
}

TEST(Mapping, TheLiteralLawJumpsAtTheEdgeAndEndsATenthFurtherIn) {
  Mapping mapping({.rate_law = RateLaw::kLiteral, .kv_per_s = 2.0, .dead_zone_m = 0.005});
  mapping.step(at(Vector3::Zero(), MotionMode::kRate, 1.0), kTick_s);
  const auto speed = [&mapping](double x) {
    const double before = mapping.goal().position_m.x();
    return (mapping.step(at({x, 0.0, 0.0}, MotionMode::kRate, 1.0), kTick_s).position_m.x() - before) /
           kTick_s;
  };
  EXPECT_EQ(speed(0.00499), 0.0);
  EXPECT_NEAR(speed(0.00501), 2.0 * 0.00501, 1e-9);
  EXPECT_NEAR(speed(0.00455), 2.0 * 0.00455, 1e-9);
  EXPECT_EQ(speed(0.00445), 0.0);
  EXPECT_EQ(speed(0.00499), 0.0);
}

TEST(Mapping, ForecastsByTheSpeedCommandedNowInRateMode) {
  Mapping mapping({.kv_per_s = 2.0, .kv_rotation_per_s = 1.0, .dead_zone_m = 0.005, .dead_zone_rad = 0.05});
  MappingInput in = at(Vector3::Zero(), MotionMode::kRate, 1.0);
  mapping.step(in, kTick_s);
  in.handle.p_MH.x() = 0.015;
  in.handle.q_MH = exp_rotation({0.0, 0.15, 0.0});
  mapping.step(in, kTick_s);
  const Pose ahead = mapping.forecast(1.3);
  for (int i = 0; i < 1300; ++i) mapping.step(in, kTick_s);
  EXPECT_LT((ahead.p - mapping.goal().position_m).norm(), 1e-12);
  EXPECT_LT(ahead.q.angularDistance(mapping.goal().rotation), 1e-9);
  in.frozen = true;
  mapping.step(in, kTick_s);
  EXPECT_EQ(mapping.forecast(1.3).p, mapping.goal().position_m) << "a clutched handle asks for nothing";
}

TEST(Mapping, ForecastsByTheMeanSpeedOfTheHandInPositionMode) {
  Mapping mapping({});
  for (int i = 0; i <= 2000; ++i) {
    const double noise = i % 2 == 0 ? 1e-5 : 0.0;  // an encoder count
    mapping.step(at({0.02e-3 * i + noise, 0.0, 0.0}, MotionMode::kPosition, 0.5), kTick_s);
  }
  const double ahead_m = mapping.forecast(1.0).p.x() - mapping.goal().position_m.x();
  EXPECT_NEAR(ahead_m, 0.5 * 0.02, 1e-4);
}

TEST(Mapping, ANewBaseTakesNewReferences) {
  MappingConfig config{.speed_max_m_per_s = 10.0};
  Mapping mapping(config);
  mapping.step(at(Vector3::Zero(), MotionMode::kPosition, 1.0), kTick_s);
  mapping.step(at({0.01, 0.0, 0.0}, MotionMode::kPosition, 1.0), kTick_s);
  config.base_rotation_rad = {0.0, 0.0, 1.0};
  mapping.configure(config);
  EXPECT_EQ(mapping.step(at({0.01, 0.0, 0.0}, MotionMode::kPosition, 1.0), kTick_s).position_m,
            Vector3(0.01, 0.0, 0.0));
}

TEST(Mapping, SaysThatNoHandleTurnsAsFarAsAFarGoalAsksFor) {
  Mapping mapping({});
  mapping.step(at(Vector3::Zero(), MotionMode::kPosition, 0.05), kTick_s);
  EXPECT_NEAR(mapping.handle_rotation_at(exp_rotation({0.0, 0.0, 0.05})).z(), 1.0, 1e-12);
  EXPECT_NEAR(mapping.handle_rotation_at(exp_rotation({0.0, 0.0, 0.3})).z(), 2.0, 1e-12);
}

TEST(Mapping, SaysWhereTheHandleMeetsAPlaneOfTheGoal) {
  Mapping mapping({.speed_max_m_per_s = 10.0});
  mapping.reset({});
  mapping.step(at({0.001, 0.0, 0.0}, MotionMode::kPosition, 0.2), kTick_s);
  mapping.step(at({0.006, 0.0, 0.0}, MotionMode::kPosition, 0.2), kTick_s);
  EXPECT_NEAR(mapping.goal().position_m.x(), 0.001, 1e-15);
  EXPECT_NEAR(mapping.handle_offset_m(Vector3::UnitX(), 0.001), 0.006, 1e-15);
}

TEST(Mapping, SwitchingToRateModeAtADeflectionCommandsNoSpeed) {
  Mapping mapping({});
  mapping.reset({});
  mapping.step(at({0.04, 0.0, 0.0}, MotionMode::kPosition, 1.0), kTick_s);
  const Vector3 before = mapping.goal().position_m;
  for (int i = 0; i < 100; ++i) mapping.step(at({0.04, 0.0, 0.0}, MotionMode::kRate, 1.0), kTick_s);
  EXPECT_EQ(mapping.goal().position_m, before);
}

TEST(Mapping, LettingGoInRateModeCommandsNothing) {
  for (const RateCentre centre : {RateCentre::kHandleOrigin, RateCentre::kWhereModeBegan}) {
    Mapping mapping({.rate_centre = centre});
    mapping.reset({});
    mapping.step(at({0.04, 0.0, 0.0}, MotionMode::kPosition, 1.0), kTick_s);
    const Vector3 before = mapping.goal().position_m;
    for (int i = 0; i <= 1000; ++i) {
      mapping.step(at({0.04 - 4e-5 * i, 0.0, 0.0}, MotionMode::kRate, 1.0), kTick_s);
    }
    EXPECT_EQ(mapping.goal().position_m, before);
  }
}

TEST(Mapping, KeepsTheGoalWhenTheHandleIsNotFinite) {
  Mapping mapping({});
  mapping.reset({});
  mapping.step(at({0.01, 0.0, 0.0}, MotionMode::kPosition, 1.0), kTick_s);
  const Vector3 before = mapping.goal().position_m;
  mapping.step(at({std::nan(""), 0.0, 0.0}, MotionMode::kPosition, 1.0), kTick_s);
  EXPECT_EQ(mapping.goal().position_m, before);
}

TEST(Mapping, FollowsAgainAfterNonsenseInTheVeryTickOfAChange) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    Mapping mapping({.rate_centre = RateCentre::kWhereModeBegan});
    MappingInput in{.mode = MotionMode::kPosition, .scale = 1.0, .frozen = false};
    mapping.reset(in.handle);
    mapping.step(in, 1e-3);
    MappingInput broken = in;
    broken.mode = MotionMode::kRate;
    broken.handle.p_MH.x() = bad;
    mapping.step(broken, 1e-3);
    broken.handle = {};
    broken.handle.q_MH.w() = bad;
    mapping.step(broken, 1e-3);
    in.mode = MotionMode::kRate;
    in.handle.p_MH = Vector3(0.05, 0.0, 0.0);
    for (int i = 0; i < 10; ++i) mapping.step(in, 1e-3);
    EXPECT_TRUE(mapping.goal().position_m.allFinite());
    // The change counts from the first tick that makes sense: there is the centre, and from there the hand
    // moves.
    in.handle.p_MH.x() += 0.02;
    for (int i = 0; i < 10; ++i) mapping.step(in, 1e-3);
    EXPECT_GT(mapping.goal().position_m.x(), 0.0);
  }
}

// What a limit at the robot does to the goal.
TEST(Mapping, GoesIntoAPressedSurfaceNoFasterThanItMayInRateMode) {
  Mapping mapping({.kv_per_s = 2.0, .dead_zone_m = 0.0, .radius_max_m = 0.05});
  mapping.reset({});
  MappingInput in = at(Vector3::Zero(), MotionMode::kRate, 1.0);
  mapping.step(in, kTick_s);
  in.handle.p_MH = {0.02, 0.01, 0.0};  // 40 and 20 mm/s
  in.surfaces[1] = {{0.01, 0.0, 0.0}, Vector3::UnitX(), 0.005};
  const auto speed = [&] {
    const Vector3 before = mapping.goal().position_m;
    return Vector3((mapping.step(in, kTick_s).position_m - before) / kTick_s);
  };
  EXPECT_NEAR(speed().x(), 0.04, 1e-9) << "in front of it";
  for (int i = 0; i < 300; ++i) mapping.step(in, kTick_s);
  EXPECT_NEAR(speed().x(), 0.005, 1e-9) << "behind it";
  EXPECT_NEAR(speed().y(), 0.02, 1e-9) << "along it";
  in.handle.p_MH = {-0.02, 0.0, 0.0};
  EXPECT_NEAR(speed().x(), -0.04, 1e-9) << "out of it";
}

// The force at the hand commands the depth, in both directions; the hand may always pull the goal out.
TEST(Mapping, MovesTheGoalToTheDepthThatTheForcePermitsInRateMode) {
  Mapping mapping({.kv_per_s = 2.0, .speed_max_m_per_s = 0.25});
  mapping.reset({});
  MappingInput in = at(Vector3::Zero(), MotionMode::kRate, 1.0);
  mapping.step(in, kTick_s);
  const auto depth_m = [&](double deflection_m, double shallow_m, double deep_m, int ticks = 3000) {
    in.handle.p_MH = {deflection_m, 0.0, 0.0};
    in.surfaces[0] = {.place = {0.01, 0.0, 0.0},
                      .inward = Vector3::UnitX(),
                      .speed_max = 0.005,
                      .by_force = true,
                      .shallow = shallow_m,
                      .deep = deep_m};
    for (int i = 0; i < ticks; ++i) mapping.step(in, kTick_s);
    return mapping.goal().position_m.x() - 0.01;
  };
  EXPECT_NEAR(depth_m(0.02, 0.003, 0.003), 0.003, 1e-6);
  EXPECT_NEAR(depth_m(0.02, 0.006, 0.01), 0.006, 1e-6);
  EXPECT_NEAR(depth_m(0.02, 0.002, 0.01), 0.006, 1e-6) << "while the spring is being loaded";
  EXPECT_NEAR(depth_m(0.0, 0.0, 0.001), 0.001, 1e-6) << "the handle is home";
  const double before_m = depth_m(0.02, 0.02, 0.02, 0);
  EXPECT_LE(depth_m(0.02, 0.02, 0.02, 100) - before_m, 100 * kTick_s * 0.005 + 1e-12);
  EXPECT_LT(depth_m(-0.02, 0.0, 0.001, 200), 0.0) << "pulled out";
}

// What the spring at the hand lacks, the robot does not press, but it keeps the contact.
TEST(Mapping, MovesTheGoalOutAsFarAsASpringLacksDepth) {
  constexpr double kScale = 0.5, kPlace_m = 0.01, kHand_m = 0.06;
  const auto goal_m = [&](double unpaid, double least, bool follows) {
    Mapping mapping({.speed_max_m_per_s = 0.25, .goal_follows_force = follows});
    mapping.reset({});
    MappingInput in = at(Vector3::Zero(), MotionMode::kPosition, kScale);
    mapping.step(in, kTick_s);
    in.handle.p_MH = {kHand_m, 0.02, 0.0};
    for (int i = 0; i < 2000; ++i) {
      const double moved_m = (kScale * kHand_m - mapping.goal().position_m.x()) / kScale;
      if (i >= 500)
        in.surfaces[2] = {.place = {kPlace_m, 0.0, 0.0},
                          .inward = Vector3::UnitX(),
                          .unpaid = std::max(0.0, unpaid - moved_m),
                          .least = least};
      mapping.step(in, kTick_s);
    }
    EXPECT_NEAR(mapping.goal().position_m.y(), kScale * 0.02, 1e-12) << "not along the surface";
    return mapping.goal().position_m.x();
  };
  EXPECT_NEAR(goal_m(0.0, 0.0, true), kScale * kHand_m, 1e-12);
  EXPECT_NEAR(goal_m(0.01, 0.0, true), kScale * (kHand_m - 0.01), 1e-6);
  EXPECT_NEAR(goal_m(0.1, 0.004, true), kPlace_m + 0.004, 1e-12) << "the contact is kept";
  EXPECT_NEAR(goal_m(0.01, 0.0, false), kScale * kHand_m, 1e-12);
}

class BoundedGoal : public testing::TestWithParam<MotionMode> {
 protected:
  static constexpr double kSpeed = 0.1;
  Mapping mapping_{{.speed_max_m_per_s = kSpeed}};
  MappingInput in_ = at(Vector3::Zero(), GetParam(), 1.0);
  double step() { return mapping_.step(in_, kTick_s).position_m.x(); }
};

TEST_P(BoundedGoal, IsDrawnBackAtItsLargestSpeedAndRetreatsAtOnce) {
  mapping_.reset({});
  step();
  in_.handle.p_MH = {0.05, 0.0, 0.0};
  while (step() < 0.04) {
  }
  in_.translation_bound = {{0.01, 0.0, 0.0}, Vector3::UnitX(), Mapping::kLead_m};
  double last = mapping_.goal().position_m.x();
  for (int i = 0; i < 1000; ++i) {
    const double now = step();
    EXPECT_GE(now, last - kSpeed * kTick_s - 1e-12);
    last = now;
  }
  EXPECT_NEAR(last, 0.01 + Mapping::kLead_m, 1e-9);
  // Across it, the goal is free.
  in_.handle.p_MH.y() = 0.02;
  for (int i = 0; i < 300; ++i) step();
  EXPECT_GT(mapping_.goal().position_m.y(), 0.005);
  EXPECT_NEAR(mapping_.goal().position_m.x(), 0.01 + Mapping::kLead_m, 1e-9);
  // The reference has slipped: the first motion back counts.
  in_.handle.p_MH.x() = GetParam() == MotionMode::kPosition ? 0.045 : -0.02;
  for (int i = 0; i < 100; ++i) step();
  EXPECT_LT(mapping_.goal().position_m.x(), 0.01 + Mapping::kLead_m - 1e-3);
}
INSTANTIATE_TEST_SUITE_P(Modes, BoundedGoal, testing::Values(MotionMode::kPosition, MotionMode::kRate));

TEST(BoundedGoal, TurnsBack) {
  Mapping mapping({.speed_max_rad_per_s = 1.0});
  mapping.reset({});
  MappingInput in = at(Vector3::Zero(), MotionMode::kPosition, 1.0);
  mapping.step(in, kTick_s);
  in.handle.q_MH = exp_rotation(Vector3(0.0, 0.0, 0.5));
  for (int i = 0; i < 600; ++i) mapping.step(in, kTick_s);
  EXPECT_NEAR(mapping.goal().rotation_rad.z(), 0.5, 1e-9);
  in.rotation_bound = {{0.0, 0.0, 0.2}, Vector3::UnitZ(), Mapping::kLead_rad};
  for (int i = 0; i < 600; ++i) mapping.step(in, kTick_s);
  EXPECT_NEAR(mapping.goal().rotation_rad.z(), 0.2 + Mapping::kLead_rad, 1e-9);
}

}  // namespace
}  // namespace longreach::mapping_test
