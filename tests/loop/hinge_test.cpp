// A contact by rotation through the whole loop: a lever on the tool meets a stop, the hand feels how stiff it
// is.

#include <gtest/gtest.h>

#include "common/config/config.hpp"
#include "master/rendering/rendering_config.hpp"
#include "tests/experiments/experiment.hpp"
#include "tests/experiments/laboratory.hpp"

namespace longreach {
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

}  // namespace
}  // namespace longreach
