#pragma once
// Stores the samples of a contact in bounded memory for a fit that tries various surface positions and
// exponents. The samples are stored as sums over narrow position bins. A bin is located at the mean position
// of its samples and stores how the speed varied with the position in it, so only the curvature within a bin
// is lost. At n = 1.5 and with 64 bins, this error is 1e-4 of the force at the maximum depth. When a sample
// is outside all bins, the bins are merged in pairs, which doubles their width. The weights grow by a factor
// of 1/forgetting per sample.

#include <array>
#include <cmath>

#include "slave/estimation/contact_fit.hpp"

namespace longreach {

struct DepthBin {
  double w = 0.0;   // Σ w
  double x = 0.0;   // Σ w x
  double v = 0.0;   // Σ w v
  double vv = 0.0;  // Σ w v²
  double f = 0.0;   // Σ w F
  double fv = 0.0;  // Σ w F v
  double xv = 0.0;  // Σ w x v

  void add(const DepthBin& b) {
    w += b.w;
    x += b.x;
    v += b.v;
    vv += b.vv;
    f += b.f;
    fv += b.fv;
    xv += b.xv;
  }
  void scale(double by) {
    w *= by;
    x *= by;
    v *= by;
    vv *= by;
    f *= by;
    fv *= by;
    xv *= by;
  }
};

class DepthBins {
 public:
  static constexpr int kBins = 64;

  void add(const PenetrationSample& s, double forgetting) {
    if (width_m_ <= 0.0) {
      width_m_ = kFirstWidthM;
      first_m_ = s.x_m - 0.5 * kBins * width_m_;
    }
    for (int i = 0; i < kDoublingsMax && !within(s.x_m); ++i) double_width(s.x_m < first_m_);
    if (!within(s.x_m)) return;
    weight_ /= forgetting;
    if (weight_ > kWeightMax) {
      for (DepthBin& bin : bins_) bin.scale(1.0 / weight_);
      weight_ = 1.0;
    }
    const double w = weight_, wv = w * s.v_m_per_s;
    sum_ = forgetting * sum_ + 1.0;
    square_sum_ = forgetting * forgetting * square_sum_ + 1.0;
    const auto i = static_cast<std::size_t>((s.x_m - first_m_) / width_m_);
    bins_[std::min<std::size_t>(i, kBins - 1)].add(
        {w, w * s.x_m, wv, wv * s.v_m_per_s, w * s.force_n, wv * s.force_n, wv * s.x_m});
  }
  [[nodiscard]] const std::array<DepthBin, kBins>& bins() const { return bins_; }
  [[nodiscard]] double weight() const { return weight_; }  // weight of the last sample
  /// Σ w²/Σ w relative to the weight of the last sample: the ratio of the variance of the fit to the variance
  /// with equally weighted samples.
  [[nodiscard]] double variance_share() const { return sum_ > 0.0 ? square_sum_ / sum_ : 1.0; }

 private:
  static constexpr double kFirstWidthM = 1e-9;
  static constexpr int kDoublingsMax = 64;
  static constexpr double kWeightMax = 1e6;

  [[nodiscard]] bool within(double x) const { return x >= first_m_ && x < first_m_ + kBins * width_m_; }
  // Doubles the width of the bins, towards smaller (`down`) or larger positions.
  void double_width(bool down) {
    std::array<DepthBin, kBins> wide{};
    const int first = down ? kBins / 2 : 0;
    for (int i = 0; i < kBins; ++i) {
      wide[static_cast<std::size_t>(first + i / 2)].add(bins_[static_cast<std::size_t>(i)]);
    }
    bins_ = wide;
    if (down) first_m_ -= kBins * width_m_;
    width_m_ *= 2.0;
  }

  std::array<DepthBin, kBins> bins_{};
  double first_m_ = 0.0;
  double width_m_ = 0.0;  // 0: no sample yet
  double weight_ = 1.0;
  /// Sums of the weights and of their squares, relative to the last weight.
  double sum_ = 0.0, square_sum_ = 0.0;
};

}  // namespace longreach
