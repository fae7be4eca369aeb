#pragma once
// Improves joint angles that place the tool almost at a goal to full accuracy, by Newton steps with the exact
// kinematics. This also works near singular poses, where the closed form has lost half of its digits. The
// start must be within about 1e-3 of the solution.

#include "slave/kinematics/kinematics.hpp"

namespace longreach {

/// Joint angles, and the exact kinematics at these angles.
struct Placed {
  JointVector joint_rad = JointVector::Zero();
  RigidKinematics tool{};
  Vector3 rotation_error_rad = Vector3::Zero();  // rotation from the tool to the goal
  Vector3 position_error_m = Vector3::Zero();    // displacement from the tool to the goal
  double miss = 0.0;  // the larger of the two errors, in rad and in multiples of the reach
};

class Refinement {
 public:
  static constexpr double kExact = 1e-14;  // tolerance in rad, and in multiples of the reach

  Refinement(const Kinematics& kinematics, const Rigid& goal) : kinematics_(kinematics), goal_(goal) {}

  [[nodiscard]] Placed at(const JointVector& joint_rad) const;

  /// Starts from `placed.joint_rad` and fills in all of `placed`. Returns true if the tool is within kExact
  /// of the goal.
  [[nodiscard]] bool improve(Placed& placed) const;

 private:
  [[nodiscard]] Placed moved(const Placed& from, bool damped) const;
  [[nodiscard]] bool newton(Placed& placed) const;
  void step_aside(Placed& placed) const;

  const Kinematics& kinematics_;
  const Rigid& goal_;
};

}  // namespace longreach
