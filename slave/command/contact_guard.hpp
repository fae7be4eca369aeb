#pragma once
// Limits the force or the moment of a contact: the tool advances only while the contact force F is below the
// guard limit G, and it retreats while F exceeds G.
//
// With a goal, the speed into the contact is at most √(2 a r) with r = (G - F)/k_max - l, where l is the
// distance by which the setpoint leads the tool because of the servo lag. For r < 0 the setpoint moves back
// at up to √(2 a min(-r, l)); this shortens the advance of the tool but does not move it back. Motion out of
// the contact is not limited.
//
// The setpoint brakes into that speed, and reverses, at up to `braking_m_per_s2`.
//
// For F > G the setpoint retreats at (F - G)/(k τ), so the force decreases to G with the time constant τ, and
// the contact is kept. Here k is the identified stiffness of the contact, or k_max if none is identified.
// After the force has been far above G for a second, k is estimated from the decrease of the force during the
// retreat, down to GuardScale::soft_n_per_m.
//
// Without a goal, for example in a hold, the setpoint retreats until F has reached the hold limit. This takes
// at most 1 s if the speed and acceleration limits permit; k is again estimated from the decrease of the
// force. Every retreat ends if the force does not respond to it (retreat_budget.hpp).
//
// A load of the mass m in the gripper continues to move when the tool stops. The speed into the contact is then also
// at most r √(k_max/m), at which the kinetic energy of the load is that of the stiffest surface over r. With a
// larger speed, the load would oscillate between the guard and the surface.
//
// If the force grew while the tool moved in a direction other than into the contact, the speed in that direction
// is limited in the same way, and the tool does not retreat in that direction. Otherwise, if the direction of
// the force differs greatly from that of the contact, the speed of motion against the force is limited.
//
// For a moment, positions are rotation vectors, and N and m stand for N m and rad. At the speed w into a
// stiffness k up to k_max, F exceeds G by at most k w τ_d, where τ_d is the delay from the force to the
// setpoint; for a stiffer contact by at most k (w τ_d + w²/(2 a)).

#include <optional>

#include "slave/command/retreat_budget.hpp"
#include "slave/command/vector_limit.hpp"

namespace longreach {

/// What the guard needs to know about the contact.
struct ContactForce {
  bool in_contact = false;
  Vector3 reaction = Vector3::Zero();  // unit vector in the direction of the force on the tool
  double force_n = 0.0;                // component of the force along `reaction`
  double stiffness_n_per_m = 0.0;      // identified stiffness; 0: unknown
  /// Distance that the tool will still move into the contact because the servo lags the setpoint.
  double lead_m = 0.0;
  /// Direction (unit vector) of the motion that makes the force grow unexpectedly; zero if there is none.
  Vector3 grows = Vector3::Zero();
  double grows_lead_m = 0.0;  // lead of the setpoint in the direction `grows`
  /// Direction (unit vector) and magnitude of the total force if its direction is far from `reaction`;
  /// otherwise zero.
  Vector3 elsewhere = Vector3::Zero();
  double elsewhere_n = 0.0;
  double elsewhere_lead_m = 0.0;  // lead of the setpoint against the force `elsewhere`
  bool trusted = true;            // false: the force is in doubt, and the tool does not retreat
  /// Speed of the retreat that tests, while there is no goal, whether the force responds.
  double ease_m_per_s = 0.0;
  /// The tool retreats, at `retreat_m_per_s`, from a force that grows while the robot is at rest (force_answer.hpp).
  bool gives_way = false;
  double retreat_m_per_s = 0.0;
  /// `gives_way` was true in this contact, so the retreat distance counts until the contact ends.
  bool gave_way = false;
  double trend_n_per_s = 0.0;  // growth rate of the force while the robot is at rest
  double load_kg = 0.0;        // upper bound on the mass of the load; 0: none is known
};

struct GuardLimits {
  double guard_n = 20.0;           // G
  double hold_n = 10.0;            // force limit in a hold
  double stiffness_n_per_m = 2e4;  // k_max
  double speed_m_per_s = 0.25;
  double acceleration_m_per_s2 = 1.25;  // a
  double give_way_m = 1e9;              // maximum retreat distance
  double braking_m_per_s2 = 0.0;        // deceleration against the contact, if greater than a
};

/// Parameters whose values differ between a force and a moment.
struct GuardScale {
  double seen_n = 0.5;  // decrease of the force that noise may hide
  /// Lower bound on a stiffness estimated from a retreat; in a hold, only if no stiffness is identified.
  double soft_n_per_m = 100.0;
  RetreatBounds retreat_budget{};
};
inline constexpr GuardScale kForceScale{};
inline constexpr GuardScale kMomentScale{0.05, 1.0, {0.1, 1.0, 0.05, 5e-4}};

class ContactGuard {
 public:
  explicit ContactGuard(const GuardScale& scale) : scale_(scale), retreat_budget_(scale.retreat_budget) {}

