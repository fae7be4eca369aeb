#include "master/mapping/mapping.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace longreach {
namespace {

constexpr double kReentry = 0.9;    // fraction of the dead zone at which the motion of the literal law ends
constexpr double kSmooth_s = 0.1;   // time constant of the velocity for forecasts in position mode
constexpr double kReach_rad = 2.0;  // beyond the range of any handle
constexpr double kHomeRadius_m = 1e-3, kHomeRadius_rad = 0.01;
constexpr double kUnlimited = std::numeric_limits<double>::infinity();

/// Returns the radius within which a handle is home. A dead zone may be smaller than the noise of a hand.
double home_radius(double dead_zone, double least) { return std::max(dead_zone, least); }

/// Lets kv approach its configured value.
double ramped(double kv_per_s, double wanted_per_s, double dt_s) {
  constexpr double kRamp_s = 0.1, kEnd = 1e-4;  // time constant, and the relative difference at which it ends
  const double left_per_s = wanted_per_s - kv_per_s;
  if (std::abs(left_per_s) <= kEnd * wanted_per_s) return wanted_per_s;
  return kv_per_s - std::expm1(-dt_s / kRamp_s) * left_per_s;
}

/// Applies the rate law to one device. `outside` stores on which side of the edge the handle is.
Vector3 rate_of(const Vector3& deflection, double dead_zone, double radius_max, RateLaw law, bool& outside) {
  const double edge = law == RateLaw::kLiteral && outside ? kReentry * dead_zone : dead_zone;
  const Vector3 rate = rate_law(deflection, edge, radius_max, law);
  outside = !rate.isZero(0.0);
  return rate;
}

/// Limits the component of `speed` into a pressed surface. If the force commands the depth, this component moves the
/// goal into the permitted range, at most at `speed_max`, unless the hand pulls the goal out.
Vector3 press(Vector3 speed, const Vector3& goal, const PressedSurfaces& surfaces, double speed_max) {
  constexpr double kFollow_s = 0.1;  // time constant: the tool does not follow the tremor of the hand
  for (const PressedSurface& s : surfaces) {
    const double depth = s.inward.dot(goal - s.place);
    if (!(depth > 0.0)) continue;
    const double into = s.inward.dot(speed);
    double most = s.speed_max;
    if (s.by_force) {
      const double wanted = std::clamp(depth, s.shallow, std::max(s.shallow, s.deep));
      most = std::clamp((wanted - depth) / kFollow_s, -speed_max, s.speed_max);
    }
    if (into > most || (s.by_force && into >= 0.0)) speed += (most - into) * s.inward;
  }
  return speed;
}

/// Moves a goal out of the surfaces that the hand presses, so that it is `scale` times as deep as the hand's spring: the
/// robot then presses as the hand does.
Vector3 eased(Vector3 goal, const PressedSurfaces& surfaces, double scale) {
  for (const PressedSurface& s : surfaces) {
    const double over = s.inward.dot(goal - s.place) - scale * s.depth;
    if (s.depth > 0.0 && over > 0.0) goal -= over * s.inward;
  }
  return goal;
}

/// Returns by how much the goal has to move in `dt_s` out of the surfaces whose springs lack depth, at most at `speed_max`.
Vector3 lacking(const Vector3& goal, const PressedSurfaces& surfaces, double scale, double speed_max,
                double dt_s) {
  constexpr double kCarry_s = 0.066;  // time constant
  const double share = -std::expm1(-dt_s / kCarry_s);
  Vector3 out = Vector3::Zero();
  for (const PressedSurface& s : surfaces) {
    const double room = s.inward.dot(goal - s.place) - s.least;
    const double by = std::min({share * scale * s.unpaid, room, speed_max * dt_s});
    if (by > 0.0) out -= by * s.inward;
  }
  return out;
}

}  // namespace

Vector3 rate_law(const Vector3& deflection, double dead_zone, double radius_max, RateLaw law) {
  const double r = norm(deflection);
  if (!(r > dead_zone)) return Vector3::Zero();
  const double capped = std::min(r, std::max(radius_max, dead_zone));
  const double effective = law == RateLaw::kContinuous ? capped - dead_zone : capped;
  return deflection * (effective / r);
}

void Mapping::configure(const MappingConfig& config) {
  if (config.base_rotation_rad != config_.base_rotation_rad) frozen_ = true;
  config_ = config;
  base_ = exp_rotation(config.base_rotation_rad);
}

void Mapping::reset(const HandleState& handle) {
  goal_ = Goal{};
  frozen_ = true;
  take_references(handle);
}

void Mapping::take_references(const HandleState& handle) {
  x_ref_ = handle.p_MH;
  q_ref_ = handle.q_MH;
  g_ref_ = goal_.position_m;
  q_gref_ = goal_.rotation;
  rate_m_ = {.kv_per_s = config_.kv_per_s};
  rate_rad_ = {.kv_per_s = config_.kv_rotation_per_s};
  if (mode_ == MotionMode::kRate && config_.rate_centre == RateCentre::kHandleOrigin) {
    x_ref_.setZero();
    q_ref_.setIdentity();
    rate_m_.home = norm(handle.p_MH) <= home_radius(config_.dead_zone_m, kHomeRadius_m);
    rate_rad_.home = norm(log_rotation(handle.q_MH)) <= home_radius(config_.dead_zone_rad, kHomeRadius_rad);
  }
  speed_m_per_s_.setZero();
  speed_rad_per_s_.setZero();
}

