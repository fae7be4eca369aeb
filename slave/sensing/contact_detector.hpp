#pragma once
// Detects contacts of the tool and the direction of the contact force.
//   f̄ += (1 - exp(-dt/τ)) (f - f̄);  contact starts when |f̄| > touch, ends when |f̄| < release
// To prevent false contacts from a noisy sensor, `touch` is at least 8 standard deviations of f̄ along an
// axis, which are estimated from the third differences of the last 20 ms (difference_noise.hpp describes
// their limitations). Noise does not end a contact either. The direction of the force on the tool is the
// outward normal of a frictionless wall:
//   n = Σ w f̄ / |Σ w f̄| over the last 2 s of the contact
// Above ten times the touch threshold, w falls as 1/|f̄|, so that an earlier large force does not hide the
// current one. Until the sensor is zeroed for the first time, a part u of the force may be bias. A force then
// counts as a contact only if both |f̄| and |f̄ - u| exceed the threshold. Samples that are not finite are
// skipped and counted.

#include <array>
#include <cstdint>

#include "common/spatial/spatial.hpp"
#include "slave/config/sensing_config.hpp"

namespace longreach {

struct ContactReading {
  bool in_contact = false;
  bool began = false;                    // the contact started in this step
  bool ended = false;                    // the contact ended in this step
  Vector3 filtered_n = Vector3::Zero();  // filtered force, N, in the frame of the input
  double touch_n = 0.0;                  // current touch threshold, N
  /// Unit vector in the direction of the force during contact; otherwise zero.
  Vector3 normal = Vector3::Zero();
};

class ContactDetector {
 public:
  explicit ContactDetector(const SensingConfig& config) : config_(with_thresholds(config)) {}

  void configure(const SensingConfig& config) { config_ = with_thresholds(config); }
  /// Sets derived thresholds.
  void set_thresholds(double touch_n, double release_n) {
    config_.touch_n = touch_n;
    config_.release_n = release_n;
  }

  /// Processes a sample. `uncertainty_n` is the uncertain part of the force; it is added to the threshold.
  /// `bias_n` is u.
  ContactReading step(const Vector3& force_n, double dt, double uncertainty_n = 0.0,
                      const Vector3& bias_n = Vector3::Zero());
  /// Subtracts `force_n` from the filtered force after the sensor has been zeroed.
  void subtract(const Vector3& force_n);

  [[nodiscard]] std::uint64_t ignored() const { return ignored_; }

 private:
  /// Returns the standard deviation of f̄ along an axis, N.
  double noise_n(const Vector3& force_n, double dt);

  SensingConfig config_;
  std::array<Vector3, 3> last_n_{Vector3::Zero(), Vector3::Zero(), Vector3::Zero()};
  int samples_ = 0;
  bool begun_ = false;
  double variance_n2_ = 0.0;  // variance of f along an axis
  Vector3 filtered_n_ = Vector3::Zero();
  Vector3 sum_n_ = Vector3::Zero();
  bool in_contact_ = false;
  std::uint64_t ignored_ = 0;
};

}  // namespace longreach
