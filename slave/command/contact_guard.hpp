#pragma once
// The guard of a contact, of its force or of its moment:
//   in contact, the speed into the contact is at most √(2 a r), r = (G - F)/k_max - l, l what the setpoint is
//   ahead of the tool by the servo's lag; where r < 0 the setpoint turns back, at up to √(2 a min(-r, l)),
//   the tool only the less far; outwards it is free; from F = G on the setpoint backs out, at (F - G)/(k τ),
//   k the contact's stiffness as far as known, else k_max, or after a second far above G what the force
//   shows: it falls to G with the time constant τ, and the contact is not lost. Without a goal, so in a hold,
//   it does so down to the hold limit, within 1 s as far as speed and acceleration allow; k is then what is
//   seen. Giving way ends where the force does not answer to it (retreat_budget.hpp). Where the force was seen to
//   grow in another direction than into the contact, the speed in that direction is bounded likewise, and the
//   tool does not give way along it; else the speed against a force that is far off the contact's direction.
// For a moment places are rotation vectors, N are N m, m are rad. With speed w on stiffness k <= k_max, τ_d
// from the moment to the setpoint, what comes above the guard is at most k w τ_d; where k > k_max,
//   k (w τ_d + w²/(2 a)).

#include <optional>

#include "slave/command/retreat_budget.hpp"
#include "slave/command/vector_limit.hpp"

namespace longreach {

/// What the guard knows about the contact.
struct ContactForce {
  bool in_contact = false;
  Vector3 reaction = Vector3::Zero();   // unit, direction of the force on the tool
  double force_n = 0.0;                 // measured along it
  double stiffness_n_per_m = 0.0;       // as identified; 0: unknown
  double lead_m = 0.0;                  // of the setpoint into the contact, still to come by the servo's lag
  Vector3 grows = Vector3::Zero();      // unit, in which the force grows though it should not; zero: none
  double grows_lead_m = 0.0;            // of the setpoint in that direction
  Vector3 elsewhere = Vector3::Zero();  // unit, of the whole force where that is far off `reaction`, and
  double elsewhere_n = 0.0;
  double elsewhere_lead_m = 0.0;  // the setpoint's lead against it
  bool trusted = true;            // false: the tool gives way to nothing
  double ease_m_per_s = 0.0;      // but without a goal so fast, to see whether the force answers
  bool gives_way = false;         // to what grows at rest (force_answer.hpp), at this speed:
  double retreat_m_per_s = 0.0;
  bool gave_way = false;       // ever in this contact: the way that is given counts till it ends
  double trend_n_per_s = 0.0;  // that it grows by at rest
};

struct GuardLimits {
  double guard_n = 20.0;           // G
  double hold_n = 10.0;            // hold limit
  double stiffness_n_per_m = 2e4;  // k_max
  double speed_m_per_s = 0.25;
  double acceleration_m_per_s2 = 1.25;  // a
  double give_way_m = 1e9;              // longest way that is given
};

/// What differs between force and moment.
struct GuardScale {
  double seen_n = 0.5;          // that sensor noise does not make
  double soft_n_per_m = 100.0;  // that a contact of unknown stiffness may have
  RetreatBounds retreat_budget{};
};
inline constexpr GuardScale kForceScale{};
inline constexpr GuardScale kMomentScale{0.05, 1.0, {0.1, 1.0, 0.05, 5e-4}};

class ContactGuard {
 public:
  explicit ContactGuard(const GuardScale& scale) : scale_(scale), retreat_budget_(scale.retreat_budget) {}

  /// Holds in the calls that follow.
  void limit(const GuardLimits& limits) {
    limits_ = limits;
    retreat_budget_.limit(limits.give_way_m);
  }
  /// An engagement begins: the way that may be given, too.
  void renew() {
    retreat_budget_.reset();
    bleed_.reset();
  }

  /// Towards a goal, first of all in a step, with the setpoint at `p`.
  void approach(const ContactForce& contact, const Vector3& p, double dt);
  [[nodiscard]] VelocityCap cap(const ContactForce& contact) const;
  [[nodiscard]] VelocityCap growth(const ContactForce& contact) const;
  /// Then, with the setpoint's velocity, `capped` by cap(). True: the tool would give way, but the force has
  /// not answered.
  bool advanced(const ContactForce& contact, const Vector3& v, bool capped, double dt);

  /// Without a goal: the velocity that the setpoint, now at `p`, shall have.
  Vector3 back_off(const ContactForce& contact, const Vector3& p);
  /// Then, with the one it has. True: likewise.
  bool backed_off(const ContactForce& contact, const Vector3& v, double dt);

 private:
  /// A force is brought down: from, to.
  struct Down {
    double from_n, to_n;
    double least_n_per_m;  // that the contact may seem to have
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
  double seen_n_per_m_ = 0.0;       // while the tool goes back
  bool backs_off_ = false;          // in a hold, in this step
  Vector3 back_ = Vector3::Zero();  // unit: the way on which it backs off, or brakes after that
  double stable_s_ = 0.0;           // below the guard
};

}  // namespace longreach
