#pragma once
// Computes joint setpoints from a goal:
//   goal -> tool limits (goal_limiter) -> inverse kinematics -> joint limits (joint_limiter) -> setpoint
// Motion that the joints cannot perform is corrected in the tool limiter immediately: its pose and velocity
// are those of the joint path, so there is no wind-up. The joints follow the straight path of the tool,
// except near a singular pose and where the arm blocks itself: there they move straight to the solution at
// the goal, or to the nearest pose, as long as the tool only approaches the goal, within half a per cent of
// the distance. Of several solutions at a singular pose they take the branch that the arm was last in. In
// contact the tool keeps its straight path. Every setpoint is monitored independently, by differences. The
// joint limits always hold, the speed limits of the tool within 1 %; its acceleration limits only on a
// straight path.

#include <cstdint>
#include <optional>

#include "slave/command/goal_limiter.hpp"
#include "slave/command/joint_limiter.hpp"
#include "slave/command/limit_watch.hpp"
#include "slave/command/stall_detector.hpp"
#include "slave/kinematics/inverse.hpp"

namespace longreach {

/// Conditioning (joint_step.hpp) below which the arm is at a singular pose.
constexpr double kSingularBand = 0.08;

struct MotionInput {
  std::optional<Pose> X_WE_goal{};  // none: brake and stay
  ContactForce contact{};
  double dt = 0.0;        // > 0, s, the same in every step
  bool let_go = false;    // no hand is on the handle: the force is reduced to the hold limit
  ContactForce moment{};  // of a contact by rotation: N are N m, m are rad
};

class SlaveMotion {
 public:
  SlaveMotion(const CommandConfig& command, const RobotConfig& robot);

  void configure(const CommandConfig& command);
  /// At rest at these joints, moved into their limits.
  void reset(const JointVector& joint_rad);

  /// Starts an engagement, which restores the retreat distance.
  void renew() { limiter_.renew(); }
  /// Returns the active limits.
  Clamps step(const MotionInput& input);

  [[nodiscard]] const JointVector& joint_setpoint_rad() const { return joints_.setpoint_rad(); }
  [[nodiscard]] const Pose& X_WE() const { return X_WE_; }  // of the setpoint
  [[nodiscard]] const Kinematics& kinematics() const { return inverse_.kinematics(); }
  /// The tool at the setpoint is in the workspace or at most 1 mm outside: an arm may rest at the edge.
  [[nodiscard]] bool in_workspace() const { return limiter_.within(X_WE_.p, 1e-3); }
  /// Distance outside of the workspace.
  [[nodiscard]] Reason outside() const {
    return {HoldCause::kToolOutside, 0, (X_WE_.p - limiter_.centre_m()).norm(), command_.workspace_m};
  }
  [[nodiscard]] const Vector3& workspace_centre_m() const { return limiter_.centre_m(); }
  [[nodiscard]] bool at_rest() const { return joints_.settled(); }
  /// The tool would retreat, but the force or moment has not responded.
  [[nodiscard]] bool force_persists() const { return force_persists_; }
  [[nodiscard]] double lag_s() const { return joints_.lag_s(); }  // of the setpoint, by its jerk limit
  [[nodiscard]] std::uint64_t limit_violations() const { return watch_.violations(); }
  [[nodiscard]] const LimitViolations& violations_by_limit() const { return watch_.by_limit(); }
  [[nodiscard]] std::uint64_t failures() const { return failures_; }  // ticks without a solution

 private:
  [[nodiscard]] InverseResult invert(const Pose& X_WE, const MotionInput& input);
  [[nodiscard]] double ticks_for(const JointVector& way_rad, double dt) const;
  [[nodiscard]] bool leads_nearer(const JointVector& way_rad, const Rigid& X_WE_goal, double aside_m) const;
  [[nodiscard]] ToolBound tool_bound() const;

  CommandConfig command_;
  RobotConfig robot_;
  Inverse inverse_;
  GoalLimiter limiter_;
  JointLimiter joints_;
  LimitWatch watch_;
  StallDetector stall_detector_;
  Pose X_WE_{};
  std::optional<Clamps> stands_{};              // reason
  bool turning_ = false;                        // moving along a joint path to another solution
  double conditioning_ = 1.0;                   // of the previous tick
  JointVector home_rad_ = JointVector::Zero();  // of the last branch of the arm, away from singular poses
  std::uint64_t failures_ = 0;
  bool force_persists_ = false;
};

}  // namespace longreach
