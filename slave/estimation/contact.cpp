#include "slave/estimation/contact.hpp"

#include <algorithm>
#include <cmath>

namespace longreach {
namespace {

constexpr double kSupposedM = 2e-3;    // motion within which a contact is supposed
constexpr double kUnchanged = 2.0;     // touch thresholds by which the force should have changed
constexpr std::size_t kBefore = 256;   // samples before the touch that are kept, enough for a slow touch
constexpr double kBeside = 0.5;        // cosine, 60 degrees: the same object, measured differently
constexpr double kSamePlace_m = 3e-3;  // a touch this far in front of a surface may be of the same object
constexpr double kOtherSide = 0.8;     // cosine, 37 degrees: more than friction turns a force
constexpr double kProofForce = 2.0;  // touch thresholds: a force of the reported line that would be measured
constexpr double kCreepM = 3e-4, kCreep_s = 0.3;  // the tool rests or creeps
constexpr double kResolved = 10.0;  // standard deviations of a mean, whose samples may depend on each other

}  // namespace

SensingConfig rotational(SensingConfig s) {
  s.force_noise_n = s.moment_noise_nm;
  s.touch_n = s.touch_nm;
  s.release_n = s.release_nm;
  return s;
}

SlaveContact::SlaveContact(const SensingConfig& sensing, const EstimatorConfig& estimator)
    : sensing_(with_thresholds(sensing)),
      detector_(sensing),
      surfaces_{Surface(sensing_, estimator), Surface(sensing_, estimator), Surface(sensing_, estimator)},
      supposed_(sensing_, estimator),
      before_(kBefore),
      waiting_(kBefore) {}

void SlaveContact::configure(const SensingConfig& sensing, const EstimatorConfig& estimator) {
  const double touch_n = sensing_.touch_n, release_n = sensing_.release_n;
  sensing_ = with_thresholds(sensing);
  for (Surface& s : surfaces_) s.configure(sensing_, estimator);
  supposed_.configure(sensing_, estimator);
  if (!(sensing.touch_n > 0.0)) sensing_.touch_n = touch_n, sensing_.release_n = release_n;
  detector_.configure(sensing_);
}

void SlaveContact::set_thresholds(double touch_n, double release_n) {
  if (reading_.in_contact) return;
  sensing_.touch_n = touch_n;
  sensing_.release_n = release_n;
  detector_.set_thresholds(touch_n, release_n);
  for (Surface& s : surfaces_) s.set_touch(touch_n);
}

void SlaveContact::step(const ContactInput& input) {
  reading_ = detector_.step(input.force_n, input.dt, input.uncertainty_n, possible_bias_n(input));
  force_ = {};
  suppose(input);
  if (reading_.began) {
    first_touch_ = touches_ + 1;
    if (!reach_known(input, reading_.filtered_n))
      begin(input, reading_.filtered_n, onset_.value_or(input.p_WE));
  }
  if (reading_.in_contact) {
    press(input);
  } else {
    for (Surface& s : surfaces_) {
      if (s.pressed()) s.release(reading_.filtered_n.stableNorm());
    }
    before_.push({input.p_WE, input.v_WE, input.force_n});
    if (reading_.filtered_n.stableNorm() < kOnsetShare * sensing_.touch_n) onset_ = input.p_WE;
  }
  rest(input);
  forget_what_is_free(input);
}

// Identifies the surface of the contact that the force at the start may be.
void SlaveContact::suppose(const ContactInput& input) {
  const bool possible = input.bias_n.stableNorm() > sensing_.touch_n;
  if (!possible || touches_ > 0) return supposed_.forget();
  if (!supposed_from_) {
    supposed_from_ = input.p_WE;
    supposed_.begin({1, input.bias_n, input.p_WE, input.p_WE, 0.0, input.scale}, false, before_);
  }
  if ((input.p_WE - *supposed_from_).norm() > kSupposedM) supposed_.forget();
  if (!supposed_.pressed()) return;
  supposed_.turn(reading_.filtered_n, input.dt);
  supposed_.press({input.p_WE, input.v_WE, reading_.filtered_n.stableNormalized(), input.force_n, input.dt,
                   input.guarded, input.news_age_s});
}

// Returns the part of the force that may still be bias. A force that is again as at the start is that of the known
// surface, unless it remains so although the tool moves farther back.
Vector3 SlaveContact::possible_bias_n(const ContactInput& input) {
  const double stiffness = foremost().reported().stiffness_n_per_m();
  const bool known = foremost().pressed() && stiffness > 0.0;
  const bool as_at_start = (reading_.filtered_n - input.bias_n).stableNorm() <= sensing_.touch_n;
  if (!known || !as_at_start) as_at_start_m_.reset();
  if (!known) return input.bias_n;
  if (!as_at_start) return Vector3::Zero();
  if (!as_at_start_m_) as_at_start_m_ = input.p_WE;
  const double back_m = foremost().normal().dot(input.p_WE - *as_at_start_m_);
  if (stiffness * back_m > kUnchanged * sensing_.touch_n) return input.bias_n;
  return Vector3::Zero();
}

void SlaveContact::begin(const ContactInput& input, const Vector3& force_n, const Vector3& onset) {
  bool again = false;
  Surface* surface = place_for(force_n.stableNormalized(), onset, input.p_WE, again);
  if (surface == nullptr) return;
  ++touches_;
  if (supposed_.pressed()) {
    std::swap(*surface, supposed_);
  } else {
    surface->begin({touches_, force_n, input.p_WE, onset, input.played_sequence, input.scale}, again,
                   before_);
  }
  foremost_ = static_cast<std::size_t>(surface - surfaces_.data());
  before_.clear();
  waiting_.clear();
  aside_ = {input.p_WE};
  turning_ = true;
}

Surface* SlaveContact::place_for(const Vector3& normal, const Vector3& onset, const Vector3& tool,
                                 bool& again) {
  Surface* place = nullptr;
  for (Surface& s : surfaces_) {
    again = s.there() && !s.pressed() && s.crossed(normal, onset, tool);
    if (again) return &s;
  }
  // Other faces of a convex object are behind a surface of it, those of a corner are in front of it.
  for (Surface& s : surfaces_) {
    const bool behind = s.depth_of(tool) > -kSamePlace_m;
    if (s.there() && !s.pressed() && behind && s.normal().dot(normal) > kBeside) s.forget();
  }
  for (Surface& s : surfaces_) {
    if (s.pressed()) continue;
    if (!s.there()) return &s;
    if (place == nullptr || s.touch() < place->touch()) place = &s;  // the one that was left first
  }
  return place;
}

void SlaveContact::press(const ContactInput& input) {
  reach_known(input, reading_.filtered_n);
  if (pressed() > 1) {
    press_several(input);
  } else {
    for (Surface& s : surfaces_) {
      if (!s.pressed()) continue;
      if (s.normal().dot(reading_.filtered_n) < 0.0) {  // the tool touches from the other side
        s.release(reading_.filtered_n.stableNorm());
        begin(input, reading_.filtered_n, input.p_WE);
        break;
      }
      if (turning_) s.turn(reading_.filtered_n, input.dt);
      if (turning_) waiting_.clear();
      if (!turning_) waiting_.push({input.p_WE, input.v_WE, input.force_n});
      const Vector3 outward = reading_.filtered_n.stableNormalized();
      s.press({input.p_WE, input.v_WE, outward, input.force_n, input.dt, input.guarded, input.news_age_s,
               input.coming_n_per_m, touches_ == first_touch_});
    }
  }
  look_aside(input);
  // The greater of the two: the filter must not delay the guard, and a single low sample must not deceive it.
  const Vector3& normal = reading_.normal;
  force_ = {true, normal, std::max(normal.dot(input.force_n), normal.dot(reading_.filtered_n)),
            stiffness_along(normal)};
  const double whole_n = reading_.filtered_n.stableNorm();
  if (whole_n > reading_.touch_n && normal.dot(reading_.filtered_n) < kOtherSide * whole_n) {
    force_.elsewhere = reading_.filtered_n / whole_n;
    force_.elsewhere_n = whole_n;
  }
}

void SlaveContact::rest(const ContactInput& input) {
  if (reading_.in_contact || !input.force_n.allFinite() || (input.p_WE - rest_.at_m).norm() > kCreepM)
    rest_ = {input.p_WE};
  if (reading_.in_contact) return;
  rest_.sum_n += input.force_n;
  for (std::size_t i = 0; i < kSurfaces; ++i) rest_.line_n[i] += surfaces_[i].line_n(input.p_WE);
  rest_.time_s += input.dt;
  ++rest_.samples;
}

bool SlaveContact::disproved(std::size_t surface, const ContactInput& input) const {
  constexpr double kHalf = 0.5;
  if (rest_.time_s < kCreep_s) return false;
  const double bias_n = input.bias_n.stableNorm();  // the measured force may be wrong by this
  const double expected_n = rest_.line_n[surface] / rest_.samples;
  const double measured_n = surfaces_[surface].normal().dot(rest_.sum_n) / rest_.samples;
  const double resolved_n =
      kResolved * sensing_.force_noise_n / std::sqrt(rest_.samples) + input.uncertainty_n + bias_n;
  return expected_n > resolved_n && measured_n + bias_n < kHalf * expected_n;
}

// The filtered force lags behind a tool that moves fast.
void SlaveContact::forget_what_is_free(const ContactInput& input) {
  const Vector3 felt_at = input.p_WE - 2.0 * sensing_.filter_s * input.v_WE;
  const auto same = [](const Surface& one) {
    return [&one](const Surface& s) {
      return s.pressed() && s.normal().dot(one.normal()) > Surface::kSameNormal;
    };
  };
  for (std::size_t i = 0; i < kSurfaces; ++i) {
    Surface& s = surfaces_[i];
    if (!s.there() || s.pressed()) continue;
    const double depth_m = std::min(s.depth_of(felt_at), s.depth_of(input.p_WE));
    const double line_n = std::min(s.line_n(felt_at), s.line_n(input.p_WE));
    double behind_m = 0.0;  // of the tool, where the surface cannot be
    if (depth_m > s.proof_depth_m() && borne_n(i) < sensing_.touch_n) {
      behind_m = depth_m;
    } else if (disproved(i, input) ||
               (line_n > kProofForce * sensing_.touch_n && borne_n(i) < sensing_.touch_n)) {
      behind_m = s.placed_depth_m(input.p_WE);
    }
    const bool gone = behind_m > 0.0 && !s.moved_back(behind_m);
    if (behind_m > 0.0) rest_ = {input.p_WE};  // the sums were those of another place
    if (gone || std::ranges::any_of(surfaces_, same(s))) s.forget();
  }
}

std::size_t SlaveContact::pressed() const {
  return static_cast<std::size_t>(std::ranges::count_if(surfaces_, &Surface::pressed));
}

double SlaveContact::stiffness_along(const Vector3& n) const {
  double sum = 0.0;
  for (const Surface& s : surfaces_) {
    if (s.pressed()) sum += std::pow(n.dot(s.normal()), 2) * s.reported().stiffness_n_per_m();
  }
  return sum;
}

void SlaveContact::locate_touches(const Playout& playout, const Vector3& anchor, double played_sequence) {
  for (Surface& s : surfaces_) s.locate(playout, anchor, played_sequence);
}

void SlaveContact::forget_goals() {
  for (Surface& s : surfaces_) s.forget_goals();
}

void SlaveContact::forget_surfaces() {
  for (Surface& s : surfaces_) s.forget();
  supposed_.forget();
  before_.clear();
  waiting_.clear();
}

void SlaveContact::restart() {
  forget_surfaces();
  detector_ = ContactDetector(sensing_);
  reading_ = {};
  force_ = {};
  onset_.reset();
  aside_ = {};
  rest_ = {};
}

void SlaveContact::move_origin(const Vector3& by) {
  if (onset_) *onset_ -= by;
  aside_.p_WE -= by;
  rest_ = {};
  before_.clear();
  waiting_.clear();
  for (Surface& s : surfaces_) s.move_origin(by);
  supposed_.move_origin(by);
  if (supposed_from_) *supposed_from_ -= by;
  if (as_at_start_m_) *as_at_start_m_ -= by;
}

std::array<ReportedSurface, kSurfaces> SlaveContact::report(const Vector3& anchor) const {
  std::array<ReportedSurface, kSurfaces> all{};
  std::size_t count = 0;
  for (const bool pressed : {true, false}) {
    for (const Surface& s : surfaces_) {
      if (s.there() && s.pressed() == pressed) all[count++] = s.report(anchor);
    }
  }
  return all;
}

}  // namespace longreach
