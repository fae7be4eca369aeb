#pragma once
// Computes joint setpoints from a goal:
//   goal -> tool limits (goal_limiter) -> inverse kinematics -> joint limits (joint_limiter) -> setpoint
// A load in the gripper reduces the acceleration limits of the tool (load_limits.hpp).
// If the joints cannot perform a motion, the tool limiter is corrected at once: it continues from the pose
// and velocity of the joint path, so there is no wind-up. The tool moves along its straight path, with two
// exceptions: near a singular pose, and where the arm cannot follow that path. In these cases the joints move
// directly to the inverse-kinematics solution at the goal (an arm with fewer than six joints: also at the nearest
// reachable pose), provided that the
// distance from the tool to the goal never increases by more than 0.5 % of the motion length. At a singular
// pose with several solutions, the arm keeps its last branch. In contact the tool keeps to its
// straight path, except for a retreat that the joints cannot perform on it, which turns the tool. An independent monitor checks every setpoint (limit_watch). The joint limits always hold;
// the speed limits of the tool hold within 1 %, and its acceleration limits only on a straight path.

#include <cstdint>
#include <optional>

#include "slave/command/approach_speed.hpp"
#include "slave/command/commanded_line.hpp"
#include "slave/command/goal_limiter.hpp"
#include "slave/command/joint_limiter.hpp"
#include "slave/command/limit_watch.hpp"
#include "slave/command/stall_detector.hpp"
#include "slave/kinematics/inverse.hpp"

namespace longreach {

/// Conditioning (joint_step.hpp) below which a pose counts as singular.
constexpr double kSingularBand = 0.08;

struct MotionInput {
  std::optional<Pose> X_WE_goal{};  // if unset, the tool brakes and stays in place
  ContactForce contact{};
  double dt = 0.0;        // > 0, s, the same in every step
  bool let_go = false;    // the operator has released the handle: the force is reduced to the hold limit
  ContactForce moment{};  // rotational contact: N and m stand for N m and rad
  /// Measured position of the tool, W; if unset, that of the setpoint.
  std::optional<Vector3> tool_m{};
  double load_kg = 0.0;  // upper bound on the mass in the gripper, also of an unknown load; 0: it is empty
};

class SlaveMotion {
 public:
  /// `touch`: the first touch of an unknown surface (first_touch.hpp), which limits the speed in unknown space; if
  /// unset, the speed is not limited there.
  SlaveMotion(const CommandConfig& command, const RobotConfig& robot,
              const std::optional<FirstTouch>& touch = std::nullopt);
  SlaveMotion(const SlaveMotion&) = delete;
  SlaveMotion& operator=(const SlaveMotion&) = delete;

  void configure(const CommandConfig& command, const std::optional<FirstTouch>& touch = std::nullopt);
  /// Restarts at rest at these joint positions, clamped to the position limits.
  void reset(const JointVector& joint_rad);

  /// Starts an engagement, which resets the retreat distances.
  void renew() { limiter_.renew(); }
  /// Computes the setpoint of one tick. Returns the active limits.
  Clamps step(const MotionInput& input);

  [[nodiscard]] const JointVector& joint_setpoint_rad() const { return joints_.setpoint_rad(); }
  [[nodiscard]] const Pose& X_WE() const { return X_WE_; }  // pose of the setpoint
  [[nodiscard]] const Kinematics& kinematics() const { return inverse_.kinematics(); }
  /// True if the setpoint is in the workspace or at most 1 mm outside it, because an arm may rest at the
  /// edge.
  [[nodiscard]] bool in_workspace() const { return limiter_.within(X_WE_.p, 1e-3); }
  /// The reason code for a tool outside its workspace, with its distance from the centre and the radius, m.
  [[nodiscard]] Reason outside() const {
    return {HoldCause::kToolOutside, 0, (X_WE_.p - limiter_.centre_m()).norm(), command_.workspace_m};
  }
  [[nodiscard]] const Vector3& workspace_centre_m() const { return limiter_.centre_m(); }
  [[nodiscard]] bool at_rest() const { return joints_.settled(); }
  /// True if the retreat distance is used up and neither the force nor the moment has responded to the
  /// retreat.
  [[nodiscard]] bool force_persists() const { return force_persists_; }
  /// Lag of the setpoint behind the joint path, caused by the jerk limit, s.
  [[nodiscard]] double lag_s() const { return joints_.lag_s(); }
  /// Speed limit of the tool in unknown space, m/s, while it is in force; otherwise 0.
  [[nodiscard]] double approach_m_per_s() const { return unknown_space_ ? approach_.speed_m_per_s() : 0.0; }
  /// Acceleration limits of the tool, each while a load in the gripper reduces it; otherwise 0.
  [[nodiscard]] double load_acceleration_m_per_s2() const { return load_acceleration_m_per_s2_; }
  [[nodiscard]] double load_acceleration_rad_per_s2() const { return load_acceleration_rad_per_s2_; }
  [[nodiscard]] std::uint64_t limit_violations() const { return watch_.violations(); }
  [[nodiscard]] const LimitViolations& violations_by_limit() const { return watch_.by_limit(); }
  /// Number of ticks without an exact inverse-kinematics solution.
  [[nodiscard]] std::uint64_t failures() const { return failures_; }

 private:
  [[nodiscard]] InverseResult invert(const Pose& X_WE, const MotionInput& input, bool around);
  /// `X_WE_goal`: the goal of a tool that stands at the end of its line; otherwise unset.
  bool tries_around(const std::optional<Pose>& X_WE_goal, double dt);
  [[nodiscard]] bool far_from(const Pose& X_WE_goal) const;
  [[nodiscard]] bool follows(const JointVector& way_rad, double dt) const;
  [[nodiscard]] double ticks_for(const JointVector& way_rad, double dt) const;
  [[nodiscard]] bool leads_nearer(const JointVector& way_rad, const Rigid& X_WE_goal, double aside_m) const;
  [[nodiscard]] ToolBound tool_bound() const;
  void limit_for_load(double load_kg);
  void find_approach_speed();
  void watch(const MotionInput& input);

  CommandConfig command_;
  RobotConfig robot_;
  Inverse inverse_;
  CommandedLine line_;
  GoalLimiter limiter_;
  JointLimiter joints_;
  LimitWatch watch_;
  StallDetector stall_detector_;
  Pose X_WE_{};
  /// The limits that stopped the tool short of its goal; set while it is stopped there.
  std::optional<Clamps> stands_{};
  bool turning_ = false;  // the joints move in joint space to another solution
  bool around_ = false;   // the same, from the end of a line
  std::optional<Pose> around_goal_{};
  int around_ticks_ = 0;       // until a way around is tried
  double conditioning_ = 1.0;  // conditioning in the previous tick
  /// Joint positions when the arm was last away from a singular pose; they identify its branch.
  JointVector home_rad_ = JointVector::Zero();
  std::uint64_t failures_ = 0;
  bool force_persists_ = false;
  ApproachSpeed approach_;
  int approach_ticks_ = 0;  // until the approach speed is computed again
  bool unknown_space_ = false;
  double load_acceleration_m_per_s2_ = 0.0, load_acceleration_rad_per_s2_ = 0.0;
  int braking_ticks_ = 0;  // remaining ticks in which the setpoint may brake against a contact
};

}  // namespace longreach
