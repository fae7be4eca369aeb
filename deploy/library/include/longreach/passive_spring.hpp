#pragma once
// A unilateral contact spring for one axis of a haptic device, as in longreach-master. No sequence of stiffness and
// surface updates can turn it into a source of energy. s is the position of the handle along the inward normal.
//   f = K max(0, s - a)
// An increase of K takes effect at once, with a continuous force; a decrease is gradual. The anchor a moves towards the
// surface only as far as the dissipated energy and a small initial store permit. The port guard sums the energy that
// the motors return, f[i-1] (s[i] - s[i-1]), injects damping where a sampled spring would return more, and limits force
// and slew rate. Source of the passivity observer: B. Hannaford, J.-H. Ryu, IEEE T-RA 18 (2002) 1. Not thread-safe.

#include <memory>

namespace longreach {

struct PassiveSpringConfig {
  double stiffness_max_n_per_m = 7000.0;  // must be below 2 x device damping / `period_s` for stability
  double force_max_n = 15.0;
  double slew_max_n_per_s = 5000.0;
  double fade_s = 0.2;       // time constant of a falling stiffness
  double store_j = 0.02;     // energy that an engagement may return in excess of the received energy, 0 to 1
  double tank_max_j = 0.02;  // maximum stored dissipated energy, 0 to 1
  double handle_mass_kg = 0.2;  // handle without the hand; limits the injected damping
  double count_m = 0.0;         // resolution of the measured position; 0: exact
  double period_s = 0.001;      // time between calls of step()
};

/// Result of a step.
struct SpringForce {
  double force_n = 0.0;        // force on the hand, outwards (against s); >= 0 unless damping is injected
  double stored_j = 0.0;       // energy stored in the spring
  double port_energy_j = 0.0;  // net energy from the hand into the device so far
  double store_j = 0.0;        // remaining store
  bool limited = false;        // the force or its slew rate was limited
};

class [[gnu::visibility("default")]] PassiveSpring {
 public:
  /// Throws InputError for a non-finite or out-of-range value. Only count_m, store_j and tank_max_j may be zero.
  explicit PassiveSpring(const PassiveSpringConfig& config = {});
  ~PassiveSpring();
  PassiveSpring(PassiveSpring &&) noexcept;
  PassiveSpring& operator=(PassiveSpring&&) noexcept;

  /// Starts an engagement with zero force and a full store. Throws InputError if a value is not finite.
  void engage(double position_m, double surface_m);
  /// Sets the surface, m, and the stiffness, N/m, which is clamped to the range from 0 to the maximum.
  /// Returns false and changes nothing if a value is not finite.
  bool update(double surface_m, double stiffness_n_per_m);
  /// Runs one period. `velocity_m_per_s` is the velocity of the handle; 0 if it is uncertain. A non-finite
  /// position is replaced by the previous one, a non-finite velocity by 0. Does not allocate memory.
  SpringForce step(double position_m, double velocity_m_per_s);

  [[nodiscard]] double stiffness_n_per_m() const;  // rendered stiffness
  [[nodiscard]] double anchor_m() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
