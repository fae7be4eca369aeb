#include "slave/contact.hpp"

#include <algorithm>

namespace longreach {
namespace {

constexpr double kOnsetShare = 0.25;   // of the touch threshold: the force has left the noise
constexpr double kSamePlaceM = 0.003;  // the surface that was met before is met again
constexpr double kSameNormal = 0.9;
constexpr double kHistoryGoals = 4000.0;  // that the playout surely still has (it keeps 8192)

}  // namespace

SlaveContact::SlaveContact(const SensingConfig& sensing, const EstimatorConfig& estimator)
    : sensing_(sensing),
      working_force_n_(estimator.working_force_n),
      first_sd_(estimator.first_sd),
      detector_(sensing),
      estimator_(estimator, sensing.force_noise_n),
      reported_(estimator) {}

void SlaveContact::configure(const SensingConfig& sensing, const EstimatorConfig& estimator) {
  sensing_ = sensing;
  working_force_n_ = estimator.working_force_n;
  first_sd_ = estimator.first_sd;
  detector_.configure(sensing);
  estimator_.configure(estimator);
  reported_.configure(estimator);
}

void SlaveContact::step(const ContactInput& input) {
  reading_ = detector_.step(input.force_n, input.dt);
  if (reading_.began) begin(input);
  force_ = {};
  penetration_m_ = 0.0;
  if (reading_.in_contact) {
    identify(input);
  } else if (reading_.filtered_n.stableNorm() < kOnsetShare * sensing_.touch_n) {
    onset_m_ = input.p_WE;
  }
}

void SlaveContact::begin(const ContactInput& input) {
  ++touch_;
  const bool again = known_ && reading_.normal.dot(known_normal_) > kSameNormal &&
                     std::abs(known_normal_.dot(onset_m_ - known_point_m_)) < kSamePlaceM;
  known_ = again;
  estimator_.begin(input.scale * working_force_n_);
  reported_.begin(again);
  if (!again) stiffness_.setZero();
  reference_m_ = input.p_WE;
  played_at_touch_ = input.played_sequence;
  touch_sequence_ = 0.0;
}

void SlaveContact::identify(const ContactInput& input) {
  const Vector3& normal = reading_.normal;
  ContactSample sample;
  sample.x_m = -normal.dot(input.p_WE - reference_m_);
  sample.v_m_per_s = -normal.dot(input.v_WE);
  sample.force_n = normal.dot(input.force_n);
  sample.force_filtered_n = normal.dot(reading_.filtered_n);
  sample.guarded = input.guarded;
  if (reported_.step(estimator_.step(sample, input.dt), normal)) {
    stiffness_ = reported_.stiffness_n_per_m() * normal * normal.transpose();
  }
  const SecantEstimate& e = estimator_.estimate();
  if (e.valid && e.stiffness_sd_n_per_m < first_sd_ * e.stiffness_n_per_m) {
    known_ = true;
    known_normal_ = normal;
    known_point_m_ = reference_m_ - e.surface_m * normal;
  }
  penetration_m_ = std::max(sample.x_m - surface_m(), 0.0);
  // The greater of both: the guard shall neither be late by the filter nor be fooled by one low sample.
  force_ = {true, normal, std::max(sample.force_n, sample.force_filtered_n), reported_.stiffness_n_per_m()};
}

double SlaveContact::surface_m() const {
  return -reading_.normal.dot((known_ ? known_point_m_ : onset_m_) - reference_m_);
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
  const SecantEstimate& e = estimator_.estimate();
  result.n = e.n;
  result.depth_m = e.depth_m;
  result.valid = e.valid;
  if (!e.valid) return result;
  result.stiffness_n_per_m = e.stiffness_n_per_m;
  result.stiffness_sd_n_per_m = e.stiffness_sd_n_per_m;
  result.k = e.k;
  result.lambda = e.lambda;
  return result;
}

ContactStiffness SlaveContact::report() const {
  ContactStiffness result;
  result.touch = touch_;
  result.touch_sequence = touch_sequence_;
  result.in_contact = reading_.in_contact;
  if (reading_.in_contact) result.stiffness = stiffness_;
  return result;
}

}  // namespace longreach
