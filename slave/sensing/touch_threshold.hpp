#pragma once
// Derives the touch threshold from the noise of the force that is used to detect contacts. That force is
// filtered over about two filter time constants. The noise σ of means m over the same duration is therefore
// measured, regardless of the rate and the spectrum of the samples. Third differences contain neither the
// bias nor its drift, nor the residual inertial force of tool and load:
//   E[|Δ³m|²] = 60 σ²;   the median of |Δ³m| is 1.538 √20 σ for three axes
// The median of the last kKept differences ignores the contribution of a change of acceleration or of a light
// contact. σ is known after 10 mm of free motion with kEnough differences; free motion is required because
// the noise is different during contact. The threshold is 8 σ + the drift of 10 s
// (slave/config/sensing_config.hpp). Until σ is known, the threshold is derived from the configured noise, or
// from the noise at rest if that is greater.
//
// Pure; allocates nothing.

#include <array>
#include <cstddef>

#include "common/spatial/spatial.hpp"
#include "slave/config/sensing_config.hpp"

namespace longreach {

/// Speed below which the tool does not count as moving when thresholds and bias are determined.
constexpr double kFreeSpeed_m_per_s = 5e-3;
/// Distance of free motion that is required before noise or bias is derived from it.
constexpr double kFreeWay_m = 0.01;

class TouchThreshold {
 public:
  explicit TouchThreshold(const SensingConfig& config) { configure(config); }
  void configure(const SensingConfig& config) {
    config_ = config;
    configured_n_ = configured_touch_n(config);
  }

  /// Processes a sample, `dt` s after the previous one. `free`: there is no contact, and the load in the
  /// gripper is known.
  void step(const Vector3& force_n, double speed_m_per_s, bool free, double dt);

  [[nodiscard]] bool derived() const { return !(config_.touch_n > 0.0); }
  /// True if the noise has been measured.
  [[nodiscard]] bool known() const { return way_m_ >= kFreeWay_m && count_ >= kEnough; }
  /// Standard deviation of the filtered force along an axis, N; 0: unknown.
  [[nodiscard]] double noise_n() const { return known() ? noise_n_ : 0.0; }
  [[nodiscard]] double touch_n() const;
  [[nodiscard]] double release_n() const { return release_of_n(config_, touch_n()); }

 private:
  static constexpr std::size_t kKept = 128, kEnough = 32, kFew = 8;
  void take(const Vector3& mean_n);
  void restart();

  SensingConfig config_;
  double configured_n_ = 0.0;
  Vector3 sum_n_ = Vector3::Zero();  // sum for the next mean
  double time_s_ = 0.0;
  int samples_ = 0;
  std::array<Vector3, 3> means_n_{};
  std::size_t means_ = 0;  // number of consecutive means
  std::array<double, kKept> sizes_n_{};
  std::size_t count_ = 0;
  bool moves_ = false;
  double noise_n_ = 0.0, way_m_ = 0.0;
  /// Noise before the tool last started or stopped moving.
  double earlier_n_ = 0.0;
};

}  // namespace longreach
