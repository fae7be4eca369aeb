#pragma once
// A load in the gripper, dragged like by a person: back and forth by some centimetres, with rests, in rate or
// position mode. The effect of its inertia on the force sensor must not be taken for a contact.

#include <string>

#include "common/core/random.hpp"
#include "common/link/motion_command.hpp"
#include "deploy/lab/experiment.hpp"
#include "slave/config/bodies_config.hpp"

namespace longreach {

struct DragCell {
  std::string link = "lab";
  double mass_kg = 5.0;  // 0: the gripper closes without a load
  double speed_m_per_s = 0.02;
  double acceleration_m_per_s2 = 0.5;  // limit of the robot
  double noise_n = 0.05;
  MotionMode mode = MotionMode::kPosition;
  bool wall = false;  // in the path of the load, 30 mm away
};

struct DragResult {
  bool held = false, moved = false;  // by the gripper; over the whole distance
  int phantoms = 0;                  // contacts reported without contact
  int holds = 0;                     // ended engagements, and faults
  /// position of the tool at the end of each rest, relative to the one with an empty gripper
  double overrun_m = 0.0;
  double push_n = 0.0;  // maximum m |a|
  double reported_kg = 0.0, reported_sd_kg = 0.0;
  double reported_s = 0.0;  // from the first motion until the mass was identified; 0: never
  double found_s = 0.0;     // from the load's first contact with the wall; 0: none
};

/// Load at the tool, held by a closing gripper, and the wall; of a material "hard".
BodiesConfig bodies_of(const DragCell& cell);
DragCell draw_drag(Random& random);
DragResult run_drag(const ExperimentRun& run, const DragCell& cell);

}  // namespace longreach
