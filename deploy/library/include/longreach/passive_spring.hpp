#pragma once
// A unilateral contact spring for a haptic device, one axis, that no sequence of stiffness and surface updates can turn
// into a source of energy: the rendering of longreach-master. s is the position of the handle along the inward normal.
//   f = K max(0, s - a)
// A higher K enters at once with the force continuous, a lower one fades, and the anchor a moves towards the surface only
// as far as dissipated energy and a small store of the engagement pay for it. The port guard sums the energy that the
// motors return, f[i-1] (s[i] - s[i-1]), injects damping where a sampled spring would return more, and limits force and
// slew rate. Source of the passivity observer: B. Hannaford, J.-H. Ryu, IEEE T-RA 18 (2002) 1. For one thread.

#include <memory>

namespace longreach {

struct PassiveSpringConfig {
  double stiffness_max_n_per_m =
      7000.0;  // below twice the damping of the device over `period_s`, or it is unstable
  double force_max_n = 15.0;
  double slew_max_n_per_s = 5000.0;
  double fade_s = 0.2;          // time constant of a falling stiffness
  double store_j = 0.02;        // energy that an engagement may return beyond what it received, 0 to 1
  double tank_max_j = 0.02;     // maximum stored dissipated energy, 0 to 1
  double handle_mass_kg = 0.2;  // of the handle alone: limits the injected damping
  double count_m = 0.0;         // resolution of the measured position; 0: exact
  double period_s = 0.001;      // of step()
};

/// Result of a step.
struct SpringForce {
  double force_n = 0.0;        // on the hand, outwards (against s), >= 0 unless damping is injected
  double stored_j = 0.0;       // in the spring
  double port_energy_j = 0.0;  // net energy from the hand into the device so far
  double store_j = 0.0;        // remaining store
  bool limited = false;        // by the maximum force
};

class [[gnu::visibility("default")]] PassiveSpring {
 public:
  /// Throws InputError for a value that is not finite or not above zero (counts, store and tank: below zero).
  explicit PassiveSpring(const PassiveSpringConfig& config = {});
  ~PassiveSpring();
  PassiveSpring(PassiveSpring &&) noexcept;
  PassiveSpring& operator=(PassiveSpring&&) noexcept;

  /// Starts an engagement without force, with a full store.
  void engage(double position_m, double surface_m);
  /// Surface, m, and stiffness, N/m, as received; clamped to 0 to the maximum. Returns false and changes nothing if one is
  /// not finite.
  bool update(double surface_m, double stiffness_n_per_m);
  /// One period. `velocity_m_per_s` is that of the handle; 0 where it is uncertain. A value that is not finite keeps the
  /// previous one. Does not allocate.
  SpringForce step(double position_m, double velocity_m_per_s);

  [[nodiscard]] double stiffness_n_per_m() const;  // rendered
  [[nodiscard]] double anchor_m() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
