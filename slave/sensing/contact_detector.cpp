#include "slave/sensing/contact_detector.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/low_pass.hpp"

namespace longreach {
namespace {

// An edge may be slid over. Noise of 0.05 N makes the normal of 0.5 N wrong by 2 mrad.
constexpr double kNormalMemoryS = 2.0;
constexpr double kNoiseMemoryS = 0.02;
constexpr double kOutlier = 5.0;  // of the usual sd: what a spike counts at most after it
constexpr double kTouchSds = 8.0;
constexpr double kClear = 10.0;  // touch thresholds: the direction of a greater force is known no better

}  // namespace

ContactReading ContactDetector::step(const Vector3& force_n, double dt, double uncertainty_n,
                                     const Vector3& bias_n) {
  if (!begun_) filtered_n_ = bias_n;
  begun_ = true;
  const double share = low_pass_share(dt, config_.filter_s);
  const double noise_n = this->noise_n(force_n, dt);
  const Vector3 next = filtered_n_ + share * (force_n - filtered_n_);
  if (next.allFinite()) {
    filtered_n_ = next;
  } else {
    ++ignored_;
  }
  ContactReading reading;
  reading.filtered_n = filtered_n_;
  const double force = std::min(filtered_n_.stableNorm(), (filtered_n_ - bias_n).stableNorm());
  const bool before = in_contact_;
  // Released below the touch threshold even if the configuration has them the wrong way round.
  reading.touch_n = std::max(config_.touch_n + uncertainty_n, kTouchSds * noise_n);
  const double release_n = std::min(config_.release_n, config_.touch_n);
  in_contact_ = before ? force >= release_n : force > reading.touch_n;
  reading.in_contact = in_contact_;
  reading.began = in_contact_ && !before;
  reading.ended = before && !in_contact_;
  if (reading.began) sum_n_.setZero();
  if (in_contact_) {
    const double weight = std::min(1.0, kClear * config_.touch_n / filtered_n_.stableNorm());
    sum_n_ = std::exp(-dt / kNormalMemoryS) * sum_n_ + weight * filtered_n_;
    reading.normal = sum_n_.stableNormalized();
  }
  return reading;
}

void ContactDetector::subtract(const Vector3& force_n) {
  filtered_n_ -= force_n;
  for (Vector3& last_n : last_n_) last_n -= force_n;
}

// E[|Δ³f|²] = 60 σ² of white noise σ an axis; the filter leaves its share a / (2 - a) of the variance.
double ContactDetector::noise_n(const Vector3& force_n, double dt) {
  if (!force_n.allFinite()) return 0.0;
  const Vector3 difference = force_n - 3.0 * last_n_[0] + 3.0 * last_n_[1] - last_n_[2];
  last_n_ = {force_n, last_n_[0], last_n_[1]};
  if (samples_ < 3) {
    ++samples_;
    return 0.0;
  }
  const double now = difference.stableNorm() / std::sqrt(60.0);
  const double usual =
      std::max({std::sqrt(variance_n2_), config_.force_noise_n, config_.touch_n / kTouchSds});
  const double counted = std::min(now, kOutlier * usual);
  variance_n2_ -= std::expm1(-dt / kNoiseMemoryS) * (counted * counted - variance_n2_);
  const double share = low_pass_share(dt, config_.filter_s);
  return std::max(now, std::sqrt(variance_n2_)) * std::sqrt(share / (2.0 - share));
}

}  // namespace longreach
