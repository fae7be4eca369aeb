#include "slave/sensing/bias_tracker.hpp"

#include <algorithm>

#include "slave/sensing/touch_threshold.hpp"

namespace longreach {
namespace {

constexpr double kFirst_s = 0.2;       // of motion, at least
constexpr double kBiasFilter_s = 0.1;  // of the force that the bias follows
constexpr double kFollow_s = 1.0;
constexpr double kFastest = 3.0;                    // times the drift
constexpr double kFirstShare = 0.6, kShare = 0.75;  // of the guard
constexpr double kVanished = 0.5;                   // of a force at the start that is then no bias
constexpr double kQuiet = 0.5;                      // of the threshold: what accelerations may do meanwhile

}  // namespace

void BiasTracker::step(const Sample& sample) {
  if (!sample.force_n.allFinite() || !(sample.dt > 0.0)) return;
  age_s_ += sample.dt;
  if (starting()) {
    look_at_start(sample);
  } else {
    look_whether_it_vanishes(sample);
  }
  const bool usable = sample.free && sample.load_known && sample.speed_m_per_s > kFreeSpeed_m_per_s;
  if (known_ && usable) {
    follow(sample);
  } else if (known_) {
    smooth_n_.setZero();
  } else if (usable && sample.uncertainty_n < kQuiet * sample.touch_n) {
    take_first(sample);
  } else if (!sample.free) {
    way_m_ = time_s_ = 0.0;
  }
}

void BiasTracker::look_at_start(const Sample& sample) {
  start_s_ += sample.dt;
  possible_n_ += std::min(1.0, sample.dt / start_s_) * (sample.force_n - possible_n_);
}

// A force that vanishes was that of a contact.
void BiasTracker::look_whether_it_vanishes(const Sample& sample) {
  const bool small = sample.free && sample.force_n.norm() < kVanished * possible_n_.norm();
  vanished_s_ = small ? vanished_s_ + sample.dt : 0.0;
  if (vanished_s_ > kBiasFilter_s) possible_n_.setZero();
}

void BiasTracker::take_first(const Sample& sample) {
  if (time_s_ == 0.0) mean_n_ = smooth_n_ = sample.force_n;
  time_s_ += sample.dt;
  way_m_ += sample.speed_m_per_s * sample.dt;
  const double share = -std::expm1(-sample.dt / kBiasFilter_s);
  smooth_n_ += std::min(1.0, std::max(share, sample.dt / time_s_)) * (sample.force_n - smooth_n_);
  mean_n_ += std::min(1.0, sample.dt / time_s_) * (sample.force_n - mean_n_);
  if ((smooth_n_ - mean_n_).norm() > sample.touch_n) way_m_ = time_s_ = 0.0;
  if (way_m_ < kFreeWay_m || time_s_ < kFirst_s) return;
  way_m_ = time_s_ = 0.0;
  refused_n_ = mean_n_.norm() > kFirstShare * guard_n_ ? mean_n_.norm() : 0.0;
  if (refused_n_ > 0.0) return;
  bias_n_ = logged_n_ = mean_n_;
  smooth_n_.setZero();
  possible_n_.setZero();
  known_ = true;
  age_s_ = 0.0;
  ++zeros_;
}

void BiasTracker::follow(const Sample& sample) {
  smooth_n_ -= std::expm1(-sample.dt / kBiasFilter_s) * (sample.force_n - bias_n_ - smooth_n_);
  const Vector3 moved_n =
      bias_n_ + clamp_norm(sample.dt / kFollow_s * smooth_n_, kFastest * drift_n_ * sample.dt);
  refused_n_ = moved_n.norm() > kShare * guard_n_ ? moved_n.norm() : 0.0;
  bias_n_ = clamp_norm(moved_n, kShare * guard_n_);
  age_s_ = 0.0;
  if ((bias_n_ - logged_n_).norm() <= sample.touch_n) return;
  logged_n_ = bias_n_;
  ++zeros_;
}

double BiasTracker::missing_m() const { return known_ ? 0.0 : std::max(kFreeWay_m - way_m_, 0.0); }

}  // namespace longreach
