#pragma once
// Estimates the bias of the force sensor from free motion: there is no contact, the tool moves faster than 5
// mm/s, and the gripper is open. (If the gripper were closed, an error in the load's mass would be treated as
// bias, and the force could exceed the guard limit by that error.)
//
// The first zeroing uses the mean over 10 mm and 0.2 s of motion in which the force stays within the touch
// threshold of that mean. The sensor is not zeroed while the tool is at rest, because the reading could be
// the force of a contact. Before the first zeroing, a bias of zero is assumed, so the guards receive the
// whole force. However, the force at the start may be bias; it does not count as a contact while it remains
// constant (contact_detector.hpp), and it is not bias if it vanishes while there is no contact.
//
// After the first zeroing, the bias follows the force with a time constant of 1 s, and its rate is limited to
// three times the drift per second. A contact whose force grows more slowly, while the tool moves faster than
// 5 mm/s, is not distinguishable from drift. A contact that is touched at less than 5 mm/s never counts as
// drift. A bias above 0.6 of the guard limit at the first zeroing, or above 0.75 of that limit later, is
// refused because it would hide too much force.
//
// Pure; allocates nothing.

#include <cmath>
#include <cstdint>
#include <limits>

#include "common/spatial/spatial.hpp"
#include "schema/state_slave.hpp"
#include "slave/config/sensing_config.hpp"

namespace longreach {

class BiasTracker {
 public:
  struct Sample {
    /// Force without the effect of tool and load, in the frame of the sensor.
    Vector3 force_n = Vector3::Zero();
    double speed_m_per_s = 0.0;
    bool free = false;           // there is no contact
    bool load_known = true;      // the gripper is empty, or its load is known
    double uncertainty_n = 0.0;  // part of the force that acceleration may cause
    double touch_n = 0.0;        // touch threshold
    double dt = 0.0;             // s
  };

  explicit BiasTracker(double drift_n, double guard_n = std::numeric_limits<double>::infinity())
      : drift_n_(drift_n), guard_n_(guard_n) {}
  void configure(double drift_n, double guard_n) {
    drift_n_ = drift_n;
    guard_n_ = guard_n;
  }

  void step(const Sample& sample);

  [[nodiscard]] const Vector3& bias_n() const { return bias_n_; }
  /// Part of the force that may be bias in addition to bias_n(); zero after the first zeroing, or after the force
  /// at the start has vanished.
  [[nodiscard]] const Vector3& possible_n() const { return possible_n_; }
  /// True while possible_n() has not been determined; no force counts as a contact until then.
  [[nodiscard]] bool starting() const { return start_s_ < kStart_s; }
  [[nodiscard]] bool known() const { return known_; }
  [[nodiscard]] std::uint32_t zeros() const { return zeros_; }
  [[nodiscard]] double logged_n() const { return logged_n_.norm(); }
  [[nodiscard]] double refused_n() const { return refused_n_; }
  [[nodiscard]] double missing_m() const;
  /// Standard deviation of the bias due to drift since its last update, N.
  [[nodiscard]] double uncertainty_n() const { return drift_n_ * std::sqrt(age_s_); }

 private:
  static constexpr double kStart_s = 0.05;
  void look_at_start(const Sample& sample);
  void look_whether_it_vanishes(const Sample& sample);
  void take_first(const Sample& sample);
  void follow(const Sample& sample);

  double drift_n_, guard_n_;
  Vector3 bias_n_ = Vector3::Zero(), possible_n_ = Vector3::Zero(), logged_n_ = Vector3::Zero();
  Vector3 mean_n_ = Vector3::Zero();  // mean over way_m_, before the first zeroing
  /// Smoothed force before the first zeroing; afterwards its difference from the bias.
  Vector3 smooth_n_ = Vector3::Zero();
  double way_m_ = 0.0, time_s_ = 0.0, start_s_ = 0.0, vanished_s_ = 0.0, age_s_ = 0.0, refused_n_ = 0.0;
  bool known_ = false;
  std::uint32_t zeros_ = 0;
};

}  // namespace longreach
