#pragma once
// Is the tool in contact, and in which direction does the contact push?
//   f̄ += (1 - exp(-dt/τ)) (f - f̄);  contact begins when |f̄| > touch, ends when |f̄| < release
//   n = Σ w f̄ / |Σ w f̄| over the contact, its last 2 s: the direction of the force on the tool (outward
//   normal of a frictionless wall)
// A sample that is not finite is left out and counted.

#include <cstdint>

#include "common/spatial/spatial.hpp"
#include "slave/sensing/sensing_config.hpp"

namespace longreach {

struct ContactReading {
  bool in_contact = false;
  bool began = false;                    // in this step
  bool ended = false;                    // in this step
  Vector3 filtered_n = Vector3::Zero();  // N, in the frame of the input
  Vector3 normal = Vector3::Zero();      // unit, while in contact; else zero
};

class ContactDetector {
 public:
  explicit ContactDetector(const SensingConfig& config) : config_(config) {}

  void configure(const SensingConfig& config) { config_ = config; }

  /// `doubt_n`: what of the force may be none; so much more makes a contact.
  ContactReading step(const Vector3& force_n, double dt, double doubt_n = 0.0);

  [[nodiscard]] std::uint64_t ignored() const { return ignored_; }

 private:
  SensingConfig config_;
  Vector3 filtered_n_ = Vector3::Zero();
  Vector3 sum_n_ = Vector3::Zero();
  bool in_contact_ = false;
  std::uint64_t ignored_ = 0;
};

}  // namespace longreach
