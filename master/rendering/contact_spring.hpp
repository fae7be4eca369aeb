#pragma once
// The displayed contact along one inward direction: a unilateral spring f = k (s - a), s > a, that no
// sequence of updates can turn into a source of energy. s is the position of the handle along the inward
// normal, a the anchor, w the registered surface; E = k (s - a)^2 / 2. The rules:
//
//   a higher k enters at once, with the anchor moved so that the force is continuous: a' = s - k (s - a)/k';
//   a lower k enters with the time constant `fade_s`, anchor fixed: force and energy decrease;
//   without force the anchor returns to the surface at no cost: a = max(s, w);
//   in contact the anchor moves inwards at no cost, and outwards only as far as the energy source permits:
//   the force of a wall that is identified late grows with the time constant kLoad_s, from zero to the limit
//   in kFullForce_s at the fastest while the hand presses, and in kAtRest_s while it rests or retreats, since
//   energy spent during a fast retreat is lost; this ends one encoder count before the surface, and restarts
//   when hand or surface have moved by two counts, so that it does not ratchet;
//   above `force_max_n` the spring yields: the anchor moves with the handle.
//
// Pure; any input is accepted, non-finite values are refused by set_*. Lengths and forces may also be angles
// and moments.

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

  /// Starts at zero force: anchor at the surface, or at the handle if that is deeper.
  void begin(double s_m, double surface_m);

  /// Target stiffness, N/m; clamped to 0..stiffness_max. Returns false and changes nothing if it is not
  /// finite.
  bool set_stiffness(double s_m, double stiffness_n_per_m);

  /// Registered surface, m. Returns false and changes nothing if it is not finite.
  bool set_surface(double surface_m);

  /// Limits the spring immediately to this depth, m.
  void limit_depth(double s_m, double depth_m) { anchor_m_ = std::max(anchor_m_, s_m - depth_m); }

  /// Limits the spring immediately to the depth of the last step, m.
  void give_way(double s_m) { limit_depth(s_m, depth_m_); }

  /// One tick of `dt_s` > 0 at position `s_m`: unilateral contact, yielding, fading, and return of the anchor
  /// with energy from `source`. Returns the force >= 0, N, against the inward direction.
  double step(double s_m, double dt_s, EnergySource source);

  [[nodiscard]] double force_n(double s_m) const;
  [[nodiscard]] double energy_j(double s_m) const;         // stored in the spring
  [[nodiscard]] double paid_j() const { return paid_j_; }  // energy from source to spring, in the last step
  [[nodiscard]] double stiffness_n_per_m() const { return target_ + fading_; }
  [[nodiscard]] double anchor_m() const { return anchor_m_; }
  [[nodiscard]] double surface_m() const { return surface_m_; }
  /// the stiffness was limited to the maximum of the device
  [[nodiscard]] bool clamped() const { return clamped_; }
  [[nodiscard]] bool yielding() const { return yielding_; }  // at the force limit in the last step

 private:
  void return_anchor(double s_m, double dt_s, EnergySource& source);
  [[nodiscard]] bool settled(double s_m) const;

  ContactSpringConfig config_;
  double target_ = 0.0;  // remaining stiffness, N/m
  double fading_ = 0.0;  // stiffness that is fading out, N/m
  double anchor_m_ = 0.0;
  double surface_m_ = 0.0;
  double paid_j_ = 0.0;
  double last_n_ = 0.0;    // force of the last step
  double depth_m_ = 0.0;   // of the last step
  double s_slow_m_ = 0.0;  // follows the handle with fade_s: its direction of motion without tremor
  bool clamped_ = false;
  bool yielding_ = false;
  // Position of hand and surface when the anchor had returned.
  bool home_ = false;
  double home_s_m_ = 0.0, home_surface_m_ = 0.0;
};

}  // namespace longreach