  /// Sets the limits for subsequent calls.
  void limit(const GuardLimits& limits) {
    limits_ = limits;
    retreat_budget_.limit(limits.give_way_m);
  }
  /// Starts an engagement, which resets the retreat distance and the observed stiffness.
  void renew() {
    retreat_budget_.reset();
    bleed_.reset();
  }

  /// First call in a step with a goal; `p` is the position of the setpoint.
  void approach(const ContactForce& contact, const Vector3& p, double dt);
  /// Speed limit along the direction of the contact; negative if the setpoint must retreat.
  [[nodiscard]] VelocityCap cap(const ContactForce& contact) const;
  /// Speed limit along the motion that makes the force grow unexpectedly, or against the `elsewhere` force.
  [[nodiscard]] VelocityCap growth(const ContactForce& contact) const;
  /// Second call in a step with a goal. `v` is the velocity of the setpoint; `capped` is true if cap() limited
  /// it. Returns true if the retreat distance is used up and the force has not responded to the retreat.
  bool advanced(const ContactForce& contact, const Vector3& v, bool capped, double dt);

  /// First call in a step without a goal; `p` is the position of the setpoint. Returns the target velocity.
  Vector3 back_off(const ContactForce& contact, const Vector3& p);
  /// Second call in a step without a goal; `v` is the actual velocity. The result is like that of advanced().
  bool backed_off(const ContactForce& contact, const Vector3& v, double dt);

 private:
  /// Reduction of the force: it begins above `from_n` and ends at `to_n`.
  struct Down {
    double from_n, to_n;
    double least_n_per_m;  // lower bound on the observed stiffness
  };
  struct Bleed {
    double from_n, to_n;
    Vector3 from;  // position of the tool when the reduction began
  };
  [[nodiscard]] double bleed_off(const ContactForce& contact, double limit_n) const;
  [[nodiscard]] double hold_off(const ContactForce& contact, const Vector3& p);
  void watch_bleed(const ContactForce& contact, const Down& down, const Vector3& p);
  [[nodiscard]] double give_way_max(const ContactForce& contact) const;
  [[nodiscard]] double braking(double left_m, double coming_m) const;
  [[nodiscard]] double stopping_load(const ContactForce& contact, double left_m) const;
  void give_way(const ContactForce& contact, const Vector3& v, double dt);

  GuardScale scale_;
  GuardLimits limits_{};
  RetreatBudget retreat_budget_;
  std::optional<Bleed> bleed_{};
  double pushed_in_s_ = 0.0;
  double seen_n_per_m_ = 0.0;  // stiffness used for the speed of the retreat
  bool backs_off_ = false;     // the tool retreats without a goal in this step
  /// Unit vector in the direction of the retreat and of the braking after it; zero if there is neither.
  Vector3 back_ = Vector3::Zero();
  double stable_s_ = 0.0;  // how long the force has been below the guard limit, s
};

}  // namespace longreach
