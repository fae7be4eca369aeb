#include "slave/command/goal_limiter.hpp"

#include <algorithm>
#include <cmath>

namespace longreach {
namespace {

constexpr double kSpaceBraking = 0.8;  // of the acceleration, before the end of the free space
constexpr double kNear_m = 0.02;       // distance from a contact at which a load may move twice as fast

Vector3 rotation_between(const Quaternion& from, const Quaternion& to) {
  return log_rotation(to * from.conjugate());
}

// The velocity of the goal moves towards the observed one by no more than the limits permit: a jump of the
// goal is not a velocity.
Vector3 accept(const Vector3& before, const Vector3& seen, const VectorLimits& limits) {
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
  turned_rad_ += rotation_between(X_WE_.q, X_WE.q);
  X_WE_ = X_WE;
}

void GoalLimiter::limit_guards(const LimiterInput& input) {
  const CommandConfig& c = config_;
  const bool let_go = input.let_go;
  const double force_hold_n = hold_limit_n(c), moment_hold_nm = hold_limit_nm(c);
  force_.limit({let_go ? force_hold_n : c.force_guard_n, force_hold_n, c.guard_stiffness_n_per_m,
                c.speed_max_m_per_s, c.acceleration_max_m_per_s2, c.give_way_m, input.braking_m_per_s2});
  moment_.limit({let_go ? moment_hold_nm : c.moment_guard_nm, moment_hold_nm, kGuardStiffness_nm_per_rad,
                 c.speed_max_rad_per_s, c.acceleration_max_rad_per_s2});
}

LimiterOutput GoalLimiter::step(const LimiterInput& input) {
  LimiterOutput out;
  X_WE_before_ = X_WE_;
  limit_guards(input);
  free_space_.step(input.tool_m, !input.contact.in_contact && !input.moment.in_contact, input.dt);
  if (!input.X_WE_goal || !is_finite(*input.X_WE_goal)) {
    out.force_persists = brake(input);
    out.X_WE = X_WE_;
    return out;
  }
  force_.approach(input.contact, X_WE_.p, input.dt);
  moment_.approach(input.moment, turned_rad_, input.dt);
  const Pose goal = inside(*input.X_WE_goal, out);
  observe_goal(goal, input.dt);

  VectorPursuit linear{V_WE_.linear, V_WE_goal_.linear, goal.p - X_WE_.p, {}};
  linear.caps = {force_.cap(input.contact), workspace(input.dt), force_.growth(input.contact)};
  // A retreat from a surface is not slowed down.
  const bool retreats = linear.caps[0].active && linear.caps[0].speed < 0.0;
  const double space_m_per_s = retreats ? config_.speed_max_m_per_s : speed_in_space(input, goal.p);
  const double speed = std::min(space_m_per_s, speed_near_contact(input.contact));
  const VectorStep along = pursue(linear, {speed, config_.acceleration_max_m_per_s2, input.dt});
  VectorPursuit angular{V_WE_.angular, V_WE_goal_.angular, rotation_between(X_WE_.q, goal.q), {}};
  angular.caps = {moment_.cap(input.moment), moment_.growth(input.moment), {}};
  const VectorStep about =
      pursue(angular, {config_.speed_max_rad_per_s, config_.acceleration_max_rad_per_s2, input.dt});

  out.unknown_space = space_m_per_s < config_.speed_max_m_per_s;
  out.tool_speed = along.fast || about.fast;
  out.acceleration = along.hasty || about.hasty;
  out.force_guard = along.capped[0] || along.capped[2];
  out.moment_guard = about.capped[0] || about.capped[1];
  out.workspace = out.workspace || along.capped[1];
  const Twist wanted{about.velocity, along.velocity};
  // A retreat that the joints cannot perform on the line turns the tool (motion.hpp) rather than to press on.
  ReachLimit* const reach = retreats ? nullptr : input.reach;
  V_WE_ = reach ? reach->limit(X_WE_, V_WE_, wanted, input.dt) : wanted;
  out.reach = reach && reach->ended();
  const bool pushed = force_.advanced(input.contact, V_WE_.linear, along.capped[0], input.dt);
  const bool turned = moment_.advanced(input.moment, V_WE_.angular, about.capped[0], input.dt);
  out.force_persists = pushed || turned;
  move(input.dt);
  out.X_WE = X_WE_;
  return out;
}

// Near the last contact, a load may not hit the surface again faster than the guard can stop it.
double GoalLimiter::speed_near_contact(const ContactForce& contact) {
  const double fastest = config_.speed_max_m_per_s;
  if (!(contact.load_kg > 0.0)) touched_m_.reset();
  if (contact.load_kg > 0.0 && contact.in_contact) touched_m_ = X_WE_.p;
  if (!touched_m_) return fastest;
  const double stopped = config_.force_guard_n / std::sqrt(config_.guard_stiffness_n_per_m * contact.load_kg);
  const double away = stopped * (1.0 + (X_WE_.p - *touched_m_).norm() / kNear_m);
  if (away > fastest) touched_m_.reset();
  return std::min(away, fastest);
}

// The speed from which the tool brakes to the approach speed before the end of the free space ahead. A tool at rest
// has no direction yet, so space is unknown.
double GoalLimiter::speed_in_space(const LimiterInput& input, const Vector3& goal_m) const {
  constexpr double kMoves_m_per_s = 1e-3;
  const double fastest = config_.speed_max_m_per_s, slow = input.approach_m_per_s;
  if (!(slow < fastest)) return fastest;
  const bool moves = V_WE_.linear.norm() > kMoves_m_per_s;
  const Vector3 ahead = moves ? V_WE_.linear : Vector3(goal_m - X_WE_.p);
  const double length = ahead.norm();
  if (!(length > 0.0)) return slow;
  const double twice_a = 2.0 * kSpaceBraking * config_.acceleration_max_m_per_s2;
  const double far_m = (fastest * fastest - slow * slow) / twice_a;
  const double free_m = free_space_.free_ahead_m(X_WE_.p, ahead / length, far_m);
  if (!(free_m < far_m)) return fastest;
  // If the direction has changed, the tool brakes like before the end of the free space.
  const double braking = V_WE_.linear.norm() - 0.5 * twice_a * input.dt;
  return std::min(fastest, std::max(std::sqrt(slow * slow + twice_a * free_m), braking));
}

void GoalLimiter::move(double dt) {
  X_WE_.p += V_WE_.linear * dt;
  X_WE_.q = (exp_rotation(V_WE_.angular * dt) * X_WE_.q).normalized();
  turned_rad_ += V_WE_.angular * dt;
}

// Returns true if the retreat distance is used up and the force or the moment has not responded.
bool GoalLimiter::brake(const LimiterInput& input) {
  Vector3 back = force_.back_off(input.contact, X_WE_.p);
  const VelocityCap edge = workspace(input.dt);
  const double over = edge.active ? back.dot(edge.direction) - edge.speed : 0.0;
  if (over > 0.0) back -= over * edge.direction;
  const Vector3 turn_back = moment_.back_off(input.moment, turned_rad_);
  const bool presses = input.contact.in_contact && V_WE_.linear.dot(input.contact.reaction) < 0.0;
  const double acceleration =
      std::max(config_.acceleration_max_m_per_s2, presses ? input.braking_m_per_s2 : 0.0);
  V_WE_.linear += clamp_norm(back - V_WE_.linear, acceleration * input.dt);
  V_WE_.angular += clamp_norm(turn_back - V_WE_.angular, config_.acceleration_max_rad_per_s2 * input.dt);
  move(input.dt);
  X_WE_goal_.reset();
  V_WE_goal_ = {};
  const bool pushed = force_.backed_off(input.contact, V_WE_.linear, input.dt);
  const bool turned = moment_.backed_off(input.moment, V_WE_.angular, input.dt);
  return pushed || turned;
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
    V_WE_goal_.linear = accept(V_WE_goal_.linear, (goal.p - X_WE_goal_->p) / dt, linear);
    V_WE_goal_.angular = accept(V_WE_goal_.angular, rotation_between(X_WE_goal_->q, goal.q) / dt, angular);
  }
  X_WE_goal_ = goal;
}

// Limits the outward speed such that the tool can always stop at the sphere, whatever the goal did before.
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
