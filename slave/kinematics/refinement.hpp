#pragma once
// Improves joint angles that almost place the tool at a goal to full accuracy: Newton steps with the exact
// kinematics, also near singular poses, where the closed form has lost half of its digits. Not for starts
// farther away than about 1e-3.

#include "slave/kinematics/kinematics.hpp"

namespace longreach {

/// Joint angles and the corresponding exact kinematics.
struct Placed {
  JointVector joint_rad = JointVector::Zero();
  RigidKinematics tool{};
  Vector3 rotation_error_rad = Vector3::Zero();  // from the tool to the goal
  Vector3 position_error_m = Vector3::Zero();
  double miss = 0.0;  // the larger of both errors, rad and share of the reach
};

class Refinement {
 public:
  static constexpr double kExact = 1e-14;  // rad, and share of the reach

  Refinement(const Kinematics& kinematics, const Rigid& goal) : kinematics_(kinematics), goal_(goal) {}

  [[nodiscard]] Placed at(const JointVector& joint_rad) const;

  /// From `placed.joint_rad`. Returns true if the tool is within kExact of the goal. All of `placed` is
  /// filled in.
  [[nodiscard]] bool improve(Placed& placed) const;

 private:
  [[nodiscard]] Placed moved(const Placed& from, bool damped) const;
  [[nodiscard]] bool newton(Placed& placed) const;
  void step_aside(Placed& placed) const;

  const Kinematics& kinematics_;
  const Rigid& goal_;
};

}  // namespace longreach
