#include "slave/contact.hpp"

#include <algorithm>
#include <cmath>

namespace longreach {
namespace {

constexpr double kOnsetShare = 0.25;   // of the touch threshold: the force has left the noise
constexpr double kSamePlaceM = 0.003;  // the surface that was met before is met again
constexpr double kSameNormal = 0.9;
constexpr double kHistoryGoals = 4000.0;  // that the playout surely still has (it keeps 8192)
constexpr double kStepMaxM = 1.0;         // between two samples; more, or none, is no measurement
constexpr std::size_t kBefore = 64;       // samples before the touch that are kept
constexpr double kValidSd = 0.5;          // fraction

WatchedIdentifier identifier(const EstimatorConfig& c, const SensingConfig& sensing) {
  return WatchedIdentifier({c.kind, c.exponent, c.forgetting, sensing.force_noise_n, 0.0, false});
}

}  // namespace

SensingConfig rotational(SensingConfig s) {
  s.force_noise_n = s.moment_noise_nm;
  s.touch_n = s.touch_nm;
  s.release_n = s.release_nm;
  return s;
}

EstimatorConfig rotational(EstimatorConfig e) {
  e.working_force_n = e.working_moment_nm;
  return e;
}

SlaveContact::SlaveContact(const SensingConfig& sensing, const EstimatorConfig& estimator)
    : sensing_(sensing),
      estimator_(estimator),
      detector_(sensing),
      identifier_(identifier(estimator, sensing)),
      reported_(estimator),
      before_(kBefore) {}

void SlaveContact::configure(const SensingConfig& sensing, const EstimatorConfig& estimator) {
  const bool other = estimator.kind != estimator_.kind || estimator.exponent != estimator_.exponent ||
                     estimator.forgetting != estimator_.forgetting;
  if (other) identifier_ = identifier(estimator, sensing);
  sensing_ = sensing;
  estimator_ = estimator;
  detector_.configure(sensing);
  reported_.configure(estimator);
}

void SlaveContact::step(const ContactInput& input) {
  reading_ = detector_.step(input.force_n, input.dt, input.doubt_n);
  if (reading_.began) begin(input);
  force_ = {};
  penetration_m_ = 0.0;
  if (reading_.in_contact) {
    identify(input);
    return;
  }
  answer_ = {};
  before_.push({input.p_WE, input.v_WE, input.force_n});
  if (reading_.filtered_n.stableNorm() < kOnsetShare * sensing_.touch_n) onset_m_ = input.p_WE;
}

void SlaveContact::begin(const ContactInput& input) {
  ++touch_;
  const bool again = known_ && reading_.normal.dot(known_normal_) > kSameNormal &&
                     std::abs(known_normal_.dot(onset_m_ - known_point_m_)) < kSamePlaceM;
  known_ = again;
  identifier_.begin();
  working_.begin();
  working_force_n_ = input.scale * estimator_.working_force_n;
  reported_.begin(again);
  if (!again) stiffness_.setZero();
  tool_m_ = input.p_WE;
  inward_m_ = 0.0;
  surface_m_ = -reading_.normal.dot((known_ ? known_point_m_ : onset_m_) - tool_m_);
  // As far in front of the onset as the tool is behind it.
  const double first_m = -2.0 * reading_.normal.dot(onset_m_ - tool_m_);
  for (std::size_t i = 0; i < before_.size(); ++i) {
    const Before& at = before_[i];
    const double x_m = -reading_.normal.dot(at.p_WE - tool_m_);
    if (x_m >= first_m) {
      identifier_.step({x_m, -reading_.normal.dot(at.v_WE), reading_.normal.dot(at.force_n)}, 0.0);
    }
  }
  before_.clear();
  played_at_touch_ = input.played_sequence;
  touch_sequence_ = 0.0;
}

// What the tool goes against the force is depth, so that neither a slide along the surface nor its curvature
// counts as that, which a mean direction would have a long lever for.
PenetrationSample SlaveContact::sample(const ContactInput& input) {
  const Vector3 outward = reading_.filtered_n.stableNormalized();
  const double out_m = outward.dot(input.p_WE - tool_m_);
  const bool possible = std::abs(out_m) < kStepMaxM;
  if (possible) {
    inward_m_ -= out_m;
    tool_m_ = input.p_WE;
  }
  return {possible ? inward_m_ : std::nan(""), -outward.dot(input.v_WE), outward.dot(input.force_n)};
}

void SlaveContact::identify(const ContactInput& input) {
  const Vector3& normal = reading_.normal;
  const PenetrationSample s = sample(input);
  identifier_.step(s, input.dt);
  answer_ = identifier_.answer();
  if (answer_.changes != changes_) working_.begin();
  changes_ = answer_.changes;
  const double working_m = identifier_.told().depth_of(working_force_n_);
  ContactAnswer told = identifier_.told().answer_at(working_.depth_m(working_m));
  // Another object under the tool: rather than to extrapolate far, the nearest depth that was visited.
  if (changes_ > 0 && told.valid && !well_known(told))
    told = identifier_.told().answer_at(identifier_.told().visited(told.depth_m));
  // A depth at which the guard holds the tool is not the operator's choice.
  if (well_known(told) && !input.guarded) {
    working_.follow(working_m, inward_m_ - told.surface.value, estimator_.depth_filter_s, input.dt);
  }
  if (reported_.step(told, normal)) {
    stiffness_ = reported_.stiffness_n_per_m() * normal * normal.transpose();
    reported_at_m_ = tool_m_ + (inward_m_ - answer_.surface.value - reported_.depth_m()) * normal;
  }
  if (well_known(answer_)) {
    known_ = true;
    known_normal_ = normal;
    surface_m_ = answer_.surface.value;
    known_point_m_ = surface_point();
  }
  penetration_m_ = std::max(inward_m_ - surface_m_, 0.0);
  // The greater of both: the guard shall neither be late by the filter nor be fooled by one low sample.
  force_ = {true, normal, std::max(s.force_n, normal.dot(reading_.filtered_n)),
            reported_.stiffness_n_per_m()};
}

void SlaveContact::move_origin(const Vector3& by) {
  for (Vector3* place : {&onset_m_, &known_point_m_, &tool_m_, &reported_at_m_}) *place -= by;
  before_.clear();
}

bool SlaveContact::well_known(const ContactAnswer& a) const {
  return a.valid && a.stiffness.sd < estimator_.first_sd * a.stiffness.value;
}

void SlaveContact::locate_touch(const Playout& playout, const Vector3& anchor_m, double played_sequence) {
  if (!reading_.in_contact) return;
  if (played_at_touch_ <= 0.0) {  // older than the goals: it is felt from the first of them on
    if (touch_sequence_ <= 0.0) touch_sequence_ = std::max(played_sequence, 0.0);
    return;
  }
  if (played_sequence - played_at_touch_ > kHistoryGoals) return;
  const auto crossing = playout.crossing(-reading_.normal, surface_point() - anchor_m, played_at_touch_);
  if (crossing) touch_sequence_ = *crossing;
}

ContactEstimate SlaveContact::estimate() const {
  ContactEstimate result;
  if (!reading_.in_contact) return result;
  const ContactAnswer& a = answer_;
  result.valid = a.valid && a.stiffness.sd < kValidSd * a.stiffness.value;
  if (!result.valid) return result;
  result.stiffness_n_per_m = a.stiffness.value;
  result.stiffness_sd_n_per_m = a.stiffness.sd;
  result.secant_n_per_m = a.secant.value;
  result.k = a.k.value;
  result.lambda = a.lambda.value;
  result.n = a.n.value;
  result.k_sd = a.k.sd;
  result.lambda_sd = a.lambda.sd;
  result.n_sd = a.n.sd;
  result.correlation = a.correlation;
  result.stiffness_verdict = a.stiffness.verdict;
  result.k_verdict = a.k.verdict;
  result.lambda_verdict = a.lambda.verdict;
  result.n_verdict = a.n.verdict;
  result.depth_m = a.depth_m;
  return result;
}

ContactStiffness SlaveContact::report() const {
  ContactStiffness result;
  result.touch = touch_;
  result.touch_sequence = touch_sequence_;
  result.in_contact = reading_.in_contact;
  if (reading_.in_contact) {
    result.stiffness = stiffness_;
    result.proof_depth = proof_depth_m();
  }
  return result;
}

// Of the law F = k xⁿ, where it is known.
double SlaveContact::proof_depth_m() const {
  constexpr double kTwice = 2.0, kMost = 0.1;
  if (!(answer_.valid && answer_.k.value > 0.0 && answer_.n.value > 0.0)) return 0.0;
  return std::min(std::pow(kTwice * sensing_.touch_n / answer_.k.value, 1.0 / answer_.n.value), kMost);
}

}  // namespace longreach
