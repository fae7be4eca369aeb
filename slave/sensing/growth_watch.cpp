#include "slave/sensing/growth_watch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/core/low_pass.hpp"

namespace longreach {
namespace {

constexpr double kSmooth_s = 4e-3;  // leaves a quarter of the variance of the noise at 1 kHz
constexpr double kApart_m = 25e-6;  // distance of places: 24 of them span half a millimetre, or 24 ticks
constexpr double kAtRest_m_per_s = 2e-5;
constexpr double kGrowthSeen_n = 0.4;  // growth that noise does not cause
constexpr double kNoise = 8.0;         // standard deviations that noise does not exceed
constexpr double kRest_s = 0.02;       // duration after which the tool counts as at rest
constexpr double kRemembered_s = 0.5;  // time for which a place is stored
constexpr double kOwn = 10.0;          // times k_max: faster growth is not caused by the distance moved
constexpr double kAgainst = 0.5;       // cosine of a motion against the force
constexpr double kTrend = 1.3;         // factor on the trend at rest, which is not known exactly
constexpr double kInnocent_m = 1e-3;   // distance over which the force must not grow again

}  // namespace

void GrowthWatch::reset() {
  places_.clear();
  direction_.setZero();
  begun_ = false;
  time_s_ = rest_s_ = 0.0;
}

void GrowthWatch::forget() {
  places_.clear();
  direction_.setZero();
}

// Gives force and place the same delay, so that growth is compared with the motion that caused it.
void GrowthWatch::smooth(const GrowthSample& s) {
  if (!begun_) {
    lagged_m_ = p_m_ = s.p_WE;
    force_n_ = s.force_n;
    size_n_ = s.force_n.stableNorm();
    begun_ = true;
  }
  const double lag_s = bounds_.bandwidth_hz > 0.0 ? 0.5 / (std::numbers::pi * bounds_.bandwidth_hz) : 0.0;
  const double share = low_pass_share(s.dt, kSmooth_s);
  lagged_m_ += low_pass_share(s.dt, lag_s) * (s.p_WE - lagged_m_);
  p_m_ += share * (lagged_m_ - p_m_);
  force_n_ += share * (s.force_n - force_n_);
  size_n_ += share * (s.force_n.stableNorm() - size_n_);
}

void GrowthWatch::step(const GrowthSample& s) {
  if (!s.in_contact) {
    reset();
    return;
  }
  const Vector3 before_m = p_m_;
  const double before_n = size_n_;
  smooth(s);
  time_s_ += s.dt;
  age_s_ += s.dt;
  while (!places_.empty() && time_s_ - places_.front().time_s > kRemembered_s) places_.pop();
  const Place here{p_m_, size_n_, 0.0, time_s_};
  if (places_.empty()) {
    places_.push(here);
  } else if (rests(p_m_ - before_m, s.dt)) {
    for (std::size_t i = 0; i < places_.size(); ++i) places_[i].force_n += size_n_ - before_n;
  } else {
    look_back(force_n_.stableNormalized(), s);
    doubt_again();
    if ((p_m_ - places_.back().p_m).norm() >= kApart_m) places_.push(here);
  }
}

bool GrowthWatch::rests(const Vector3& step_m, double dt) {
  rest_s_ = step_m.norm() < kAtRest_m_per_s * dt ? rest_s_ + dt : 0.0;
  return rest_s_ > kRest_s;
}

void GrowthWatch::look_back(const Vector3& normal, const GrowthSample& s) {
  const double k = bounds_.stiffness_n_per_m;
  const double seen_n = std::max(kGrowthSeen_n, kNoise * bounds_.noise_n) + s.uncertainty_n;
  double most_n = seen_n;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    Place& place = places_[i];
    const Vector3 way_m = p_m_ - place.p_m;
    place.deepest_m = std::max(place.deepest_m, -normal.dot(way_m));
    const double by_itself_n = kTrend * std::max(s.trend_n_per_s, 0.0) * (time_s_ - place.time_s);
    const double grown_n = size_n_ - place.force_n - by_itself_n, own_n = grown_n - k * place.deepest_m;
    const double length_m = way_m.norm(), along = normal.dot(way_m) / std::max(length_m, kApart_m);
    if (along < -kAgainst) continue;
    if (own_n <= most_n || length_m < kApart_m || grown_n > kOwn * k * length_m + seen_n) continue;
    most_n = own_n;
    direction_ = way_m / length_m;
    slope_n_per_m_ = grown_n / length_m;
    n_per_s_ = grown_n / (time_s_ - place.time_s);
    across_ = along < kAgainst;
    seen_m_ = p_m_;
    seen_n_ = size_n_;
    age_s_ = 0.0;
  }
}

// Clears the direction if the tool continues to move in it and the force does not grow.
void GrowthWatch::doubt_again() {
  if (direction_.dot(p_m_ - seen_m_) > kInnocent_m && size_n_ <= seen_n_) direction_.setZero();
}

}  // namespace longreach
