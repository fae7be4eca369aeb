#pragma once
// Joint angles for a tool pose, from joint angles nearby: damped least squares
//   (JᵀJ + (|e|² + μ) I) Δq = Jᵀ e,   e = [L log(R_goal Rᵀ); p_goal - p]
// with the robot's reach L making radians and metres comparable, damping |e|² that vanishes at the solution
// (Sugihara 2011: quadratic convergence), and μ that rises near singular poses and after a step that did not
// help (Levenberg). Joint limits are kept by projection. Finds the solution of the branch that it starts in
// and no other.

#include <cstdint>

#include "slave/robot/kinematics.hpp"

namespace longreach {

struct InverseTolerance {
  double residual_m = 1e-10;          // |e| at which it stops, m
  std::uint32_t iterations_max = 20;  // steps tried, at least 1
};

enum class InverseStatus : std::uint8_t {
  kFound,        // joint_rad reaches the goal within the tolerance
  kNotConverged  // joint_rad is the nearest that was found, within the joint limits
};

struct InverseResult {
  InverseStatus status = InverseStatus::kNotConverged;
  JointVector joint_rad = JointVector::Zero();  // finite if the start was
  Pose X_WE{};                                  // of joint_rad
  double residual_m = 0.0;                      // |e| of joint_rad
  double conditioning = 0.0;    // least pivot of J over L: 0 at a singular pose, about 0.3 at a good one
  bool at_joint_limit = false;  // a joint limit was in the way
  std::uint32_t iterations = 0;
};

class NumericInverse {
 public:
  explicit NumericInverse(const RobotConfig& robot);

  /// `start_rad`: within the joint limits, finite. A goal that is not finite is answered with the start.
  [[nodiscard]] InverseResult solve(const Pose& X_WE_goal, const JointVector& start_rad,
                                    const InverseTolerance& tolerance) const;

  [[nodiscard]] const Kinematics& kinematics() const { return kinematics_; }

 private:
  Kinematics kinematics_;
  JointVector min_rad_;
  JointVector max_rad_;
};

}  // namespace longreach
