#include "slave/sensing/touch_threshold.hpp"

#include <algorithm>
#include <cmath>

namespace longreach {
namespace {

constexpr double kMeanOver = 2.0;     // filter times
constexpr double kMedian = 1.538172;  // of the length of a vector of three standard normal numbers

}  // namespace

void TouchThreshold::restart() {
  sum_n_.setZero();
  time_s_ = 0.0;
  samples_ = 0;
  means_ = 0;
}

void TouchThreshold::step(const Vector3& force_n, double speed_m_per_s, bool free, double dt) {
  if (!derived()) return;
  const bool moves = speed_m_per_s > kFreeSpeed_m_per_s;
  if (!free || (known() && !moves) || !force_n.allFinite()) return restart();
  if (moves != moves_) {
    restart();
    if (!known()) {
      if (count_ >= kFew) earlier_n_ = noise_n_;
      count_ = 0;
    }
  }
  moves_ = moves;
  if (moves) way_m_ = std::min(way_m_ + speed_m_per_s * dt, kFreeWay_m);
  sum_n_ += force_n;
  time_s_ += dt;
  ++samples_;
  constexpr double kRounding = 1e-9;
  if (time_s_ < kMeanOver * config_.filter_s - kRounding) return;
  take(sum_n_ / samples_);
  sum_n_.setZero();
  time_s_ = 0.0;
  samples_ = 0;
}

void TouchThreshold::take(const Vector3& mean_n) {
  if (means_ >= means_n_.size()) {
    const Vector3 third = mean_n - 3.0 * means_n_[0] + 3.0 * means_n_[1] - means_n_[2];
    sizes_n_[count_++ % kKept] = third.norm();
    std::array<double, kKept> sorted = sizes_n_;
    const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(std::min(count_, kKept));
    const auto middle = sorted.begin() + (end - sorted.begin()) / 2;
    std::nth_element(sorted.begin(), middle, end);
    noise_n_ = *middle / (kMedian * std::sqrt(20.0));
  }
  means_n_ = {mean_n, means_n_[0], means_n_[1]};
  ++means_;
}

double TouchThreshold::touch_n() const {
  if (!derived()) return config_.touch_n;
  if (known()) return derived_touch_n(config_, noise_n_);
  const double noise_n = std::max(earlier_n_, count_ >= kFew ? noise_n_ : 0.0);
  return std::max(configured_n_, derived_touch_n(config_, noise_n));
}

}  // namespace longreach