const Goal& Mapping::step(const MappingInput& input, double dt_s) {
  if (!input.handle.p_MH.allFinite() || !input.handle.q_MH.coeffs().allFinite()) return goal_;
  const bool rescaled = input.scale != scale_ && input.mode == MotionMode::kPosition;
  const bool changed = input.mode != mode_ || rescaled || input.frozen != frozen_;
  const bool eases = rescaled && input.scale < scale_ && !input.frozen;
  mode_ = input.mode;
  scale_ = input.scale;
  frozen_ = input.frozen;
  carried_m_ = 0.0;
  if (changed || frozen_) take_references(input.handle);
  if (eases) ease(input);
  const Vector3 before_m = goal_.position_m;
  const Quaternion before = goal_.rotation;
  if (!frozen_ && mode_ == MotionMode::kRate) step_rate(input, dt_s);
  if (!frozen_ && mode_ == MotionMode::kPosition) {
    carry(input, dt_s);
    step_position(input.handle, dt_s);
  }
  if (!input.translation_bound.direction.isZero(0.0)) draw_back(input.translation_bound, before_m, dt_s);
  if (!input.rotation_bound.direction.isZero(0.0)) turn_back(input.rotation_bound, before, dt_s);
  return goal_;
}

// The goal then moves to its new reference like to any other.
void Mapping::ease(const MappingInput& input) {
  g_ref_ = eased(g_ref_, input.surfaces, input.scale);
  const Vector3 turn = eased(goal_.rotation_rad, input.stops, input.scale);
  if (turn != goal_.rotation_rad) q_gref_ = exp_rotation(turn);
}

void Mapping::carry(const MappingInput& input, double dt_s) {
  if (!config_.goal_follows_force) return;
  const Vector3 out = lacking(goal_.position_m, input.surfaces, scale_, config_.speed_max_m_per_s, dt_s);
  carried_m_ = norm(out);
  g_ref_ += out;
  const Vector3 turn = lacking(goal_.rotation_rad, input.stops, scale_, config_.speed_max_rad_per_s, dt_s);
  if (!turn.isZero(0.0)) q_gref_ = (exp_rotation(turn) * q_gref_).normalized();
}

// The centre moves home with the hand, so that a released handle commands no motion.
void Mapping::centre_follows(const HandleState& handle) {
  x_ref_ = clamp_norm(x_ref_, norm(handle.p_MH));
  if (std::abs(handle.q_MH.w()) > std::abs(q_ref_.w()))
    q_ref_ = exp_rotation(clamp_norm(log_rotation(q_ref_), log_rotation(handle.q_MH).norm()));
}

Vector3 Mapping::translation_rate(const HandleState& handle, double dt_s) {
  const Vector3 deflection = handle.p_MH - x_ref_;
  if (!rate_m_.home) {
    rate_m_.home = norm(deflection) <= home_radius(config_.dead_zone_m, kHomeRadius_m);
    rate_m_.kv_per_s = 0.0;
  }
  if (!rate_m_.home) return Vector3::Zero();
  rate_m_.kv_per_s = ramped(rate_m_.kv_per_s, config_.kv_per_s, dt_s);
  return rate_of(deflection, config_.dead_zone_m, config_.radius_max_m, config_.rate_law, rate_m_.outside);
}

Vector3 Mapping::rotation_rate(const HandleState& handle, double dt_s) {
  const Vector3 deflection = log_rotation(handle.q_MH * q_ref_.conjugate());
  if (!rate_rad_.home) {
    rate_rad_.home = norm(deflection) <= home_radius(config_.dead_zone_rad, kHomeRadius_rad);
    rate_rad_.kv_per_s = 0.0;
  }
  if (!rate_rad_.home) return Vector3::Zero();
  // A rotation that counts again after a translation starts slowly.
  const bool counts = config_.simultaneous == SimultaneousMotion::kBoth || !rate_m_.outside;
  rate_rad_.kv_per_s = counts ? ramped(rate_rad_.kv_per_s, config_.kv_rotation_per_s, dt_s) : 0.0;
  return rate_of(deflection, config_.dead_zone_rad, config_.radius_max_rad, config_.rate_law,
                 rate_rad_.outside);
}

void Mapping::step_rate(const MappingInput& input, double dt_s) {
  const HandleState& handle = input.handle;
  if (config_.rate_centre == RateCentre::kWhereModeBegan) centre_follows(handle);
  const Vector3 rate_m = translation_rate(handle, dt_s), rate_rad = rotation_rate(handle, dt_s);
  const double speed_max = std::min(config_.speed_max_m_per_s, input.speed_max_m_per_s);
  const Vector3 speed_m = base_ * clamp_norm(rate_m_.kv_per_s * rate_m, speed_max);
  const Vector3 speed_rad = base_ * clamp_norm(rate_rad_.kv_per_s * rate_rad, config_.speed_max_rad_per_s);
  speed_m_per_s_ = press(speed_m, goal_.position_m, input.surfaces, speed_max);
  speed_rad_per_s_ = press(speed_rad, goal_.rotation_rad, input.stops, config_.speed_max_rad_per_s);
  advance(dt_s * speed_m_per_s_, dt_s * speed_rad_per_s_);
}

