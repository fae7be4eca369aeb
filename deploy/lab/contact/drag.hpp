#pragma once
// A load in the gripper, dragged as a person does: along and back by some centimetres, with rests, in rate or
// position mode. What its inertia does to the force sensor is no contact.

#include <string>

#include "common/core/random.hpp"
#include "common/link/motion_command.hpp"
#include "deploy/lab/experiment.hpp"
#include "slave/config/bodies_config.hpp"

namespace longreach {

struct DragCell {
  std::string link = "lab";
  double mass_kg = 5.0;  // 0: the gripper closes on nothing
  double speed_m_per_s = 0.02;
  double acceleration_m_per_s2 = 0.5;  // the most that the robot is allowed
  double noise_n = 0.05;
  MotionMode mode = MotionMode::kPosition;
  bool wall = false;  // in the load's way, 30 mm away
};

struct DragResult {
  bool held = false, moved = false;  // by the gripper; as far as it was to go
  int phantoms = 0;                  // contacts that were told while nothing was touched
  int holds = 0;                     // engagements that ended, and faults
  double overrun_m = 0.0;            // tool at the end of each rest, from where it is with an empty gripper
  double push_n = 0.0;               // greatest m |a|
  double reported_kg = 0.0, reported_sd_kg = 0.0;
  double reported_s = 0.0;  // from the first motion until the mass was known; 0: never
  double found_s = 0.0;     // from the load's first contact with the wall; 0: none
};

/// Its load at the tool, held by a gripper that closes, and the wall; of a material "hard".
BodiesConfig bodies_of(const DragCell& cell);
DragCell draw_drag(Random& random);
DragResult run_drag(const ExperimentRun& run, const DragCell& cell);

}  // namespace longreach
