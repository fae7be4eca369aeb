#include "slave/command/contact_guard.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace longreach {
namespace {

constexpr double kBleed_s = 0.2;     // τ, many times the lag of a servo and the delay of a loop
constexpr double kHoldAim = 0.95;    // of the hold limit, so that the force is below the limit within five τ
constexpr double kSofter = 0.1;      // of a known stiffness: minimum stiffness that the force may show
constexpr double kPushedIn = 1.35;   // of the guard: a force that the guard alone never permits
constexpr double kPushedIn_s = 1.0;  // and that would decrease sooner if the stiffness were as identified
constexpr double kUnseen = 0.02;     // of a force: decrease that may not be measurable yet
constexpr double kBraking = 0.8;     // of the acceleration, for stopping when the retreat distance is used up
constexpr double kQuiet_s = 0.05;    // time below the guard after which the force counts as gone
constexpr double kComing_m = 1e-5;   // smallest lead that counts
constexpr double kAlong = 0.3;       // cosine of a direction that is not perpendicular

}  // namespace

void ContactGuard::approach(const ContactForce& contact, const Vector3& p, double dt) {
  const double bound_n = (pushed_in_s_ < kPushedIn_s ? kPushedIn : 1.0) * limits_.guard_n;
  pushed_in_s_ = contact.in_contact && contact.force_n > bound_n ? pushed_in_s_ + dt : 0.0;
  if (pushed_in_s_ < kPushedIn_s) bleed_.reset();
  const double from_n = pushed_in_s_ < kPushedIn_s ? std::numeric_limits<double>::infinity() : 0.0;
  watch_bleed(contact, {from_n, limits_.guard_n, scale_.soft_n_per_m}, p);
  const bool stable = !contact.in_contact || (contact.force_n <= limits_.guard_n && !contact.gave_way);
  stable_s_ = stable ? stable_s_ + dt : 0.0;
  if (stable_s_ > kQuiet_s) retreat_budget_.reset();
}

VelocityCap ContactGuard::cap(const ContactForce& contact) const {
  VelocityCap cap;
  if (!contact.in_contact) return cap;
  cap.active = true;
  cap.braking = limits_.braking_m_per_s2;
  cap.direction = -contact.reaction;
  // Distances for the stiffest surface: the remaining one or, beyond the guard, the part of the lead that is
  // too much.
  const double k = limits_.stiffness_n_per_m, coming_m = std::max(contact.lead_m, 0.0);
  const double left_m = (limits_.guard_n - contact.force_n) / k - coming_m;
  // The setpoint reverses hard only as long as the tool would otherwise follow it farther into the surface.
  cap.reverses = coming_m > kComing_m;
  double speed = braking(left_m, coming_m);
  if (left_m > 0.0) speed = std::min(speed, stopping_load(contact, left_m));
  cap.speed = (left_m > 0.0 ? speed : -speed) - bleed_off(contact, limits_.guard_n);
  if (contact.gives_way) cap.speed = std::min(cap.speed, -contact.retreat_m_per_s);
  cap.speed = std::max(cap.speed, -give_way_max(contact));
  return cap;
}

double ContactGuard::braking(double left_m, double coming_m) const {
  return std::sqrt(2.0 * limits_.acceleration_m_per_s2 *
                   std::min(std::abs(left_m), left_m > 0.0 ? left_m : coming_m));
}

// Speed at which the load, decelerated by the stiffest surface, stops within the remaining distance.
double ContactGuard::stopping_load(const ContactForce& contact, double left_m) const {
  if (!(contact.load_kg > 0.0)) return std::numeric_limits<double>::infinity();
  return left_m * std::sqrt(limits_.stiffness_n_per_m / contact.load_kg);
}

// Limits the speed regardless of the direction that the sensor reports.
VelocityCap ContactGuard::growth(const ContactForce& contact) const {
  VelocityCap cap;
  const bool grows = !contact.grows.isZero(0.0), elsewhere = !contact.elsewhere.isZero(0.0);
  if (!contact.in_contact || !(grows || elsewhere)) return cap;
  cap.active = true;
  cap.braking = limits_.braking_m_per_s2;
  cap.direction = grows ? contact.grows : -contact.elsewhere;
  const double lead_m = grows ? contact.grows_lead_m : contact.elsewhere_lead_m;
  const double force_n = grows ? contact.force_n : contact.elsewhere_n;
  const double left_m = (limits_.guard_n - force_n) / limits_.stiffness_n_per_m - std::max(lead_m, 0.0);
  cap.speed = left_m > 0.0 ? std::min(braking(left_m, 0.0), stopping_load(contact, left_m)) : 0.0;
  return cap;
}

