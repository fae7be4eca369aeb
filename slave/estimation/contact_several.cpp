// Several surfaces that are pressed at once: which of them bears which part of the force, and which force is that of a new
// one.

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "slave/estimation/contact.hpp"

namespace longreach {
namespace {

constexpr double kAcross =
    0.5;  // sine, 30 degrees, between the force of another surface and the pressed ones
constexpr double kUnknown =
    3.0;  // sd of the normal: this part of the force may be across it by that error alone
constexpr double kFriction = 0.6;  // maximum coefficient of friction
constexpr double kStickM = 5e-4;   // motion after which friction has reached its maximum
constexpr double kGrown = 1.5;  // growth, while the distance doubles, of a small force that is not friction
constexpr double kUnexplained =
    0.436;                           // sine, 26 degrees: part of a force that known surfaces need not explain
constexpr double kLeastShare = 0.1;  // of the largest force, which an error of its normal may cause
constexpr double kTowards = 0.2;     // sine, 11 degrees, of the motion towards a new surface
constexpr double kJoins = 0.2;       // likewise, from which on a known surface is pressed, too

}  // namespace

// Begins touches of remembered surfaces that the tool has reached and that explain the force together with the pressed
// ones. A force that a single surface explains is left to the caller. Returns whether touches began.
bool SlaveContact::reach_known(const ContactInput& input, const Vector3& force_n) {
  std::array<bool, kSurfaces> bears{}, reached{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < kSurfaces; ++i) {
    const Surface& s = surfaces_[i];
    reached[i] = !s.pressed() && s.there() && s.reached(input.p_WE);
    bears[i] = s.pressed() || reached[i];
    count += bears[i] ? 1 : 0;
  }
  if (count < 2) return false;
  const Vector3 share_n = shares(force_n, bears);
  // More than that below which a pressed surface is left.
  const double least_n =
      pressed() == 0 ? sensing_.release_n : std::max(sensing_.touch_n, kJoins * share_n.maxCoeff());
  Vector3 rest_n = force_n;
  count = 0;
  for (std::size_t i = 0; i < kSurfaces; ++i) {
    const double share = share_n[static_cast<Eigen::Index>(i)];
    if (bears[i]) rest_n -= share * surfaces_[i].normal();
    reached[i] = reached[i] && share > least_n;
    count += reached[i] || surfaces_[i].pressed() ? 1 : 0;
  }
  if (count < 2 || rest_n.stableNorm() > kUnexplained * force_n.stableNorm()) return false;
  for (std::size_t i = 0; i < kSurfaces; ++i) {
    const Vector3& normal = surfaces_[i].normal();
    if (!reached[i]) continue;
    surfaces_[i].begin({++touches_, share_n[static_cast<Eigen::Index>(i)] * normal, input.p_WE, input.p_WE,
                        input.played_sequence, input.scale},
                       true, before_);
    foremost_ = i;
  }
  before_.clear();
  waiting_.clear();
  aside_ = {input.p_WE};
  turning_ = true;
  return true;
}

// While a new surface is learnt, the surfaces with a law bear what the law says, and the new one the remainder.
void SlaveContact::press_several(const ContactInput& input) {
  turn_newest(input.dt);
  const Surface* newest = newest_new();
  std::array<bool, kSurfaces> given{}, bears{};
  Vector3 filtered_rest_n = reading_.filtered_n, raw_rest_n = input.force_n;
  Vector3 law_n = Vector3::Zero();
  for (std::size_t i = 0; i < kSurfaces; ++i) {
    const Surface& s = surfaces_[i];
    const std::optional<double> foreseen_n = s.foreseen_n();
    given[i] = newest != nullptr && newest != &s && s.pressed() && foreseen_n;
    bears[i] = s.pressed() && !given[i];
    if (!given[i]) continue;
    law_n[static_cast<Eigen::Index>(i)] = *foreseen_n;
    filtered_rest_n -= *foreseen_n * s.normal();
    raw_rest_n -= *foreseen_n * s.normal();
  }
  const Vector3 filtered_n = law_n + shares(filtered_rest_n, bears),
                raw_n = law_n + shares(raw_rest_n, bears);
  foremost_ = 0;
  for (std::size_t i = 0; i < kSurfaces; ++i) {
    Surface& s = surfaces_[i];
    if (!s.pressed()) continue;
    const auto at = static_cast<Eigen::Index>(i);
    if (pressed() > 1 && filtered_n[at] < std::max(sensing_.release_n, kLeastShare * filtered_n.maxCoeff())) {
      s.release(reading_.filtered_n.stableNorm());
      continue;
    }
    s.press({.p_WE = input.p_WE,
             .v_WE = input.v_WE,
             .outward = s.normal(),
             .force_n = raw_n[at] * s.normal(),
             .dt = input.dt,
             .guarded = input.guarded,
             .news_age_s = input.news_age_s,
             .learns = !given[i]});
    if (!surfaces_[foremost_].pressed() || filtered_n[at] > filtered_n[static_cast<Eigen::Index>(foremost_)])
      foremost_ = i;
  }
}

/// Turns the normal of a new surface by the force that the laws of the others do not explain.
void SlaveContact::turn_newest(double dt) {
  Surface* newest = newest_new();
  if (newest == nullptr) return;
  Vector3 rest = reading_.filtered_n;
  for (const Surface& other : surfaces_) {
    if (&other == newest || !other.pressed()) continue;
    const auto force_n = other.foreseen_n();
    if (!force_n) return;
    rest -= *force_n * other.normal();
  }
  if (rest.stableNorm() > sensing_.touch_n) newest->turn(rest, dt);
  // What turns into the direction of another surface is that surface, whose law has changed: another tile, another layer.
  const auto same = [newest](const Surface& s) {
    return &s != newest && s.pressed() && s.normal().dot(newest->normal()) > Surface::kSameNormal;
  };
  if (std::ranges::any_of(surfaces_, same)) newest->forget();
}

Surface* SlaveContact::newest_new() {
  Surface* newest = nullptr;
  for (Surface& s : surfaces_) {
    if (s.pressed() && (newest == nullptr || s.touch() > newest->touch())) newest = &s;
  }
  return newest != nullptr && newest->is_new() ? newest : nullptr;
}

Vector3 SlaveContact::shares(const Vector3& force_n) const {
  std::array<bool, kSurfaces> bears{};
  std::ranges::transform(surfaces_, bears.begin(), &Surface::pressed);
  return shares(force_n, bears);
}

Vector3 SlaveContact::shares(const Vector3& force_n, const std::array<bool, kSurfaces>& bears) const {
  constexpr double kRegular = 1e-9;  // normals in a plane have no shares of their own
  Matrix3 normals = Matrix3::Zero();
  for (std::size_t i = 0; i < kSurfaces; ++i) {
    if (bears[i]) normals.col(static_cast<Eigen::Index>(i)) = surfaces_[i].normal();
  }
  const Matrix3 gram = normals.transpose() * normals + kRegular * Matrix3::Identity();
  return gram.llt().solve(normals.transpose() * force_n);
}

// The waiting samples become those before the touch of the new surface, without the force of the others.
void SlaveContact::give_what_waited() {
  before_.clear();
  for (std::size_t i = 0; i < waiting_.size(); ++i) {
    TouchSample sample = waiting_[i];
    for (const Surface& s : surfaces_) {
      if (!s.pressed()) continue;
      const double borne_n = s.law_n(sample.p_WE).value_or(s.normal().dot(sample.force_n));
      sample.force_n -= borne_n * s.normal();
    }
    before_.push(sample);
  }
  waiting_.clear();
}

// Finds a force that the laws of the surfaces do not predict. On a ball the force turns with the motion, on
// another surface against it.
void SlaveContact::look_aside(const ContactInput& input) {
  turning_ = true;
  if (pressed() == 0 || pressed() == kSurfaces) return;
  const Vector3 share_n = shares(reading_.filtered_n);
  Vector3 rest = reading_.filtered_n, across = reading_.filtered_n;
  double borne_n = 0.0;
  for (std::size_t i = 0; i < kSurfaces; ++i) {
    const Surface& s = surfaces_[i];
    if (!s.pressed()) continue;
    const double share = share_n[static_cast<Eigen::Index>(i)];
    rest -= s.foreseen_n().value_or(share) * s.normal();
    across -= share * s.normal();
    borne_n += std::abs(share);
  }
  const double across_n = across.stableNorm();
  if (across_n < kOnsetShare * sensing_.touch_n + kUnknown * surfaces_[foremost_].normal_sd() * borne_n) {
    aside_ = {input.p_WE};
    for (Surface& s : surfaces_) s.mark();
    return;
  }
  const double way_m = -across.dot(input.p_WE - aside_.p_WE) / across_n;
  if (way_m <= 0.0) return;
  turning_ = false;
  // The tool moves past it: the zero of the sensor has changed.
  if (way_m < kTowards * (input.p_WE - aside_.p_WE).norm()) return;
  if (across_n <= reading_.touch_n || across_n < kAcross * rest.stableNorm()) return;
  const double share = across_n / borne_n;
  const bool judged = aside_.way_m > 0.0, further = way_m > std::max(kStickM, 2.0 * aside_.way_m);
  if (share > kFriction || (judged && further && share > kGrown * aside_.share)) {
    for (Surface& s : surfaces_) s.straighten(aside_.p_WE);
    give_what_waited();
    return begin(input, rest, aside_.p_WE);
  }
  if (further) aside_.way_m = way_m, aside_.share = share;
}

double SlaveContact::borne_n(std::size_t surface) const {
  std::array<bool, kSurfaces> bears{};
  std::ranges::transform(surfaces_, bears.begin(), &Surface::pressed);
  bears[surface] = true;
  return shares(reading_.filtered_n, bears)[static_cast<Eigen::Index>(surface)];
}

}  // namespace longreach
