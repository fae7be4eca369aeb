#pragma once
// How far a robot may give way to a force. On a way s, from the largest force F_0 that was met on it to F
// now, smoothed,
//   s <= 20 mm + (F_0 - F)/(100 N/m);   to a moment, 0.1 rad + (M_0 - M)/(1 N m/rad)
// and s <= way_max. F_0 rises by what the force grows by at rest: a wall that comes answers, too.
// Each contact that pushes falls by more than that. What does not is no contact that giving way relieves: a
// sensor that lies, a body that the robot carries. What the force has fallen beyond what s
// asks for is forgotten: a lie that eases by itself buys 20 mm again at most. It counts until the force
// has gone.

#include <algorithm>

namespace longreach {

/// Of a force. Of a moment N are N m, m are rad.
struct RetreatBounds {
  double unanswered_m = 0.02;
  double answer_n_per_m = 100.0;
  double noise_n = 0.5;  // no answer
  double end_m = 1e-4;   // so near the end is at it
  double way_max_m = 1e9;
};

class RetreatBudget {
 public:
  explicit RetreatBudget(const RetreatBounds& bounds = {}) : bounds_(bounds) {}

  void limit(double way_max_m) { bounds_.way_max_m = way_max_m; }
  /// It has gone `way_m` in `dt` s, in again where that is negative, and the force is now `force_n`; at rest
  /// it grows by `trend_n_per_s`.
  void go(double way_m, double force_n, double dt, double trend_n_per_s = 0.0) {
    way_m_ = std::max(way_m_ + way_m, 0.0);
    force_n_ = most_n_ > 0.0 ? force_n_ + std::min(dt / kSmooth_s, 1.0) * (force_n - force_n_) : force_n;
    if (most_n_ > 0.0) most_n_ += trend_n_per_s * dt;
    const double asked_n = bounds_.noise_n + bounds_.answer_n_per_m * way_m_;
    most_n_ = std::min(std::max(most_n_, force_n_), force_n_ + asked_n);
  }
  /// Way that is left.
  [[nodiscard]] double left_m() const {
    const double answer_n = std::max(most_n_ - force_n_ - bounds_.noise_n, 0.0);
    const double answered_m = bounds_.unanswered_m + answer_n / bounds_.answer_n_per_m;
    return std::min(answered_m, bounds_.way_max_m) - way_m_;
  }
  [[nodiscard]] bool may_go_on() const { return left_m() > bounds_.end_m; }
  void reset() { way_m_ = most_n_ = force_n_ = 0.0; }

 private:
  static constexpr double kSmooth_s = 0.02;

  RetreatBounds bounds_;
  double way_m_ = 0.0;
  double most_n_ = 0.0, force_n_ = 0.0;
};

}  // namespace longreach
