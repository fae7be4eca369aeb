#pragma once
// Converts the operator's goal to a setpoint pose that the robot can follow. It limits the speed and
// acceleration of the tool in translation and rotation, keeps the tool in a sphere about its start pose (the
// workspace), and applies the force and moment guards in contact (contact_guard.hpp). While the handle is
// released, the guards use the hold limits. A goal at rest is reached without overshoot; a goal that moves
// within the limits is followed exactly, without lag. Near the last contact of a load in the gripper, the
// speed is limited such that the load cannot hit the surface again faster than the guard can stop it. In space where
// the tool has not been before (free_space.hpp), it moves at most at approach_m_per_s, at which the guard can stop it
// at any surface; against a contact, it brakes harder than otherwise. Every active limit is reported. A goal that is not finite is treated as no goal, so the tool brakes.

#include <limits>
#include <optional>

#include "slave/command/contact_guard.hpp"
#include "slave/command/free_space.hpp"
#include "slave/command/vector_limit.hpp"
#include "slave/config/command_config.hpp"

namespace longreach {

/// The limit that follows from the poses that the joints can reach (commanded_line.hpp).
class ReachLimit {
 public:
  ReachLimit() = default;
  ReachLimit(const ReachLimit&) = delete;
  ReachLimit& operator=(const ReachLimit&) = delete;
  virtual ~ReachLimit() = default;

  /// Returns the velocity in this step for a setpoint at `X_WE` that had the velocity `before` and is to have the
  /// velocity `wanted`. It differs from `before` by at most the accelerations.
  virtual Twist limit(const Pose& X_WE, const Twist& before, const Twist& wanted, double dt) = 0;
  /// True if the last call of limit() reduced the velocity.
  [[nodiscard]] virtual bool ended() const = 0;
};

struct LimiterInput {
  /// If unset, the tool brakes within the limits and stays in place unless a guard makes it retreat.
  std::optional<Pose> X_WE_goal{};
  ContactForce contact{};
  double dt = 0.0;                   // s, > 0
  bool let_go = false;               // the operator has released the handle: the guards use the hold limits
  ContactForce moment{};             // rotational contact: N and m stand for N m and rad
  Vector3 tool_m = Vector3::Zero();  // measured position of the tool, W
  double braking_m_per_s2 = 0.0;     // deceleration against a contact that the joints permit
  /// Maximum speed in unknown space.
  double approach_m_per_s = std::numeric_limits<double>::infinity();
  ReachLimit* reach = nullptr;  // null: the joints reach every pose
};

struct LimiterOutput {
  Pose X_WE{};              // setpoint
  bool tool_speed = false;  // true for each limit that kept the setpoint from its goal
  bool acceleration = false;
  bool workspace = false;
  bool force_guard = false;
  /// True if the retreat distance is used up and neither the force nor the moment has responded to the
  /// retreat.
  bool force_persists = false;
  bool moment_guard = false;
  bool reach = false;          // the joints cannot reach the next poses
  bool unknown_space = false;  // the speed is limited to approach_m_per_s, or soon will be
};

class GoalLimiter {
 public:
  GoalLimiter(const CommandConfig& config, const Vector3& workspace_centre_m)
      : config_(config), centre_m_(workspace_centre_m) {}

  void configure(const CommandConfig& config) { config_ = config; }

  /// Restarts with the setpoint at rest at `X_WE`.
  void reset(const Pose& X_WE);
  /// Replaces the last setpoint, which the joints cannot reach, with `X_WE`; `dt` is the time between the
  /// last two setpoints, s.
  void correct(const Pose& X_WE, double dt);

  /// Starts an engagement, which resets the retreat distances.
  void renew() {
    force_.renew();
    moment_.renew();
    free_space_.forget();
  }

  LimiterOutput step(const LimiterInput& input);

  /// Goal of the last step, clamped to the workspace.
  [[nodiscard]] const std::optional<Pose>& goal() const { return X_WE_goal_; }
  /// True if `p_WE` is in the workspace or at most `margin_m` outside it.
  [[nodiscard]] bool within(const Vector3& p_WE, double margin_m = 0.0) const {
    return (p_WE - centre_m_).norm() <= config_.workspace_m + margin_m;
  }
  [[nodiscard]] const Vector3& centre_m() const { return centre_m_; }  // centre of the workspace, in W
  [[nodiscard]] const Pose& setpoint() const { return X_WE_; }
  [[nodiscard]] const Twist& velocity() const { return V_WE_; }
  [[nodiscard]] bool at_rest() const { return V_WE_.linear.isZero(0.0) && V_WE_.angular.isZero(0.0); }

 private:
  void limit_guards(const LimiterInput& input);
  bool brake(const LimiterInput& input);
  Pose inside(const Pose& goal, LimiterOutput& out) const;
  void observe_goal(const Pose& goal, double dt);
  void move(double dt);
  VelocityCap workspace(double dt) const;
  /// Speed limits of the tool, m/s: near the last contact of a load, and in unknown space.
  double speed_near_contact(const ContactForce& contact);
  [[nodiscard]] double speed_in_space(const LimiterInput& input, const Vector3& goal_m) const;

  CommandConfig config_;
  Vector3 centre_m_;
  Pose X_WE_{};
  Pose X_WE_before_{};               // setpoint of the previous step
  Twist V_WE_{};                     // velocity of the setpoint
  std::optional<Pose> X_WE_goal_{};  // goal of the previous step
  ContactGuard force_{kForceScale}, moment_{kMomentScale};
  FreeSpace free_space_;
  /// Position of the last contact of the load in the gripper.
  std::optional<Vector3> touched_m_{};
  Vector3 turned_rad_ = Vector3::Zero();  // accumulated rotation of the setpoint
  Twist V_WE_goal_{};                     // velocity of the goal, limited like that of the tool
};

}  // namespace longreach
