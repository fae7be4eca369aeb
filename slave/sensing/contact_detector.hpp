#pragma once
// Is the tool in contact, and in which direction does the contact push?
//   f̄ += (1 - exp(-dt/τ)) (f - f̄);  contact begins when |f̄| > touch, ends when |f̄| < release
// A sensor that becomes noisy makes no contact: touch is at least 8 standard deviations of f̄ along an axis,
// from the third differences of the last 20 ms (difference_noise.hpp says what they see). It ends none
// either.
//   n = Σ w f̄ / |Σ w f̄| over the contact, its last 2 s: the direction of the force on the tool (outward
//   normal of a frictionless wall); above ten times the touch threshold w falls as 1/|f̄|, so that a great
//   force that was there before does not hide what presses now
// A sample that is not finite is left out and counted.

#include <array>
#include <cstdint>

#include "common/spatial/spatial.hpp"
#include "slave/config/sensing_config.hpp"

namespace longreach {

struct ContactReading {
  bool in_contact = false;
  bool began = false;                    // in this step
  bool ended = false;                    // in this step
  Vector3 filtered_n = Vector3::Zero();  // N, in the frame of the input
  double touch_n = 0.0;                  // what makes a contact now, N
  Vector3 normal = Vector3::Zero();      // unit, while in contact; else zero
};

class ContactDetector {
 public:
  explicit ContactDetector(const SensingConfig& config) : config_(config) {}

  void configure(const SensingConfig& config) { config_ = config; }

  /// `doubt_n`: what of the force may be none; so much more makes a contact.
  ContactReading step(const Vector3& force_n, double dt, double uncertainty_n = 0.0);

  [[nodiscard]] std::uint64_t ignored() const { return ignored_; }

 private:
  /// Standard deviation of f̄ along an axis, N.
  double noise_n(const Vector3& force_n, double dt);

  SensingConfig config_;
  std::array<Vector3, 3> last_n_{Vector3::Zero(), Vector3::Zero(), Vector3::Zero()};
  int samples_ = 0;
  double variance_n2_ = 0.0;  // of f along an axis
  Vector3 filtered_n_ = Vector3::Zero();
  Vector3 sum_n_ = Vector3::Zero();
  bool in_contact_ = false;
  std::uint64_t ignored_ = 0;
};

}  // namespace longreach
