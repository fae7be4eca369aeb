#pragma once
// Estimates the variance of white noise on a smooth signal from its third differences: E[(Δ³s)²] = 20 σ².
// Motion below a tenth of the sample rate contributes very little. The contribution of a jump or a kink is
// limited, so that the following samples outweigh it.

#include <algorithm>
#include <cmath>

namespace longreach {

class DifferenceNoise {
 public:
  void add(double value) {
    const double difference = value - 3.0 * last_[0] + 3.0 * last_[1] - last_[2];
    last_[2] = last_[1];
    last_[1] = last_[0];
    last_[0] = value;
    if (++samples_ <= 3.0) return;
    samples_ = std::min(samples_, kMemory);
    largest_ = std::max(largest_, std::abs(value));
    const double usual = std::max(kOutlier * variance_, kStart * kStart * largest_ * largest_);
    variance_ += (std::min(difference * difference / 20.0, usual) - variance_) / (samples_ - 3.0);
  }
  /// Variance, deliberately overestimated while there are few samples; it is then at least
  /// `first`².
  [[nodiscard]] double cautious_variance(double first) const {
    const double differences = std::max(samples_ - 3.0, 0.0);
    const double of_few = differences < kFew ? first * first : 0.0;
    return std::max(of_few, variance_ * (1.0 + kFew / std::max(differences, 1.0)));
  }
  /// Variance; 0 with fewer than four samples.
  [[nodiscard]] double variance() const { return variance_; }

 private:
  static constexpr double kOutlier = 25.0;  // limit of a contribution, relative to the variance
  static constexpr double kStart = 0.01;    // initial standard deviation, relative to the largest value
  static constexpr double kFew = 20.0;
  static constexpr double kMemory = 2000.0;  // samples
  double last_[3] = {0.0, 0.0, 0.0};
  double largest_ = 0.0;
  double samples_ = 0.0;
  double variance_ = 0.0;
};

}  // namespace longreach