bool ContactGuard::advanced(const ContactForce& contact, const Vector3& v, bool capped, double dt) {
  if (!contact.in_contact || !(contact.force_n > limits_.guard_n || contact.gave_way)) return false;
  const bool in = v.dot(contact.reaction) < 0.0;
  if (capped || in) give_way(contact, v, dt);
  if (!(contact.force_n > limits_.guard_n || contact.gives_way)) return false;
  // A retreat by the operator is not stopped.
  return !retreat_budget_.may_go_on() && (capped || !(v.dot(contact.reaction) > 0.0));
}

Vector3 ContactGuard::back_off(const ContactForce& contact, const Vector3& p) {
  const double wanted = std::max(hold_off(contact, p), contact.retreat_m_per_s);
  backs_off_ = wanted > 0.0;
  return std::max(std::min(wanted, give_way_max(contact)), contact.ease_m_per_s) * contact.reaction;
}

bool ContactGuard::backed_off(const ContactForce& contact, const Vector3& v, double dt) {
  if (backs_off_) back_ = contact.reaction;
  if (!backs_off_ && !(v.dot(back_) > 0.0)) back_.setZero();
  if (back_.isZero(0.0)) return false;
  // The motion while the tool brakes also counts.
  retreat_budget_.go(v.dot(back_) * dt, contact.force_n, dt, contact.trend_n_per_s);
  return backs_off_ && !retreat_budget_.may_go_on();
}

void ContactGuard::give_way(const ContactForce& contact, const Vector3& v, double dt) {
  retreat_budget_.go(v.dot(contact.reaction) * dt, contact.force_n, dt, contact.trend_n_per_s);
}

// Speed from which the tool can stop within the remaining retreat distance.
double ContactGuard::give_way_max(const ContactForce& contact) const {
  if (!contact.trusted || contact.grows.dot(contact.reaction) > kAlong) return 0.0;
  const double left_m = retreat_budget_.may_go_on() ? retreat_budget_.left_m() : 0.0;
  return std::sqrt(kBraking * 2.0 * limits_.acceleration_m_per_s2 * left_m);
}

// Returns the speed out of the contact that reduces a force above the limit; 0 if the force is below it.
double ContactGuard::bleed_off(const ContactForce& contact, double limit_n) const {
  if (!(contact.force_n > limit_n)) return 0.0;
  return std::min((contact.force_n - limit_n) / (seen_n_per_m_ * kBleed_s), limits_.speed_m_per_s);
}

// The same in a hold.
double ContactGuard::hold_off(const ContactForce& contact, const Vector3& p) {
  const double aim_n = kHoldAim * limits_.hold_n;
  const double k = contact.stiffness_n_per_m;
  watch_bleed(contact, {limits_.hold_n, aim_n, k > 0.0 ? kSofter * k : scale_.soft_n_per_m}, p);
  return bleed_ ? bleed_off(contact, aim_n) : 0.0;
}

// Estimates the stiffness from the decrease of the force during a retreat. The identified stiffness is
// unknown at a first touch, far too great if the tool was pushed into the surface, and greater than the
// effective one if the robot yields, too.
void ContactGuard::watch_bleed(const ContactForce& contact, const Down& down, const Vector3& p) {
  const bool known = contact.stiffness_n_per_m > 0.0;
  const double k = known ? contact.stiffness_n_per_m : limits_.stiffness_n_per_m;
  seen_n_per_m_ = k;
  if (!contact.in_contact || contact.force_n <= down.to_n || (bleed_ && bleed_->to_n != down.to_n))
    bleed_.reset();
  if (!contact.in_contact) return;
  const Vector3 tool = p + contact.lead_m * contact.reaction;
  if (!bleed_ && contact.force_n > down.from_n) bleed_ = Bleed{contact.force_n, down.to_n, tool};
  if (!bleed_) return;
  const double out_m = contact.reaction.dot(tool - bleed_->from);
  if (out_m < 0.0) *bleed_ = {contact.force_n, down.to_n, tool};
  const double unseen_n = std::max(scale_.seen_n, kUnseen * bleed_->from_n);
  const double fell_n = bleed_->from_n - contact.force_n + unseen_n;
  seen_n_per_m_ = std::clamp(fell_n / std::max(out_m, 1e-9), std::min(down.least_n_per_m, k), k);
}

}  // namespace longreach
