#pragma once
// A load in the gripper is dragged as a person would drag it: back and forth by a few centimetres, with
// pauses, in rate or position mode. The inertial force of the load must not be mistaken for a contact.

#include <string>

#include "common/core/random.hpp"
#include "deploy/lab/experiment.hpp"
#include "schema/config_scene.hpp"
#include "schema/state_link.hpp"

namespace longreach {

struct DragCell {
  std::string link = "lab";
  double mass_kg = 5.0;  // 0: the gripper closes without a load
  double speed_m_per_s = 0.02;
  double acceleration_m_per_s2 = 0.5;  // acceleration limit of the robot
  double noise_n = 0.05;
  MotionMode mode = MotionMode::kPosition;
  bool wall = false;   // a wall in the path of the load, 30 mm away
  bool known = false;  // the load is dragged back and forth before it meets the wall, so its mass is known
};

struct DragResult {
  /// `held`: the gripper held the load. `moved`: the load covered at least half the distance.
  bool held = false, moved = false;
  int phantoms = 0;  // number of false contacts reported
  int holds = 0;     // number of times that the engagement ended, minus that with an empty gripper
  /// Maximum distance between the tool positions with the load and with an empty gripper at the end of a
  /// pause, m.
  double overrun_m = 0.0;
  double push_n = 0.0;  // maximum inertial force of the load, m |a|
  double reported_kg = 0.0, reported_sd_kg = 0.0;
  double reported_s = 0.0;  // time from the first motion until the mass was identified; 0: never
  /// Time from the first contact of the load with the wall until the contact was reported; 0: not reported.
  double found_s = 0.0;
};

/// Returns the bodies of the scene: a load at the tool, which the gripper grasps when it closes, and the
/// wall. All bodies have the material "hard".
BodiesConfig bodies_of(const DragCell& cell);
DragCell draw_drag(Random& random);
DragResult run_drag(const ExperimentRun& run, const DragCell& cell);

}  // namespace longreach
