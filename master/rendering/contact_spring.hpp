#pragma once
// The displayed contact along one inward direction: a unilateral spring f = k (s - a), s > a. No sequence of
// updates can turn the spring into a source of energy. s is the position of the handle along the inward
// normal, a the anchor, w the registered surface; E = k (s - a)^2 / 2. The rules are:
//
//   increase of k      Applied immediately; the anchor moves so that the force is continuous:
//                      a' = s - k (s - a)/k'.
//   decrease of k      Applied with the time constant `fade_s` and a fixed anchor: force and energy decrease.
//   zero force         The anchor returns to the surface at no energy cost: a = max(s, w).
//   in contact         The anchor moves inwards at no cost, and outwards only as far as the energy source permits.
//   force limit        Above `force_max_n` the spring yields: the anchor moves with the handle.
//   depth limit        The force falls by a ramp. Meanwhile the hand cannot load the spring.
//
// If a wall is identified late, the outward rule makes its force grow with the time constant kLoad_s. The
// growth from zero to the limit takes at least kFullForce_s while the hand presses inwards, and at least
// kAtRest_s while it rests or retreats, because energy spent during a fast retreat is lost. The anchor stops
// one encoder count before the surface and moves again only when the hand or the surface has moved by two
// counts, so that it does not ratchet.
//
// Pure. Any input is accepted; the set_* functions reject non-finite values. Lengths and forces may also be
// angles and moments.

#include <algorithm>
#include <limits>

#include "master/rendering/energy_tank.hpp"

namespace longreach {

struct ContactSpringConfig {
  double fade_s = 0.2;
  double stiffness_max_n_per_m = 7000.0;
  double force_max_n = 15.0;
  double count_m = 0.0;  // position change of one encoder count
};

class ContactSpring {
 public:
  explicit ContactSpring(const ContactSpringConfig& config) : config_(config) {}
  void configure(const ContactSpringConfig& config) { config_ = config; }

  /// Starts with zero force: the anchor is at the surface, or at the handle if the handle is deeper.
  void begin(double s_m, double surface_m);

  /// Sets the target stiffness, N/m, clamped to 0..stiffness_max. Returns false and changes nothing if the
  /// value is not finite.
  bool set_stiffness(double s_m, double stiffness_n_per_m);

  /// Sets the registered surface, m. Returns false and changes nothing if the value is not finite.
  bool set_surface(double surface_m);

  /// Limits the depth of the spring, m, from the next step on. Its force falls to that of this depth by a ramp.
  void limit_depth(double depth_m) { depth_max_m_ = depth_m; }

  /// Limits the depth of the spring to that of the last step.
  void give_way(double s_m) { anchor_m_ = std::max(anchor_m_, s_m - depth_m_); }

  /// Continues as a fading spring with this share (0 to 1) of the present force.
  void let_go(double share) { fading_ = share * stiffness_n_per_m(), target_ = 0.0; }

  /// Advances by `dt_s` > 0 at position `s_m`: fades the stiffness, yields at the force limit, and returns
  /// the anchor with energy from `source`. Returns the force against the inward direction, N, >= 0. `damper_n` is the force
  /// of the damper that was added to that of the last step, N; where it is limited to the force of the spring, it falls
  /// with it, so the ramp of the depth limit is that of the sum.
  double step(double s_m, double dt_s, EnergySource source, double damper_n = 0.0);

  [[nodiscard]] double force_n(double s_m) const;
  [[nodiscard]] double energy_j(double s_m) const;         // energy stored in the spring
  [[nodiscard]] double paid_j() const { return paid_j_; }  // energy that the source supplied in the last step
  [[nodiscard]] double stiffness_n_per_m() const { return target_ + fading_; }
  [[nodiscard]] double anchor_m() const { return anchor_m_; }
  [[nodiscard]] double surface_m() const { return surface_m_; }
  /// Returns whether the last stiffness was limited to stiffness_max_n_per_m.
  [[nodiscard]] bool clamped() const { return clamped_; }
  [[nodiscard]] bool yielding() const { return yielding_; }  // at the force limit in the last step
  /// Returns by how much the depth limit has reduced the force in the last step, N.
  [[nodiscard]] double shortened_n() const { return shortened_n_; }
  /// Returns the depth of the handle behind the surface that the spring lacks because the energy for it is used up, m;
  /// 0 while the spring is still being loaded, and while little is lacking.
  [[nodiscard]] double unpaid_m() const { return unpaid_ ? std::max(0.0, anchor_m_ - surface_m_) : 0.0; }

 private:
  /// Applies the depth limit. Apart from what the hand retreats, the force falls by no more than the force limit in
  /// kVanish_s.
  void shorten(double s_m, double dt_s, double damper_n);
  /// Returns the anchor. Returns whether the energy that the next part of the way costs is lacking.
  bool return_anchor(double s_m, double dt_s, EnergySource& source);
  [[nodiscard]] bool settled(double s_m) const;

  ContactSpringConfig config_;
  double target_ = 0.0;  // target stiffness, N/m
  double fading_ = 0.0;  // stiffness that is fading out, N/m
  double anchor_m_ = 0.0;
  double surface_m_ = 0.0;
  double depth_max_m_ = std::numeric_limits<double>::infinity();
  double paid_j_ = 0.0;
  double last_n_ = 0.0;                    // force in the last step
  double shortened_n_ = 0.0;               // see shortened_n()
  double depth_m_ = 0.0, s_last_m_ = 0.0;  // depth and position of the handle in the last step
  /// Low-pass filtered position (time constant fade_s), from which the direction of motion is determined
  /// without tremor.
  double s_slow_m_ = 0.0;
  bool clamped_ = false;
  bool yielding_ = false;
  bool unpaid_ = false;  // see unpaid_m()
  // Positions of the hand and the surface when the anchor last returned to the surface.
  bool home_ = false;
  double home_s_m_ = 0.0, home_surface_m_ = 0.0;
};

}  // namespace longreach
