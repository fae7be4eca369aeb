#pragma once
// From the goal that the operator asks for to a setpoint pose that the robot may be asked for: speed and
// acceleration of the tool in translation and rotation, a workspace sphere about the tool's start, and the
// force guard:
//   in contact, the speed into the contact is at most √(2 a r), r = (G - F)/k_max - l, l what the setpoint is
//   ahead of the tool by the servo's lag; where r < 0 the setpoint turns back, at up to √(2 a min(-r, l)),
//   the tool only the less far; outwards it is free; from F = G on the setpoint backs out, at (F - G)/(k τ),
//   k the contact's stiffness as far as known, else k_max: the force falls to G with the time constant τ, and
//   the contact is not lost. Without a goal, so in a hold, it does so down to the hold limit, within 1 s as
//   far as speed and acceleration allow; k is then what is seen on that way. While nobody holds the handle G
//   is the hold limit. Giving way ends where the force
//   does not answer to it (relief.hpp). Where the force was seen to grow in another direction than into the
//   contact, the speed in that direction is bounded likewise, and the tool does not give way along it.
// A still goal is reached without overshoot; a goal that keeps the limits is followed exactly, without lag.
// Every clamp is reported. A goal that is not finite counts as none: the tool brakes.

#include <optional>

#include "slave/command/command_config.hpp"
#include "slave/command/relief.hpp"
#include "slave/command/vector_limit.hpp"

namespace longreach {

/// What the force guard knows about the contact.
struct ContactForce {
  bool in_contact = false;
  Vector3 reaction = Vector3::Zero();  // unit, direction of the force on the tool
  double force_n = 0.0;                // measured along it
  double stiffness_n_per_m = 0.0;      // as identified; 0: unknown
  double lead_m = 0.0;                 // of the setpoint into the contact, still to come by the servo's lag
  Vector3 grows = Vector3::Zero();     // unit, in which the force grows though it should not; zero: none
  double grows_lead_m = 0.0;           // of the setpoint in that direction
  bool trusted = true;                 // false: the tool gives way to nothing
  double ease_m_per_s = 0.0;           // but without a goal so fast, to see whether the force answers
};

struct LimiterInput {
  std::optional<Pose> X_WE_goal{};  // none: brake within the limits and stay, but for the bleed-off
  ContactForce contact{};
  double dt = 0.0;      // s, > 0
  bool let_go = false;  // nobody holds the handle: the guard is the hold limit
};

struct LimiterOutput {
  Pose X_WE{};                // setpoint
  bool tool_speed = false;    // kept the setpoint from its goal
  bool acceleration = false;  // likewise
  bool workspace = false;
  bool force_guard = false;
  bool no_relief = false;  // the tool would give way, but the force has not answered
};

class GoalLimiter {
 public:
  GoalLimiter(const CommandConfig& config, const Vector3& workspace_centre_m)
      : config_(config), centre_m_(workspace_centre_m) {}

  void configure(const CommandConfig& config) { config_ = config; }

  /// Begins at rest.
  void reset(const Pose& X_WE);
  /// The robot could only be asked for `X_WE` instead of the last setpoint, `dt` after the one before.
  void correct(const Pose& X_WE, double dt);

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
  bool brake(const ContactForce& contact, double dt);
  [[nodiscard]] double bleed_off(const ContactForce& contact, double limit_n) const;
  [[nodiscard]] double hold_off(const ContactForce& contact);
  [[nodiscard]] double give_way_max(const ContactForce& contact) const;
  void give_way(const ContactForce& contact, double dt);
  void forget_relief(const ContactForce& contact, double dt);
  Pose inside(const Pose& goal, LimiterOutput& out) const;
  void observe_goal(const Pose& goal, double dt);
  VelocityCap guard(const ContactForce& contact) const;
  VelocityCap growth(const ContactForce& contact) const;
  [[nodiscard]] double approach(double left_m, double coming_m) const;
  VelocityCap workspace(double dt) const;

  CommandConfig config_;
  double guard_n_ = 0.0;  // in this step
  Vector3 centre_m_;
  Pose X_WE_{};
  Pose X_WE_before_{};               // one step ago
  Twist V_WE_{};                     // of the setpoint
  std::optional<Pose> X_WE_goal_{};  // of the step before
  struct Bleed {
    double from_n, from_m;  // force and place on the way out where it began
  };
  std::optional<Bleed> bleed_{};  // in a hold
  Relief relief_{};
  double calm_s_ = 0.0;  // below the guard
  Twist V_WE_goal_{};    // as far as the limits allow to believe it
};

}  // namespace longreach
