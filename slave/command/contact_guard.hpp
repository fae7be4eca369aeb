#pragma once
// The guard of the force or moment of a contact:
//   in contact, the speed into the contact is at most √(2 a r), r = (G - F)/k_max - l, where l is the lead of
//   the setpoint over the tool by the lag of the servo; for r < 0 the setpoint turns back, at up to
//   √(2 a min(-r, l)), while the tool only advances less; outward motion is free. From F = G on the setpoint
//   retreats at (F - G)/(k τ), where k is the known stiffness of the contact, else k_max, or after a second
//   far above G the stiffness that the force shows: the force falls to G with the time constant τ, and the
//   contact is kept. Without a goal, as in a hold, it retreats down to the hold limit, within 1 s as far as
//   speed and acceleration permit; k is then the observed stiffness. The retreat ends where the force does not
//   respond to it (retreat_budget.hpp). If the force was observed to grow in a direction other than into the
//   contact, the speed in that direction is bounded in the same way, and the tool does not retreat along it;
//   otherwise the speed against a force far from the direction of the contact is bounded.
// For a moment, positions are rotation vectors, N are N m, m are rad. With speed w on stiffness k <= k_max,
// and the time τ_d from the moment to the setpoint, the guard is exceeded by at most k w τ_d; for k > k_max,
//   k (w τ_d + w²/(2 a)).

#include <optional>

#include "slave/command/retreat_budget.hpp"
#include "slave/command/vector_limit.hpp"

namespace longreach {

/// Information of the guard about the contact.
struct ContactForce {
  bool in_contact = false;
  Vector3 reaction = Vector3::Zero();  // unit, direction of the force on the tool
  double force_n = 0.0;                // measured along it
  double stiffness_n_per_m = 0.0;      // as identified; 0: unknown
  double lead_m = 0.0;  // lead of the setpoint into the contact, which the lag of the servo has yet to add
  Vector3 grows = Vector3::Zero();  // unit, direction in which the force grows unexpectedly; zero: none
  double grows_lead_m = 0.0;        // lead of the setpoint in that direction
  /// unit, direction of the whole force if it is far from `reaction`, and
  Vector3 elsewhere = Vector3::Zero();
  double elsewhere_n = 0.0;
  double elsewhere_lead_m = 0.0;  // lead of the setpoint against it
  bool trusted = true;            // false: the tool does not retreat
  double ease_m_per_s = 0.0;      // speed of a retreat without a goal, to test the response of the force
  bool gives_way = false;  // retreat from a force that grows at rest (force_answer.hpp), at this speed:
  double retreat_m_per_s = 0.0;
  bool gave_way = false;  // at any time in this contact: the retreat distance counts until the contact ends
  double trend_n_per_s = 0.0;  // rate of growth at rest
};

struct GuardLimits {
  double guard_n = 20.0;           // G
  double hold_n = 10.0;            // hold limit
  double stiffness_n_per_m = 2e4;  // k_max
  double speed_m_per_s = 0.25;
  double acceleration_m_per_s2 = 1.25;  // a
  double give_way_m = 1e9;              // maximum retreat distance
};

/// Parameters that differ between force and moment.
struct GuardScale {
  double seen_n = 0.5;          // above the sensor noise
  double soft_n_per_m = 100.0;  // minimum assumed for a contact of unknown stiffness
  RetreatBounds retreat_budget{};
};
inline constexpr GuardScale kForceScale{};
inline constexpr GuardScale kMomentScale{0.05, 1.0, {0.1, 1.0, 0.05, 5e-4}};

class ContactGuard {
 public:
  explicit ContactGuard(const GuardScale& scale) : scale_(scale), retreat_budget_(scale.retreat_budget) {}

  /// Limits for the following calls.
  void limit(const GuardLimits& limits) {
    limits_ = limits;
    retreat_budget_.limit(limits.give_way_m);
  }
  /// Starts an engagement, which restores the retreat distance.
  void renew() {
    retreat_budget_.reset();
    bleed_.reset();
  }

  /// Towards a goal; first call of a step, with the setpoint at `p`.
  void approach(const ContactForce& contact, const Vector3& p, double dt);
  [[nodiscard]] VelocityCap cap(const ContactForce& contact) const;
  [[nodiscard]] VelocityCap growth(const ContactForce& contact) const;
  /// Second call, with the velocity of the setpoint, `capped` by cap(). Returns true if the tool would
  /// retreat, but the force has not responded.
  bool advanced(const ContactForce& contact, const Vector3& v, bool capped, double dt);

  /// Without a goal: returns the target velocity of the setpoint, now at `p`.
  Vector3 back_off(const ContactForce& contact, const Vector3& p);
  /// Second call, with the actual velocity. Returns the same.
  bool backed_off(const ContactForce& contact, const Vector3& v, double dt);

 private:
  /// A reduction of the force: from, to.
  struct Down {
    double from_n, to_n;
    double least_n_per_m;  // minimum stiffness that the contact may seem to have
  };
  struct Bleed {
    double from_n, to_n;
    Vector3 from;  // tool
  };
  [[nodiscard]] double bleed_off(const ContactForce& contact, double limit_n) const;
  [[nodiscard]] double hold_off(const ContactForce& contact, const Vector3& p);
  void watch_bleed(const ContactForce& contact, const Down& down, const Vector3& p);
  [[nodiscard]] double give_way_max(const ContactForce& contact) const;
  [[nodiscard]] double braking(double left_m, double coming_m) const;
  void give_way(const ContactForce& contact, const Vector3& v, double dt);

  GuardScale scale_;
  GuardLimits limits_{};
  RetreatBudget retreat_budget_;
  std::optional<Bleed> bleed_{};
  double pushed_in_s_ = 0.0;
  double seen_n_per_m_ = 0.0;       // while the tool retreats
  bool backs_off_ = false;          // in a hold, in this step
  Vector3 back_ = Vector3::Zero();  // unit: direction of the retreat, or of braking after it
  double stable_s_ = 0.0;           // below the guard
};

}  // namespace longreach
