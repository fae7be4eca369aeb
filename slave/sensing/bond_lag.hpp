#pragma once
// Lag of the bond between gripper and load: the inertial force of a load follows the acceleration of the
// gripper approximately like the output of a first-order filter. A bank of such filters, whose time constants
// τ differ by a factor of √2, filters the acceleration a. For each of them, the part of Σ f² that is
// proportional to the filtered acceleration a_τ, where f is the force, is
//   Σ(f·a_τ)² / Σ a_τ²
// The lag is the τ for which this part is largest. f and a are filtered like the force that is used to detect
// contacts, and pass through a high-pass filter, because the bias of the sensor is not known. The sums are
// forgotten over 20 s. Until the force is well above the noise, the lag is kUsual_s.
//
// Pure; allocates nothing.

#include <array>
#include <cstddef>

#include "common/spatial/spatial.hpp"
#include "slave/config/sensing_config.hpp"

namespace longreach {

class BondLag {
 public:
  static constexpr double kUsual_s = 0.01;

  /// Processes a sample, `dt` > 0 s after the previous one: the force without the tool, but with the bias, and
  /// the acceleration (m/s²), both in the frame of the sensor. `free`: there is no contact. Samples that are
  /// not finite are skipped.
  void step(const Vector3& force_n, const Vector3& m_per_s2, bool free, const SensingConfig& sensing,
            double dt);

  [[nodiscard]] double lag_s() const { return lag_of(best_); }

 private:
  static constexpr std::size_t kLags = 9, kUsual = 4;
  struct Candidate {
    Vector3 m_per_s2 = Vector3::Zero(), mean_m_per_s2 = Vector3::Zero();
    double product = 0.0, square = 0.0;  // Σ f·a_τ and Σ a_τ²
    [[nodiscard]] double explained() const { return square > 0.0 ? product * product / square : 0.0; }
  };
  [[nodiscard]] static double lag_of(std::size_t i);

  std::array<Candidate, kLags> candidates_{};
  std::size_t best_ = kUsual;
  Vector3 force_n_ = Vector3::Zero(), mean_n_ = Vector3::Zero(), m_per_s2_ = Vector3::Zero();
  double free_s_ = 0.0;
};

}  // namespace longreach
