#include "master/rendering/renderer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "deploy/lab/comparison/naive_law.hpp"

namespace longreach::renderer_test {
namespace {

TEST(Renderer, ResistsAHandAndNotAHandleThatIsLetGo) {
  Renderer renderer(RenderingConfig{}, RenderedDevice{});
  Mapping mapping{MappingConfig{}};
  RendererInput in;
  in.mode = MotionMode::kRate;
  in.live = true;
  const auto step = [&] {
    mapping.step({in.handle, in.mode, in.scale, false}, 1e-3);
    return renderer.step(in, mapping);
  };
  mapping.reset(in.handle);
  renderer.reset(in.handle);
  for (int i = 1; i <= 300; ++i) {
    in.handle.p_MH = {1e-4 * i, 0.0, 0.0};
    in.handle.velocity_m_per_s = {0.1, 0.0, 0.0};
    step();
  }
  EXPECT_LT(step().force.x(), -60.0 * 0.03);  // the spring of rate mode, and damping
  in.handle.velocity_m_per_s.setZero();
  in.handle.held = false;
  EXPECT_EQ(step().force, Vector3::Zero());
  EXPECT_EQ(step().moment, Vector3::Zero());
}

/// Largest fall of E_port - E_stored while an encoder goes to and fro by one count, J.
double booked_by_a_count(double cell_m) {
  constexpr double kCount_m = 1e-5;
  Renderer renderer(RenderingConfig{}, RenderedDevice{.cell = {.m = cell_m}});
  Mapping mapping{MappingConfig{}};
  RendererInput in;
  in.live = true;
  mapping.reset(in.handle);
  renderer.reset(in.handle);
  for (int i = 0; i < 1000; ++i) {
    in.handle.p_MH.x() = i % 2 == 0 ? 0.0 : kCount_m;
    mapping.step({in.handle, in.mode, in.scale, false}, 1e-3);
    (void)renderer.step(in, mapping);
  }
  return renderer.translation().guard.deficit_max_j();
}

TEST(Renderer, BooksNoEnergyThatMayBeEncoderStepsAlone) {
  EXPECT_LT(booked_by_a_count(5e-6), 1e-12);
  EXPECT_GT(booked_by_a_count(0.0), 1e-5);
}

TEST(Renderer, AHandThatIsStoppedLoadsNoSpringAndLeaksNothing) {
  Renderer renderer(RenderingConfig{}, RenderedDevice{});
  Mapping mapping{MappingConfig{}};
  RendererInput in;
  in.mode = MotionMode::kRate;
  mapping.reset(in.handle);
  renderer.reset(in.handle);
  // Into the springs of rate mode, in both motions; stopped half way, and on.
  const auto push_to = [&](int first, int last) {
    for (int i = first; i <= last; ++i) {
      in.handle.p_MH = {1e-4 * i, 0.0, 0.0};
      in.handle.velocity_m_per_s = {0.1, 0.0, 0.0};
      in.handle.q_MH = Eigen::AngleAxisd(1e-3 * i, Vector3::UnitY());
      in.handle.angular_rad_per_s = {0.0, 1.0, 0.0};
      mapping.step({in.handle, in.mode, in.scale, false}, 1e-3);
      (void)renderer.step(in, mapping);
    }
  };
  in.live = true;
  push_to(1, 300);
  EXPECT_GT(renderer.port_energy_j(), 0.0);
  in.live = false;
  push_to(301, 600);
  EXPECT_LT(renderer.translation().guard.deficit_max_j(), 1e-6);
  EXPECT_LT(renderer.rotation().guard.deficit_max_j(), 1e-6);
  const double then_j = renderer.port_energy_j();
  push_to(601, 700);
  EXPECT_EQ(renderer.port_energy_j(), then_j);
}

/// A hand that is held goes to and fro against friction: what it loses fills the tank.
TEST(Renderer, ANewEngagementBeginsWithItsStoreAndEmptyTanks) {
  Renderer renderer(RenderingConfig{}, RenderedDevice{});
  Mapping mapping{MappingConfig{}};
  RendererInput in;
  in.live = true;
  mapping.reset(in.handle);
  renderer.reset(in.handle);
  for (int i = 1; i <= 2000; ++i) {
    in.handle.p_MH.x() = 0.03 * std::sin(6.0e-3 * i);
    in.handle.q_MH = Eigen::AngleAxisd(0.3 * std::sin(6.0e-3 * i), Vector3::UnitY());
    mapping.step({in.handle, in.mode, in.scale, false}, 1e-3);
    (void)renderer.step(in, mapping);
  }
  EXPECT_GT(renderer.translation().tank.level_j(), 1e-3);
  EXPECT_GT(renderer.rotation().tank.level_j(), 1e-4);
  renderer.reset(in.handle);
  EXPECT_EQ(renderer.translation().tank.level_j(), 0.0);
  EXPECT_EQ(renderer.rotation().tank.level_j(), 0.0);
  EXPECT_EQ(renderer.store_j(), RenderingConfig{}.store_j);
}

/// The edge pushes back with 8 N as the engagement begins, and the hand gives way.
TEST(Renderer, EngagementAtWorkspaceEdgeStartsFromItsForce) {
  Renderer renderer(RenderingConfig{}, RenderedDevice{});
  Mapping mapping{MappingConfig{}};
  RendererInput in;
  constexpr double kEdge_n_per_m = 2000.0, kSpeed_m_per_s = 0.2;
  Vector3 before = Vector3::Zero();
  for (int i = 0; i < 40; ++i) {
    const double over_m = 1e-3 * kSpeed_m_per_s * (20 - std::abs(20 - i));
    in.handle.p_MH.x() = 0.07 + over_m;
    in.handle.velocity_m_per_s = {i < 20 ? kSpeed_m_per_s : -kSpeed_m_per_s, 0.0, 0.0};
    in.translation.force = {-kEdge_n_per_m * over_m, 0.0, 0.0};
    in.translation.stored_j = 0.5 * kEdge_n_per_m * over_m * over_m;
    if (i == 20) mapping.reset(in.handle), renderer.reset(in.handle), in.live = true;
    mapping.step({in.handle, in.mode, in.scale, false}, 1e-3);
    const Vector3 force = renderer.step(in, mapping).force;
    EXPECT_LT((force - before).norm(), 1.5) << "tick " << i;
    before = force;
  }
  EXPECT_LT(renderer.translation().guard.deficit_max_j(), 2e-3);
}

/// Presses on a wall, then the engagement ends; long after that the clutch is pressed.
TEST(Renderer, TheClutchOfAHandThatIsNotEngagedChangesNothing) {
  Renderer renderer(RenderingConfig{}, RenderedDevice{});
  Mapping mapping{MappingConfig{}};
  GoalHistories history(1000);
  RendererInput in;
  in.live = true;
  mapping.reset(in.handle);
  renderer.reset(in.handle);
  double pressed_n = 0.0;
  for (int i = 1; i <= 2000; ++i) {
    in.handle.p_MH.x() = 5e-5 * std::min(i, 200);
    in.handle.velocity_m_per_s = {i <= 200 ? 0.05 : 0.004, 0.0, 0.0};
    in.live = i <= 300;
    in.clutched = i > 1500;
    mapping.step({in.handle, in.mode, in.scale, in.clutched}, 1e-3);
    history.translation.push(static_cast<std::uint64_t>(i), mapping.goal().position_m);
    history.rotation.push(static_cast<std::uint64_t>(i), mapping.goal().rotation_rad);
    if (i == 100) {
      StiffnessReport report;
      report.translation.surfaces[0] = {.normal = -Vector3::UnitX(),
                                        .stiffness = 500.0,
                                        .touch_sequence = 50.0,
                                        .touch = 1,
                                        .pressed = true};
      EXPECT_TRUE(renderer.on_report(report, history, in, mapping));
    }
    const double force_n = renderer.step(in, mapping).force.norm();
    if (i <= 300) pressed_n = std::max(pressed_n, force_n);
    if (i > 1400) {
      ASSERT_EQ(force_n, 0.0) << i;
    }
  }
  EXPECT_GT(pressed_n, 1.0);
}

/// Presses by 20 mm at 50 mm/s; after 5 mm a report comes of a wall of 500 N/m behind the hand. Returns by
/// how much the step that is told changes after that: by the motion, or by a second report, of 5000 N/m,
/// after 10 mm.
double step_by_a_report(const ContactLaw* law, bool reports, const RenderingConfig& config = {}) {
  Renderer renderer(config, RenderedDevice{});
  renderer.render_by(law);
  Mapping mapping{MappingConfig{}};
  GoalHistories history(1000);
  RendererInput in;
  in.live = true;
  mapping.reset(in.handle);
  renderer.reset(in.handle);
  double first_n = 0.0, largest_n = 0.0;
  for (int i = 1; i <= 400; ++i) {
    in.handle.p_MH.x() = 5e-5 * i;
    in.handle.velocity_m_per_s = {0.05, 0.0, 0.0};
    mapping.step({in.handle, in.mode, in.scale, false}, 1e-3);
    history.translation.push(static_cast<std::uint64_t>(i), mapping.goal().position_m);
    history.rotation.push(static_cast<std::uint64_t>(i), mapping.goal().rotation_rad);
    if (i == 100 || (reports && i == 200)) {
      StiffnessReport report;
      report.translation.surfaces[0] = {.normal = -Vector3::UnitX(),
                                        .stiffness = i == 100 ? 500.0 : 5000.0,
                                        .touch_sequence = 50.0,
                                        .touch = 1,
                                        .pressed = true};
      EXPECT_TRUE(renderer.on_report(report, history, in, mapping));
    }
    (void)renderer.step(in, mapping);
    if (i == 100) first_n = renderer.force_step_n();
    if (i > 100) largest_n = std::max(largest_n, std::abs(renderer.force_step_n() - first_n));
  }
  return largest_n;
}

TEST(Renderer, TheStepOfAReportIsThatOfItsLawAndMotionIsNone) {
  const NaiveLaw naive;
  EXPECT_GT(step_by_a_report(&naive, true), 10.0);
  EXPECT_LT(step_by_a_report(nullptr, true), 0.2);
  EXPECT_EQ(step_by_a_report(&naive, false), 0.0);
  EXPECT_EQ(step_by_a_report(nullptr, false), 0.0);
}

TEST(Renderer, HasNoLawButItsSpringsWhateverIsSet) {
  const double springs_n = step_by_a_report(nullptr, true);
  for (const RenderingLaw law : {RenderingLaw::kNaive, RenderingLaw::kDirect, RenderingLaw::kPositionPosition,
                                 RenderingLaw::kWave, RenderingLaw::kTdpa, RenderingLaw::kTank})
    EXPECT_EQ(step_by_a_report(nullptr, true, {.law = law}), springs_n);
}

// A report shows the surface deeper than it is, and the force falls by its ramp; the next one corrects this.
TEST(Renderer, AReportThatEndsAFallIsNoStep) {
  Renderer renderer(RenderingConfig{}, RenderedDevice{});
  Mapping mapping{MappingConfig{}};
  GoalHistories history(1000);
  RendererInput in;
  in.live = true;
  mapping.reset(in.handle);
  renderer.reset(in.handle);
  const auto reported = [&](double sequence) {
    StiffnessReport report;
    report.translation.surfaces[0] = {.normal = -Vector3::UnitX(),
                                      .stiffness = 1000.0,
                                      .touch_sequence = sequence,
                                      .touch = static_cast<std::uint32_t>(sequence),
                                      .pressed = true};
    EXPECT_TRUE(renderer.on_report(report, history, in, mapping));
  };
  double fell_n = 0.0;
  for (int i = 1; i <= 220; ++i) {
    in.handle.p_MH.x() = 1e-4 * std::min(i, 200);
    in.handle.velocity_m_per_s.x() = i < 200 ? 0.1 : 0.0;
    mapping.step({in.handle, in.mode, in.scale, false}, 1e-3);
    history.translation.push(static_cast<std::uint64_t>(i), mapping.goal().position_m);
    history.rotation.push(static_cast<std::uint64_t>(i), mapping.goal().rotation_rad);
    if (i == 100) reported(100.0);
    if (i == 205) reported(190.0);
    if (i == 210) reported(120.0);
    const double before_n = renderer.translation().contact.foremost().force;
    (void)renderer.step(in, mapping);
    if (i == 205) fell_n = before_n - renderer.translation().contact.foremost().force;
    if (i >= 206) {
      EXPECT_LE(renderer.force_step_n(), 0.05) << i;
    }
  }
  EXPECT_NEAR(fell_n, 0.3, 0.05);
}

}  // namespace
}  // namespace longreach::renderer_test
