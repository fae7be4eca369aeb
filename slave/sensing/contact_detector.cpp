#include "slave/sensing/contact_detector.hpp"

#include <algorithm>
#include <cmath>

namespace longreach {
namespace {

// An edge may be slid over. Noise of 0.05 N makes the normal of 0.5 N wrong by 2 mrad.
constexpr double kNormalMemoryS = 2.0;

}  // namespace

ContactReading ContactDetector::step(const Vector3& force_n, double dt, double doubt_n) {
  const double share = config_.filter_s > 0.0 ? -std::expm1(-dt / config_.filter_s) : 1.0;
  const Vector3 next = filtered_n_ + share * (force_n - filtered_n_);
  if (next.allFinite()) {
    filtered_n_ = next;
  } else {
    ++ignored_;
  }
  ContactReading reading;
  reading.filtered_n = filtered_n_;
  const double force = filtered_n_.stableNorm();
  const bool before = in_contact_;
  // Released below the touch threshold even if the configuration has them the wrong way round.
  in_contact_ =
      before ? force >= std::min(config_.release_n, config_.touch_n) : force > config_.touch_n + doubt_n;
  reading.in_contact = in_contact_;
  reading.began = in_contact_ && !before;
  reading.ended = before && !in_contact_;
  if (reading.began) sum_n_.setZero();
  if (in_contact_) {
    sum_n_ = std::exp(-dt / kNormalMemoryS) * sum_n_ + filtered_n_;
    reading.normal = sum_n_.stableNormalized();
  }
  return reading;
}

}  // namespace longreach
