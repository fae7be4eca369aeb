#include "slave/command/goal_limiter.hpp"

#include <algorithm>
#include <cmath>

namespace longreach {
namespace {

constexpr double kBleed_s = 0.2;         // τ: of a servo's lag and a loop's delay many times
constexpr double kHoldAim = 0.95;        // of the hold limit, so that it is met within five τ
constexpr double kSeen_n = 0.5;          // of force, that sensor noise does not make
constexpr double kSofter = 0.1;          // of a known stiffness, that a contact may seem to have
constexpr double kSoft_n_per_m = 100.0;  // likewise of an unknown one
constexpr double kBraking = 0.8;         // of the acceleration, for the end of the way
constexpr double kCalm_s = 0.05;         // below the guard: the force has gone
constexpr double kAlong = 0.3;           // cosine: not across

Vector3 rotation_between(const Quaternion& from, const Quaternion& to) {
  return log_rotation(to * from.conjugate());
}

// The goal's velocity moves towards what was seen by no more than the limits: a jump of the goal is not a
// velocity.
Vector3 believe(const Vector3& before, const Vector3& seen, const VectorLimits& limits) {
  return before + clamp_norm(clamp_norm(seen, limits.speed) - before, limits.acceleration * limits.dt);
}

}  // namespace

void GoalLimiter::reset(const Pose& X_WE) {
  X_WE_ = X_WE;
  X_WE_before_ = X_WE;
  V_WE_ = {};
  V_WE_goal_ = {};
  X_WE_goal_.reset();
}

void GoalLimiter::correct(const Pose& X_WE, double dt) {
  V_WE_.linear = clamp_norm((X_WE.p - X_WE_before_.p) / dt, config_.speed_max_m_per_s);
  V_WE_.angular = clamp_norm(rotation_between(X_WE_before_.q, X_WE.q) / dt, config_.speed_max_rad_per_s);
  X_WE_ = X_WE;
}

LimiterOutput GoalLimiter::step(const LimiterInput& input) {
  LimiterOutput out;
  X_WE_before_ = X_WE_;
  guard_n_ = input.let_go ? hold_limit_n(config_) : config_.force_guard_n;
  if (!input.X_WE_goal || !is_finite(*input.X_WE_goal)) {
    out.no_relief = brake(input.contact, input.dt);
    out.X_WE = X_WE_;
    return out;
  }
  bleed_.reset();
  forget_relief(input.contact, input.dt);
  const Pose goal = inside(*input.X_WE_goal, out);
  observe_goal(goal, input.dt);

  VectorPursuit linear{V_WE_.linear, V_WE_goal_.linear, goal.p - X_WE_.p, {}};
  linear.caps = {guard(input.contact), workspace(input.dt), growth(input.contact)};
  const VectorStep along =
      pursue(linear, {config_.speed_max_m_per_s, config_.acceleration_max_m_per_s2, input.dt});
  const VectorPursuit angular{V_WE_.angular, V_WE_goal_.angular, rotation_between(X_WE_.q, goal.q), {}};
  const VectorStep about =
      pursue(angular, {config_.speed_max_rad_per_s, config_.acceleration_max_rad_per_s2, input.dt});

  out.tool_speed = along.fast || about.fast;
  out.acceleration = along.hasty || about.hasty;
  out.force_guard = along.capped[0] || along.capped[2];
  out.workspace = out.workspace || along.capped[1];
  V_WE_ = {about.velocity, along.velocity};
  const bool pressed = input.contact.in_contact && input.contact.force_n > guard_n_;
  if (pressed && along.capped[0]) give_way(input.contact, input.dt);
  out.no_relief = pressed && !relief_.may_go_on();
  X_WE_.p += along.velocity * input.dt;
  X_WE_.q = (exp_rotation(about.velocity * input.dt) * X_WE_.q).normalized();
  out.X_WE = X_WE_;
  return out;
}

// True: the tool would give way, but the force has not answered.
bool GoalLimiter::brake(const ContactForce& contact, double dt) {
  const double wanted = hold_off(contact);
  const Vector3 back =
      std::max(std::min(wanted, give_way_max(contact)), contact.ease_m_per_s) * contact.reaction;
  V_WE_.linear += clamp_norm(back - V_WE_.linear, config_.acceleration_max_m_per_s2 * dt);
  V_WE_.angular -= clamp_norm(V_WE_.angular, config_.acceleration_max_rad_per_s2 * dt);
  X_WE_.p += V_WE_.linear * dt;
  X_WE_.q = (exp_rotation(V_WE_.angular * dt) * X_WE_.q).normalized();
  X_WE_goal_.reset();
  V_WE_goal_ = {};
  if (wanted > 0.0) give_way(contact, dt);
  return wanted > 0.0 && !relief_.may_go_on();
}

// Speed from which it can still end within what is left of its way.
double GoalLimiter::give_way_max(const ContactForce& contact) const {
  if (!contact.trusted || contact.grows.dot(contact.reaction) > kAlong) return 0.0;
  const double left_m = relief_.may_go_on() ? relief_.left_m() : 0.0;
  return std::sqrt(kBraking * 2.0 * config_.acceleration_max_m_per_s2 * left_m);
}

void GoalLimiter::give_way(const ContactForce& contact, double dt) {
  relief_.go(V_WE_.linear.dot(contact.reaction) * dt, contact.force_n, dt);
}

void GoalLimiter::forget_relief(const ContactForce& contact, double dt) {
  const bool calm = !contact.in_contact || contact.force_n <= guard_n_;
  calm_s_ = calm ? calm_s_ + dt : 0.0;
  if (calm_s_ > kCalm_s) relief_.reset();
}

Pose GoalLimiter::inside(const Pose& goal, LimiterOutput& out) const {
  const Vector3 from_centre = goal.p - centre_m_;
  const Vector3 clamped = clamp_norm(from_centre, config_.workspace_m);
  out.workspace = clamped != from_centre;
  return {centre_m_ + clamped, goal.q.normalized()};
}

void GoalLimiter::observe_goal(const Pose& goal, double dt) {
  if (X_WE_goal_) {
    const VectorLimits linear{config_.speed_max_m_per_s, config_.acceleration_max_m_per_s2, dt};
    const VectorLimits angular{config_.speed_max_rad_per_s, config_.acceleration_max_rad_per_s2, dt};
    V_WE_goal_.linear = believe(V_WE_goal_.linear, (goal.p - X_WE_goal_->p) / dt, linear);
    V_WE_goal_.angular = believe(V_WE_goal_.angular, rotation_between(X_WE_goal_->q, goal.q) / dt, angular);
  }
  X_WE_goal_ = goal;
}

// Speed out of the contact that eases what is above the limit; 0: nothing is.
double GoalLimiter::bleed_off(const ContactForce& contact, double limit_n) const {
  if (!contact.in_contact || !(contact.force_n > limit_n)) return 0.0;
  const double k =
      contact.stiffness_n_per_m > 0.0 ? contact.stiffness_n_per_m : config_.guard_stiffness_n_per_m;
  return std::min((contact.force_n - limit_n) / (k * kBleed_s), config_.speed_max_m_per_s);
}

// Likewise in a hold, by the stiffness that the force shows as the tool goes back: not known at a first
// touch, and less than the surface's where the robot gives way, too.
double GoalLimiter::hold_off(const ContactForce& contact) {
  const double limit_n = hold_limit_n(config_), aim_n = kHoldAim * limit_n;
  if (!contact.in_contact || contact.force_n <= aim_n) bleed_.reset();
  if (!contact.in_contact) return 0.0;
  const double out_m = contact.reaction.dot(X_WE_.p) + contact.lead_m;  // the tool, on its way out
  if (!bleed_ && contact.force_n > limit_n) bleed_ = Bleed{contact.force_n, out_m};
  if (!bleed_) return 0.0;
  if (out_m < bleed_->from_m) *bleed_ = {contact.force_n, out_m};
  const bool known = contact.stiffness_n_per_m > 0.0;
  double k = known ? contact.stiffness_n_per_m : config_.guard_stiffness_n_per_m;
  const double least = known ? kSofter * k : std::min(k, kSoft_n_per_m);
  const double seen = (bleed_->from_n - contact.force_n + kSeen_n) / std::max(out_m - bleed_->from_m, 1e-9);
  k = std::clamp(seen, least, k);
  return std::clamp((contact.force_n - aim_n) / (k * kBleed_s), 0.0, config_.speed_max_m_per_s);
}

VelocityCap GoalLimiter::guard(const ContactForce& contact) const {
  VelocityCap cap;
  if (!contact.in_contact) return cap;
  cap.active = true;
  cap.direction = -contact.reaction;
  // In braking distances of the stiffest surface: what is left, or what is too much of what is still coming.
  const double k = config_.guard_stiffness_n_per_m, coming_m = std::max(contact.lead_m, 0.0);
  const double left_m = (guard_n_ - contact.force_n) / k - coming_m;
  const double braking = approach(left_m, coming_m);
  cap.speed = (left_m > 0.0 ? braking : -braking) - bleed_off(contact, guard_n_);
  cap.speed = std::max(cap.speed, -give_way_max(contact));
  return cap;
}

double GoalLimiter::approach(double left_m, double coming_m) const {
  return std::sqrt(2.0 * config_.acceleration_max_m_per_s2 *
                   std::min(std::abs(left_m), left_m > 0.0 ? left_m : coming_m));
}

// Whatever the sensor says of the direction.
VelocityCap GoalLimiter::growth(const ContactForce& contact) const {
  VelocityCap cap;
  if (!contact.in_contact || contact.grows.isZero(0.0)) return cap;
  cap.active = true;
  cap.direction = contact.grows;
  const double left_m =
      (guard_n_ - contact.force_n) / config_.guard_stiffness_n_per_m - std::max(contact.grows_lead_m, 0.0);
  cap.speed = left_m > 0.0 ? approach(left_m, 0.0) : 0.0;
  return cap;
}

// Outwards, the tool can always stop at the sphere, whatever its goal did on the way.
VelocityCap GoalLimiter::workspace(double dt) const {
  VelocityCap cap;
  const Vector3 from_centre = X_WE_.p - centre_m_;
  const double radius = from_centre.stableNorm();
  if (!(radius > 0.5 * config_.workspace_m)) return cap;
  cap.active = true;
  cap.direction = from_centre / radius;
  cap.speed = braking_speed(config_.workspace_m - radius, 0.8 * config_.acceleration_max_m_per_s2, dt);
  return cap;
}

}  // namespace longreach
