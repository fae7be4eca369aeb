#pragma once
// Running least-squares fit of a straight line, y = intercept + slope x, in one pass and without storing the
// samples:
//   slope = Sxy/Sxx,  sd² = (Syy - slope Sxy) / ((n - 2) Sxx)
// The centred moments are updated as in Welford (1962), so that a large mean does not reduce the precision.
// Samples that are not finite are skipped and counted. There is no forgetting, weighting or outlier
// rejection. Samples may come in groups that share the slope but not the intercept (analysis of covariance).

#include <cmath>
#include <cstdint>

namespace longreach {

class LineFit {
 public:
  void add(double x, double y) {
    if (!std::isfinite(x) || !std::isfinite(y)) {
      ++ignored_;
      return;
    }
    ++count_;
    ++group_count_;
    const double n = static_cast<double>(group_count_);
    const double dx = x - mean_x_;
    const double dy = y - mean_y_;
    mean_x_ += dx / n;
    mean_y_ += dy / n;
    sxx_ += dx * (x - mean_x_);
    sxy_ += dx * (y - mean_y_);
    syy_ += dy * (y - mean_y_);
  }
  void clear() { *this = LineFit{}; }
  /// Starts a new group: the following samples may have a different intercept. mean_x(), mean_y() and
  /// intercept() refer to the last group.
  void begin_group() {
    if (group_count_ == 0) return;
    ++groups_;
    group_count_ = 0;
    mean_x_ = mean_y_ = 0.0;
  }

  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] std::uint64_t ignored() const { return ignored_; }
  [[nodiscard]] double mean_x() const { return mean_x_; }
  [[nodiscard]] double mean_y() const { return mean_y_; }

  /// Returns whether the samples determine a line. If there are fewer than two samples, if all have the same
  /// x, or if a sum overflows, the result is false, and slope, intercept and slope_sd are zero.
  [[nodiscard]] bool valid() const {
    return count_ >= 2 && sxx_ > 0.0 && std::isfinite(sxx_) && std::isfinite(sxy_ / sxx_);
  }
  [[nodiscard]] double slope() const { return valid() ? sxy_ / sxx_ : 0.0; }
  [[nodiscard]] double intercept() const { return valid() ? mean_y_ - slope() * mean_x_ : 0.0; }
  /// Returns the standard deviation of the slope, assuming independent errors of y. It is zero while there
  /// are no residual degrees of freedom.
  [[nodiscard]] double slope_sd() const {
    const std::uint64_t used = groups_ + (group_count_ > 0 ? 1 : 0) + 1;
    if (!valid() || count_ <= used) return 0.0;
    const double rest = std::fmax(syy_ - slope() * sxy_, 0.0);
    return std::sqrt(rest / (static_cast<double>(count_ - used) * sxx_));
  }

 private:
  std::uint64_t count_ = 0;
  std::uint64_t group_count_ = 0;
  std::uint64_t groups_ = 0;  // number of completed groups
  std::uint64_t ignored_ = 0;
  double mean_x_ = 0.0;
  double mean_y_ = 0.0;
  double sxx_ = 0.0;
  double sxy_ = 0.0;
  double syy_ = 0.0;
};

}  // namespace longreach
