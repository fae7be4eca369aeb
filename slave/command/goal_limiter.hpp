#pragma once
// Converts the goal of the operator to a setpoint pose that the robot can follow: limits speed and
// acceleration of the tool in translation and rotation, a workspace sphere about the start of the tool, and
// applies the guards of force and moment in contact (contact_guard.hpp). While the handle is released these
// are the hold limits.
// A still goal is reached without overshoot; a goal within the limits is followed exactly, without lag. Every
// active limit is reported. A goal that is not finite counts as no goal: the tool brakes.

#include <optional>

#include "slave/command/contact_guard.hpp"
#include "slave/command/vector_limit.hpp"
#include "slave/config/command_config.hpp"

namespace longreach {

struct LimiterInput {
  /// none: brake within the limits and stay, except for the retreat of a guard
  std::optional<Pose> X_WE_goal{};
  ContactForce contact{};
  double dt = 0.0;        // s, > 0
  bool let_go = false;    // no hand is on the handle: the guard is the hold limit
  ContactForce moment{};  // of a contact by rotation: N are N m, m are rad
};

struct LimiterOutput {
  Pose X_WE{};                // setpoint
  bool tool_speed = false;    // kept the setpoint from its goal
  bool acceleration = false;  // likewise
  bool workspace = false;
  bool force_guard = false;
  bool force_persists = false;  // the tool would retreat, but the force or the moment has not responded
  bool moment_guard = false;
};

class GoalLimiter {
 public:
  GoalLimiter(const CommandConfig& config, const Vector3& workspace_centre_m)
      : config_(config), centre_m_(workspace_centre_m) {}

  void configure(const CommandConfig& config) { config_ = config; }

  /// Starts at rest.
  void reset(const Pose& X_WE);
  /// The robot could only be commanded to `X_WE` instead of the last setpoint, `dt` after the previous one.
  void correct(const Pose& X_WE, double dt);

  /// Starts an engagement, which restores the retreat distance.
  void renew() {
    force_.renew();
    moment_.renew();
  }

  LimiterOutput step(const LimiterInput& input);

  [[nodiscard]] const std::optional<Pose>& goal() const {
    return X_WE_goal_;
  }  // of the last step, in the workspace
  [[nodiscard]] bool within(const Vector3& p_WE, double margin_m = 0.0) const {
    return (p_WE - centre_m_).norm() <= config_.workspace_m + margin_m;
  }
  [[nodiscard]] const Vector3& centre_m() const { return centre_m_; }  // of the workspace
  [[nodiscard]] const Pose& setpoint() const { return X_WE_; }
  [[nodiscard]] const Twist& velocity() const { return V_WE_; }
  [[nodiscard]] bool at_rest() const { return V_WE_.linear.isZero(0.0) && V_WE_.angular.isZero(0.0); }

 private:
  void limit_guards(bool let_go);
  bool brake(const LimiterInput& input);
  Pose inside(const Pose& goal, LimiterOutput& out) const;
  void observe_goal(const Pose& goal, double dt);
  void move(double dt);
  VelocityCap workspace(double dt) const;

  CommandConfig config_;
  Vector3 centre_m_;
  Pose X_WE_{};
  Pose X_WE_before_{};               // previous step
  Twist V_WE_{};                     // of the setpoint
  std::optional<Pose> X_WE_goal_{};  // of the previous step
  ContactGuard force_{kForceScale}, moment_{kMomentScale};
  Vector3 turned_rad_ = Vector3::Zero();  // sum of the rotations of the setpoint
  Twist V_WE_goal_{};                     // as far as the limits permit
};

}  // namespace longreach
