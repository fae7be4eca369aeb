// A contact by rotation through the whole loop: a lever on the tool meets a stop, the hand feels how stiff it
// is.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "common/config/config.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/laboratory.hpp"
#include "master/config/rendering_config.hpp"

namespace longreach::hinge_test {
namespace {

struct Felt {
  double displayed_nm_per_rad = 0.0;
  double stop_rad = 0.0;  // where the moment would begin
  double reported_nm_per_rad = 0.0;
  double port_energy_min_j = 0.0;
};

/// Turns the handle about z into the stop, back, in again, and deeper.
Felt turn_into_the_stop(const std::vector<std::string>& settings) {
  std::vector<std::string> all{"scene_file=scenes/hinge.txtpb", "master.safety.engage_at_start=true",
                               "mapping.mode=POSITION", "mapping.scale=1", "rendering.friction_nm=0"};
  all.insert(all.end(), settings.begin(), settings.end());
  const proto::LabConfig config = configure(all, LONGREACH_DEPLOY);
  Laboratory lab(to_struct(config.master()), to_struct(config.slave()), 1);
  const auto turn = [&lab](double rad, double seconds) {
    HandTarget hand;
    hand.rotation_rad = {0.0, 0.0, rad};
    hand.grip = Grip::kFirm;
    for (double t = 0.0; t < seconds; t += lab.period_s()) {
      lab.drive(hand);
      lab.step();
    }
  };
  const auto angle = [&lab] { return log_rotation(lab.devices().spherical().orientation()).z(); };
  turn(0.0, 8.0);
  turn(0.12, 8.0);  // touched, and the news of it
  turn(0.0, 4.0);
  turn(0.12, 6.0);
  Felt felt;
  felt.reported_nm_per_rad = lab.slave().reported_stiffness_nm_per_rad;
  const double angle_1 = angle(), moment_1 = lab.master().F_H_M.moment.z();
  turn(0.2, 6.0);
  const double angle_2 = angle(), moment_2 = lab.master().F_H_M.moment.z();
  felt.displayed_nm_per_rad = -(moment_2 - moment_1) / (angle_2 - angle_1);
  felt.stop_rad = angle_2 + moment_2 / felt.displayed_nm_per_rad;
  felt.port_energy_min_j = lab.master().port_energy_min_j;
  return felt;
}

// 1000 N/m at a lever of 0.1 m, from 0.05 rad on.
TEST(Hinge, TheHandFeelsItsRotationalStiffnessWhereItIs) {
  for (const char* profile : {"lab", "moon"}) {
    const Felt felt = turn_into_the_stop({std::string("profile=") + profile, "rendering.ke_rotation=0.04"});
    EXPECT_NEAR(felt.reported_nm_per_rad, 10.0, 0.5) << profile;
    EXPECT_NEAR(felt.displayed_nm_per_rad, 0.4, 0.05 * 0.4) << profile;
    EXPECT_NEAR(felt.stop_rad, 0.05, 0.005) << profile;
    EXPECT_GE(felt.port_energy_min_j, -returned_most_j()) << profile;
  }
}

TEST(Hinge, IsScaledWithTheMotionIfAskedFor) {
  const Felt felt = turn_into_the_stop(
      {"profile=lab", "rendering.ke_rotation=0.04", "rendering.ke_by_scale=true", "mapping.scale=0.5"});
  EXPECT_NEAR(felt.displayed_nm_per_rad, 0.2, 0.05 * 0.2);
}

struct Turned {
  double moment_max_nm = 0.0, moment_nm = 0.0;  // at the tool; at the end
  double hand_nm = 0.0;
  double behind_rad = 0.0;  // the robot's goal behind the tool
  bool guarded = false, in_contact = false, cut = false;
  std::uint64_t violations = 0;
};

/// The handle by 0.3 rad for 6 s, into a stop of 1000 N m/rad.
Turned turn_far(const std::string& guard_nm) {
  const proto::LabConfig config =
      configure({"scene_file=scenes/hinge.txtpb", "scene.material.stop.stiffness_n_per_m=100000",
                 "profile=lab", "master.safety.engage_at_start=true", "mapping.mode=POSITION",
                 "mapping.scale=1", "command.moment_guard_nm=" + guard_nm},
                LONGREACH_DEPLOY);
  Laboratory lab(to_struct(config.master()), to_struct(config.slave()), 1);
  Turned seen;
  for (const double rad : {0.0, 0.3}) {
    for (double t = 0.0; t < 6.0; t += lab.period_s()) {
      lab.drive({.rotation_rad = {0.0, 0.0, rad}, .grip = Grip::kFirm});
      lab.step();
      seen.moment_nm = lab.arm().true_wrench().moment.norm();
      seen.moment_max_nm = std::max(seen.moment_max_nm, seen.moment_nm);
    }
  }
  seen.hand_nm = lab.master().F_H_M.moment.norm();
  seen.behind_rad = log_rotation(lab.slave().X_WE_goal.q * lab.slave().X_WE.q.conjugate()).norm();
  seen.guarded = lab.master().far.clamps.moment_guard;
  seen.in_contact = lab.master().in_contact;
  seen.cut = lab.master().rotational_stiffness_clamped;
  seen.violations = lab.slave().limit_violations;
  std::printf("moment guard %s N m: at most %.1f N m at the tool, then %.2f; %.3f N m at the hand\n",
              guard_nm.c_str(), seen.moment_max_nm, seen.moment_nm, seen.hand_nm);
  return seen;
}

TEST(Hinge, TheMomentGuardHoldsTheToolAtAStiffStop) {
  const Turned without = turn_far("1000"), with = turn_far("5");
  EXPECT_GT(without.moment_max_nm, 200.0);
  constexpr double kStop_nm_per_rad = 1000.0, kSpeed = 0.3, kReact_s = 0.02, kAcceleration = 2.0;
  EXPECT_LE(with.moment_max_nm,
            5.0 + kStop_nm_per_rad * (kSpeed * kReact_s + 0.5 * kSpeed * kSpeed / kAcceleration));
  EXPECT_LE(with.moment_nm, 1.03 * 5.0);
  EXPECT_GT(with.moment_nm, 4.0);
  EXPECT_TRUE(with.guarded) << "the operator is shown why the robot turns no further";
  EXPECT_TRUE(with.in_contact);
  EXPECT_TRUE(with.cut) << "and that the stop is stiffer than the device can render";
  EXPECT_EQ(with.violations, 0U);
}

}  // namespace
}  // namespace longreach::hinge_test
