// The boundary at which a limit holds the robot back is felt as a wall of 1 N/mm or 5 N m/rad, from which the goal is at
// most 3 mm or 0.04 rad away, and obeys the rules of rendering when the limit begins and ends.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "common/core/random.hpp"
#include "deploy/lab/comparison/naive_law.hpp"
#include "master/master_node.hpp"

namespace longreach::felt_boundary_test {
namespace {

constexpr double kBoundary_m = 0.01, kBoundary_rad = 0.1;  // place of the boundary along x and about x
constexpr double kRad_per_m = 10.0;
constexpr double kStep_n = 0.3, kStep_nm = 0.01;
constexpr double kStiffness_n_per_m = 1000.0, kStiffness_nm_per_rad = 5.0;

/// An engaged master whose handle is moved along x and about x by the test.
struct HeldHand {
  explicit HeldHand(MotionMode mode, RenderingLaw law = RenderingLaw::kStiffness) {
    MasterConfig config;
    config.mapping.mode = mode;
    config.mapping.scale = 1.0;
    node.emplace(config);
    node->render_by(contact_law(law));
    in.requests.engage = true;
    step(0.0);
    report(false);
    step(0.0);
    step(0.0);
    EXPECT_TRUE(node->engaged());
  }
  /// Sets the next report: whether limits hold the robot back at the boundary.
  void report(bool held_back) {
    newest.message = {.engagement = node->view().engagement, .state = SafetyState::kEngaged};
    if (held_back) {
      newest.message.translation.held_back = newest.message.rotation.held_back = Vector3::UnitX();
      newest.message.translation.place.x() = kBoundary_m;
      newest.message.rotation.place.x() = kBoundary_rad;
    }
    ++newest.sequence;
    in.reports = {&newest, 1};
  }
  /// Moves the handle to `m` along x and by kRad_per_m times that about x, in one tick.
  void step(double m) {
    const double speed = (m - in.handle.p_MH.x()) / 1e-3;
    in.now += std::chrono::milliseconds(1);
    in.last_heard = in.now;
    in.handle.p_MH.x() = m;
    in.handle.q_MH = exp_rotation(kRad_per_m * m * Vector3::UnitX());
    in.handle.velocity_m_per_s = {speed, 0.0, 0.0};
    in.handle.angular_rad_per_s = {kRad_per_m * speed, 0.0, 0.0};
    const Wrench last = felt;
    felt = node->step(in).F_H_M;
    in.requests = {};
    in.reports = {};
    const double moved = std::abs(speed) * 1e-3;
    const double allowed_n = kStep_n + 1.2 * kStiffness_n_per_m * moved;
    const double allowed_nm = kStep_nm + 1.2 * kStiffness_nm_per_rad * kRad_per_m * moved;
    step_n = std::max(step_n, (felt.force - last.force).norm() - allowed_n + kStep_n);
    step_nm = std::max(step_nm, (felt.moment - last.moment).norm() - allowed_nm + kStep_nm);
    largest_n = std::max(largest_n, node->view().spring_force_n.norm());
    largest_nm = std::max(largest_nm, node->view().spring_moment_nm.norm());
  }
  /// Moves the handle to `m` at 10 mm/s and waits for a second; a report arrives every 50 ms.
  void move(double m, bool held_back) {
    const double from = in.handle.p_MH.x();
    const int moving = static_cast<int>(std::abs(m - from) / 1e-5);
    for (int i = 1; i <= moving + 1000; ++i) {
      if (i % 50 == 0) report(held_back);
      step(from + (m - from) * std::min(1.0, static_cast<double>(i) / moving));
    }
  }