// The hand translates, as the goal of the last steps shows.
bool Mapping::translates() const {
  constexpr double kTranslates_m_per_s = 5e-3;  // of the hand; more than its tremor
  return norm(speed_m_per_s_) > scale_ * kTranslates_m_per_s;
}

void Mapping::step_position(const HandleState& handle, double dt_s) {
  if (config_.simultaneous == SimultaneousMotion::kTranslation && translates()) {
    q_ref_ = handle.q_MH;
    q_gref_ = goal_.rotation;
  }
  const Vector3 wanted = g_ref_ + scale_ * (base_ * (handle.p_MH - x_ref_));
  const Vector3 turn = scale_ * (base_ * log_rotation(handle.q_MH * q_ref_.conjugate()));
  const Vector3 left = log_rotation(exp_rotation(turn) * q_gref_ * goal_.rotation.conjugate());
  const Vector3 move_m = clamp_norm(wanted - goal_.position_m, config_.speed_max_m_per_s * dt_s);
  const Vector3 move_rad = clamp_norm(left, config_.speed_max_rad_per_s * dt_s);
  const double share = -std::expm1(-dt_s / kSmooth_s);
  speed_m_per_s_ += share * (move_m / dt_s - speed_m_per_s_);
  speed_rad_per_s_ += share * (move_rad / dt_s - speed_rad_per_s_);
  advance(move_m, move_rad);
}

void Mapping::advance(const Vector3& move_m, const Vector3& turn_rad) {
  if (!move_m.allFinite() || !turn_rad.allFinite()) {
    speed_m_per_s_.setZero();
    speed_rad_per_s_.setZero();
    return;
  }
  goal_.position_m += move_m;
  if (turn_rad.isZero(0.0)) return;
  goal_.rotation = (exp_rotation(turn_rad) * goal_.rotation).normalized();
  goal_.rotation_rad = log_rotation(goal_.rotation);
}

void Mapping::draw_back(const GoalBound& bound, const Vector3& before_m, double dt_s) {
  const Vector3& d = bound.direction;
  const double most = std::max(bound.lead, d.dot(before_m - bound.place) - config_.speed_max_m_per_s * dt_s);
  const double beyond = d.dot(goal_.position_m - bound.place) - most;
  if (!(beyond > 0.0)) return;
  goal_.position_m -= beyond * d;
  if (mode_ == MotionMode::kPosition) g_ref_ -= beyond * d;
  speed_m_per_s_ -= std::max(0.0, d.dot(speed_m_per_s_)) * d;
}

void Mapping::turn_back(const GoalBound& bound, const Quaternion& before, double dt_s) {
  const Vector3& d = bound.direction;
  const Quaternion place = exp_rotation(bound.place).conjugate();
  const double most =
      std::max(bound.lead, d.dot(log_rotation(before * place)) - config_.speed_max_rad_per_s * dt_s);
  const double beyond = d.dot(log_rotation(goal_.rotation * place)) - most;
  if (!(beyond > 0.0)) return;
  const Quaternion back = exp_rotation(-beyond * d);
  goal_.rotation = (back * goal_.rotation).normalized();
  goal_.rotation_rad = log_rotation(goal_.rotation);
  if (mode_ == MotionMode::kPosition) q_gref_ = (back * q_gref_).normalized();
  speed_rad_per_s_ -= std::max(0.0, d.dot(speed_rad_per_s_)) * d;
}

Pose Mapping::forecast(double ahead_s) const {
  return {goal_.position_m + ahead_s * speed_m_per_s_,
          exp_rotation(ahead_s * speed_rad_per_s_) * goal_.rotation};
}

Vector3 Mapping::deflection_m(const HandleState& handle) const {
  if (!rate_m_.home) return Vector3::Zero();
  return rate_law(handle.p_MH - x_ref_, config_.dead_zone_m, kUnlimited, RateLaw::kContinuous);
}

Vector3 Mapping::deflection_rad(const HandleState& handle) const {
  if (!rate_rad_.home) return Vector3::Zero();
  const Vector3 turned = log_rotation(handle.q_MH * q_ref_.conjugate());
  return rate_law(turned, config_.dead_zone_rad, kUnlimited, RateLaw::kContinuous);
}

double Mapping::handle_offset_m(const Vector3& n, double offset_m) const {
  return n.dot(base_ * x_ref_) + (offset_m - n.dot(g_ref_)) / scale_;
}

Vector3 Mapping::handle_rotation_at(const Quaternion& goal_rotation) const {
  const Vector3 turn = base_.conjugate() * log_rotation(goal_rotation * q_gref_.conjugate());
  return log_rotation(exp_rotation(clamp_norm(turn / scale_, kReach_rad)) * q_ref_);
}

}  // namespace longreach
