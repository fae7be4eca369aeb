#pragma once
// Limits the distance of a retreat from a force that does not respond. On a retreat of length s,
//   s <= 20 mm + (F_0 - F)/(100 N/m);   for a moment, 0.1 rad + (M_0 - M)/(1 N m/rad)
// and s <= way_max. F is the current smoothed force, and F_0 is the maximum force during the retreat. F_0
// rises at the rate at which the force grows while the robot is at rest, so that an approaching surface
// counts as a response. The force of every real contact decreases faster than required here. If the bound is
// reached, a retreat cannot relieve the contact: either the sensor is faulty, or the robot carries an object.
// A decrease beyond the one required for s is not credited, so a faulty force signal that decreases by itself
// extends the retreat by at most 20 mm. The distance is reset only after the force has vanished.

#include <algorithm>

namespace longreach {

/// Default values for a force. For a moment, N and m stand for N m and rad.
struct RetreatBounds {
  double unanswered_m = 0.02;     // distance for which no response is required
  double answer_n_per_m = 100.0;  // minimum decrease of a responding force per metre of retreat
  double noise_n = 0.5;           // a smaller decrease is not a response
  double end_m = 1e-4;            // the budget is used up when less than this remains
  double way_max_m = 1e9;         // maximum distance
};

class RetreatBudget {
 public:
  explicit RetreatBudget(const RetreatBounds& bounds = {}) : bounds_(bounds) {}

  void limit(double way_max_m) { bounds_.way_max_m = way_max_m; }
  /// Adds a motion of the tool by `way_m` (negative: into the contact) in `dt` s. `force_n` is the current
  /// force, and `trend_n_per_s` the rate at which it grows while the robot is at rest.
  void go(double way_m, double force_n, double dt, double trend_n_per_s = 0.0) {
    way_m_ = std::max(way_m_ + way_m, 0.0);
    force_n_ = most_n_ > 0.0 ? force_n_ + std::min(dt / kSmooth_s, 1.0) * (force_n - force_n_) : force_n;
    if (most_n_ > 0.0) most_n_ += trend_n_per_s * dt;
    const double asked_n = bounds_.noise_n + bounds_.answer_n_per_m * way_m_;
    most_n_ = std::min(std::max(most_n_, force_n_), force_n_ + asked_n);
  }
  /// Remaining distance, m.
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