  std::optional<MasterNode> node;
  MasterInput in{};
  Received<StiffnessReport> newest{};
  Wrench felt{};
  // Largest changes of force and moment in a tick, beyond those by the motion of the handle.
  double step_n = 0.0, step_nm = 0.0;
  double largest_n = 0.0, largest_nm = 0.0;  // of the contact forces and moments
};

Vector3 wall_n(const HeldHand& hand) { return hand.node->view().spring_force_n; }
/// The moment of the wall at this depth; the device bounds the stiffness that can be rendered.
double moment_nm(const HeldHand& hand, double rad) {
  return -rad * std::min(kStiffness_nm_per_rad, hand.node->view().rotational_stiffness_max_nm_per_rad);
}
Vector3 wall_nm(const HeldHand& hand) { return hand.node->view().spring_moment_nm; }

TEST(FeltBoundary, IsAWallInPositionMode) {
  HeldHand hand(MotionMode::kPosition);
  hand.move(kBoundary_m, true);
  EXPECT_NEAR(wall_n(hand).norm(), 0.0, 0.1);
  hand.move(kBoundary_m + 2e-3, true);
  EXPECT_NEAR(wall_n(hand).x(), -2.0, 0.2);
  EXPECT_NEAR(wall_nm(hand).x(), moment_nm(hand, 0.02), 1e-3);
  hand.move(kBoundary_m + 8e-3, true);
  EXPECT_NEAR(wall_n(hand).x(), -3.0, 0.2);
  EXPECT_NEAR(wall_nm(hand).x(), moment_nm(hand, 0.04), 1e-3);
  hand.move(kBoundary_m + 4e-3, true);
  EXPECT_NEAR(wall_n(hand).norm(), 0.0, 1e-9) << "the hand retreats";
  EXPECT_NEAR(wall_nm(hand).norm(), 0.0, 1e-9);
}

TEST(FeltBoundary, IsAWallInRateMode) {
  HeldHand hand(MotionMode::kRate);
  for (int i = 0; i < 4; ++i) hand.move(0.015, true);  // the goal moves at 20 mm/s and 0.05 rad/s
  EXPECT_NEAR(wall_n(hand).x(), -3.0, 0.3);
  EXPECT_NEAR(wall_nm(hand).x(), moment_nm(hand, 0.04), 1e-3);
  hand.move(0.0, true);
  EXPECT_EQ(wall_n(hand).norm(), 0.0) << "the hand is at home";
}

TEST(FeltBoundary, IsNotFeltWithoutALimit) {
  for (const MotionMode mode : {MotionMode::kPosition, MotionMode::kRate}) {
    HeldHand hand(mode);
    hand.move(0.02, false);
    EXPECT_EQ(wall_n(hand).norm(), 0.0);
    EXPECT_EQ(wall_nm(hand).norm(), 0.0);
  }
}

/// Moves the hand to and fro over the boundary for a minute, while the limit begins and ends at drawn times.
void move_over_the_boundary(HeldHand& hand, std::uint64_t seed) {
  Random random(seed);
  bool held_back = false;
  int changes_at = 0;
  for (int i = 0; i < 60'000; ++i) {
    if (i >= changes_at) {
      held_back = !held_back;
      changes_at = i + static_cast<int>(random.uniform(10.0, 600.0));
      hand.report(held_back);
    }
    hand.step(0.012 * (1.0 - std::cos(0.003 * i)));
  }
}

TEST(FeltBoundary, BeginsAndEndsWithoutAStepOrEnergy) {
  for (const MotionMode mode : {MotionMode::kPosition, MotionMode::kRate}) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      HeldHand hand(mode);
      move_over_the_boundary(hand, seed);
      std::printf("mode %d: steps %.2f N, %.4f N m; at most %.1f mJ returned, %.3f mJ leaked\n",
                  static_cast<int>(mode), hand.step_n, hand.step_nm,
                  -1e3 * hand.node->view().port_energy_min_j, 1e3 * hand.node->view().energy_drawdown_j);
      EXPECT_LE(hand.step_n, kStep_n);
      EXPECT_LE(hand.step_nm, kStep_nm);
      EXPECT_GE(hand.node->view().port_energy_min_j, -RenderingConfig{}.store_j);
      EXPECT_GT(hand.largest_n, 1.0);
      EXPECT_GT(hand.largest_nm, 0.02);
    }
  }
}

// The hand is beyond the boundary before the limit begins, so that the springs are loaded from the store.
TEST(FeltBoundary, ReturnsNoMoreThanTheStoreHoweverOftenItBegins) {
  for (const RenderingLaw law : {RenderingLaw::kStiffness, RenderingLaw::kNaive}) {
    HeldHand hand(MotionMode::kPosition, law);
    for (int i = 0; i < 20; ++i) {
      hand.move(0.02, false);
      for (int s = 0; s < 2; ++s) hand.move(0.02, true);
      hand.move(0.0, true);
    }
    const double returned_j = -hand.node->view().port_energy_min_j;
    std::printf("at most %.1f mJ returned\n", 1e3 * returned_j);
    if (law == RenderingLaw::kStiffness) {
      EXPECT_LE(returned_j, RenderingConfig{}.store_j);
      EXPECT_GT(hand.largest_n, 1.0);
    } else {
      EXPECT_GT(returned_j, 2.0 * RenderingConfig{}.store_j) << "without the rules of rendering";
    }
  }
}

TEST(FeltBoundary, StepsWithoutTheRulesOfRendering) {
  HeldHand hand(MotionMode::kPosition, RenderingLaw::kNaive);
  move_over_the_boundary(hand, 1);
  EXPECT_GT(hand.step_n, 2.0 * kStep_n);
  EXPECT_GT(hand.step_nm, 2.0 * kStep_nm);
}

}  // namespace
}  // namespace longreach::felt_boundary_test
