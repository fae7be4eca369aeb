#pragma once
// The touch threshold, from the noise of the force that decides about contact. That force is filtered over
// about two of its time constants; so the noise of means m over as long a time is measured, whatever the rate
// and the spectrum of the samples. Third differences see neither bias and drift nor what is left of the
// inertia of tool and load:
//   E[|Δ³m|²] = 60 σ²;   the median of |Δ³m| is 1.538 √20 σ of three axes
// The median of the last kKept differences leaves out what a change of acceleration or a light contact adds.
// σ is known after 10 mm of free motion and kEnough differences in it: a tool that is pressed has another noise.
// touch = 8 σ + the drift of 10 s (slave/config/sensing_config.hpp). Until then it is that of the configured
// noise, or that of the noise at rest where that is greater.
//
// Pure; allocates nothing.

#include <array>
#include <cstddef>

#include "common/spatial/spatial.hpp"
#include "slave/config/sensing_config.hpp"

namespace longreach {

constexpr double kFreeSpeed_m_per_s = 5e-3;  // slower is not motion, for thresholds and bias
constexpr double kFreeWay_m = 0.01;          // of free motion, before anything is derived from it

class TouchThreshold {
 public:
  explicit TouchThreshold(const SensingConfig& config) : config_(config) {}
  void configure(const SensingConfig& config) { config_ = config; }

  /// A new sample, `dt` after the one before. `free`: there is no contact, and what is held is known.
  void step(const Vector3& force_n, double speed_m_per_s, bool free, double dt);

  [[nodiscard]] bool derived() const { return !(config_.touch_n > 0.0); }
  /// The noise has been measured.
  [[nodiscard]] bool known() const { return way_m_ >= kFreeWay_m && count_ >= kEnough; }
  /// Standard deviation of the filtered force along an axis, N; 0: not known.
  [[nodiscard]] double noise_n() const { return known() ? noise_n_ : 0.0; }
  [[nodiscard]] double touch_n() const;
  [[nodiscard]] double release_n() const { return release_of_n(config_, touch_n()); }

 private:
  static constexpr std::size_t kKept = 128, kEnough = 32, kFew = 8;
  void take(const Vector3& mean_n);
  void restart();

  SensingConfig config_;
  Vector3 sum_n_ = Vector3::Zero();  // of the mean that is being taken
  double time_s_ = 0.0;
  int samples_ = 0;
  std::array<Vector3, 3> means_n_{};
  std::size_t means_ = 0;  // in a row
  std::array<double, kKept> sizes_n_{};
  std::size_t count_ = 0;
  bool moves_ = false;
  double noise_n_ = 0.0, way_m_ = 0.0;
  double earlier_n_ = 0.0;  // noise before the tool began to move, or came to rest, last
};

}  // namespace longreach
