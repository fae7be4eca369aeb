#pragma once
// The contact at the hand along one inward direction: a unilateral spring f = k (s - a), s > a, that no
// sequence of updates can turn into a source of energy. s is the handle's position along the inward normal, a
// the anchor, w the registered surface; E = k (s - a)^2 / 2. The rules (DESIGN: rendering that cannot inject
// energy):
//
//   a higher k enters at once, with the anchor moved so that the force is continuous: a' = s - k (s - a)/k';
//   a lower k enters with the time constant `fade_s`, anchor fixed: force eases, energy falls;
//   without force the anchor returns to the surface for free: a = max(s, w);
//   in contact the anchor eases inwards for free, and outwards only as far as the purse pays for the energy:
//   a wall that was learnt late grows with kLoad_s, its force from nothing to the limit in kFullForce_s at
//   the fastest under a hand that presses on, and in kAtRest_s under one that rests or gives way, since what
//   it gives way by quickly is lost; a count of the encoders short of the surface this ends, and begins again
//   when hand or surface have moved by two, so that nothing ratchets;
//   above `force_max_n` the spring yields: the anchor gives way.
//
// Pure; every input may be anything, non-finite ones are refused by set_*. Lengths and forces may as well be
// angles and moments.

#include <algorithm>

#include "master/rendering/energy_tank.hpp"

namespace longreach {

struct ContactSpringConfig {
  double fade_s = 0.2;
  double stiffness_max_n_per_m = 7000.0;
  double force_max_n = 15.0;
  double count_m = 0.0;  // of the encoders
};

class ContactSpring {
 public:
  explicit ContactSpring(const ContactSpringConfig& config) : config_(config) {}
  void configure(const ContactSpringConfig& config) { config_ = config; }

  /// Begins at zero force: anchor at the surface, or at the handle if that is deeper.
  void begin(double s_m, double surface_m);

  /// Stiffness to reach, N/m; clamped to 0..stiffness_max. Returns false, changing nothing, if not finite.
  bool set_stiffness(double s_m, double stiffness_n_per_m);

  /// Registered surface, m. Returns false, changing nothing, if not finite.
  bool set_surface(double surface_m);

  /// Eases the spring at once to this depth, m, if it is deeper.
  void limit_depth(double s_m, double depth_m) { anchor_m_ = std::max(anchor_m_, s_m - depth_m); }

  /// Eases the spring at once to the depth of the last step, m, if it is deeper.
  void give_way(double s_m) { limit_depth(s_m, depth_m_); }

  /// One tick of `dt_s` > 0 at position `s_m`: unilateral, yield, fade, return of the anchor, paid by the
  /// purse. Returns the force >= 0, N, against the inward direction.
  double step(double s_m, double dt_s, EnergySource source);

  [[nodiscard]] double force_n(double s_m) const;
  [[nodiscard]] double energy_j(double s_m) const;         // stored in the spring
  [[nodiscard]] double paid_j() const { return paid_j_; }  // from purse to spring, in the last step
  [[nodiscard]] double stiffness_n_per_m() const { return target_ + fading_; }
  [[nodiscard]] double anchor_m() const { return anchor_m_; }
  [[nodiscard]] double surface_m() const { return surface_m_; }
  [[nodiscard]] bool clamped() const { return clamped_; }  // stiffness was cut to what the device can render
  [[nodiscard]] bool yielding() const { return yielding_; }  // at the force limit in the last step

 private:
  void return_anchor(double s_m, double dt_s, EnergySource& source);
  [[nodiscard]] bool settled(double s_m) const;

  ContactSpringConfig config_;
  double target_ = 0.0;  // stiffness that stays, N/m
  double fading_ = 0.0;  // stiffness that is on its way out, N/m
  double anchor_m_ = 0.0;
  double surface_m_ = 0.0;
  double paid_j_ = 0.0;
  double last_n_ = 0.0;    // force of the last step
  double depth_m_ = 0.0;   // of the last step
  double s_slow_m_ = 0.0;  // follows the handle with fade_s: which way it goes, apart from tremor
  bool clamped_ = false;
  bool yielding_ = false;
  // Where hand and surface were when the anchor had come home.
  bool home_ = false;
  double home_s_m_ = 0.0, home_surface_m_ = 0.0;
};

}  // namespace longreach
