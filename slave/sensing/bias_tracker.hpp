#pragma once
// Bias of the force sensor from free motion alone: there is no contact, the tool moves faster than 5 mm/s, and
// the gripper is open (the mass of a load is not known well enough: the error of its inertia would count as
// bias, and the force could exceed the guard by as much).
//
// First zero: the mean over 10 mm and 0.2 s of motion in which the force stays within the touch threshold of
// that mean. One that is taken at rest could be a force that presses. Until then the bias counts as zero, so
// the guards see every force; but as much as was there at the start may be the bias, and is no contact while
// it does not change (contact_detector.hpp).
// Then b follows the force with a time constant of 1 s, by at most three times the drift of a second each
// second. A contact whose force grows more slowly than that while the tool moves at over 5 mm/s cannot be
// distinguished from drift; one that the tool meets at less than 5 mm/s is never taken for it.
// What is above 0.6 of the guard at the first zero, or 0.75 later, is refused: it would hide too much.
//
// Pure; allocates nothing.

#include <cmath>
#include <cstdint>
#include <limits>

#include "common/spatial/spatial.hpp"
#include "slave/config/sensing_config.hpp"

namespace longreach {

/// For status and log.
struct SensorZero {
  std::uint32_t count = 0;  // zeros so far: the first, and each time that the bias has drifted by a touch
  double bias_n = 0.0;      // at the last of them
  double refused_n = 0.0;   // size of a zero that is refused now; 0: none
  double missing_m = 0.0;   // of free motion, until the first zero; 0: it is taken
  double drift_n = 0.0;     // by which the bias may be off: standard deviation
  double touch_n = 0.0;     // threshold now
  double noise_n = 0.0;     // as measured, of the filtered force along an axis; 0: not known
  bool derived = false;     // false: thresholds are as configured
  bool noisy = false;       // the threshold is above that which the guards reckon with
};

class BiasTracker {
 public:
  struct Sample {
    Vector3 force_n = Vector3::Zero();  // without tool and load, in the sensor's frame
    double speed_m_per_s = 0.0;
    bool free = false;           // there is no contact
    bool load_known = true;      // what is held, if anything
    double uncertainty_n = 0.0;  // what of the force may be by an acceleration
    double touch_n = 0.0;        // threshold
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
  /// What of the force may be the bias besides, before the first zero.
  [[nodiscard]] const Vector3& possible_n() const { return possible_n_; }
  /// What may be the bias is not known yet, and so no contact.
  [[nodiscard]] bool starting() const { return start_s_ < kStart_s; }
  [[nodiscard]] bool known() const { return known_; }
  [[nodiscard]] std::uint32_t zeros() const { return zeros_; }
  [[nodiscard]] double logged_n() const { return logged_n_.norm(); }
  [[nodiscard]] double refused_n() const { return refused_n_; }
  [[nodiscard]] double missing_m() const;
  /// Of the bias, by drift since it was last followed: standard deviation, N.
  [[nodiscard]] double uncertainty_n() const { return drift_n_ * std::sqrt(age_s_); }

 private:
  static constexpr double kStart_s = 0.05;
  void look_at_start(const Sample& sample);
  void take_first(const Sample& sample);
  void follow(const Sample& sample);

  double drift_n_, guard_n_;
  Vector3 bias_n_ = Vector3::Zero(), possible_n_ = Vector3::Zero(), logged_n_ = Vector3::Zero();
  Vector3 mean_n_ = Vector3::Zero();    // before the first zero, over way_m_
  Vector3 smooth_n_ = Vector3::Zero();  // force, or later what it is off the bias
  double way_m_ = 0.0, time_s_ = 0.0, start_s_ = 0.0, age_s_ = 0.0, refused_n_ = 0.0;
  bool known_ = false;
  std::uint32_t zeros_ = 0;
};

}  // namespace longreach
