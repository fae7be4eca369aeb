#include "slave/sensing/load_identifier.hpp"

#include <algorithm>
#include <cmath>

namespace longreach {
namespace {

constexpr double kLoadBand_s = 0.15;
constexpr double kLoadUpdate_s = 0.1;
constexpr double kLoadSettled_s = 0.3;  // after a touch, until bond and load are at rest
constexpr double kLoadFirst_s = 0.3;    // until the filtered signals are used
constexpr double kBondLag_s = 0.02;     // of the greatest load behind its bond; a lighter one follows sooner
constexpr double kUnlike = 0.03;        // of m a, that it makes of it otherwise
constexpr double kCentreMost_m = 0.5;   // of the centre of a load from the sensor
constexpr double kBias_n = 1e3, kBias_nm = 1e2;  // that a sensor may begin with
constexpr double kBiasDrift = 0.01;              // N and N m, a second: at least
constexpr double kUnmodelled = 0.3;              // of m a: by what bond and sensor do at once
constexpr double kLoadSds = 3.0;
constexpr double kKnownShare = 0.1, kNothing_kg = 0.1;

}  // namespace

LoadIdentifier::LoadIdentifier(const SensingConfig& sensing, double load_max_kg)
    : sensing_(sensing), load_max_kg_(load_max_kg) {
  covariance_.diagonal() << 0.0, Vector3::Zero(), Vector3::Constant(kBias_n * kBias_n),
      Vector3::Constant(kBias_nm * kBias_nm);
}

void LoadIdentifier::grip(bool closed) {
  if (closed == closed_) return;
  closed_ = closed;
  free_s_ = 0.0;
  state_.head<4>().setZero();
  covariance_.topRows<4>().setZero();
  covariance_.leftCols<4>().setZero();
  if (!closed) return;
  const double moment = load_max_kg_ * kCentreMost_m;
  covariance_.diagonal().head<4>() << load_max_kg_ * load_max_kg_, Vector3::Constant(moment * moment);
}

void LoadIdentifier::step(const Wrench& left, const SensorMotion& motion, bool free, double dt) {
  const Matrix3 spin = cross_matrix(motion.angular);
  const Matrix3 lever = cross_matrix(motion.angular_acceleration) + spin * spin;
  Signals now;
  now << left.force, left.moment, motion.gravity - motion.acceleration, lever.col(0), lever.col(1),
      lever.col(2);
  if (!now.allFinite() || !(dt > 0.0)) return;
  free_s_ = free ? free_s_ + dt : 0.0;
  // Nothing of the touch is in the filtered signals, which begin as means.
  const double filtered_s = std::max(free_s_ - kLoadSettled_s, dt);
  const double share = std::max(-std::expm1(-dt / kLoadBand_s), dt / filtered_s);
  first_ += share * (now - first_);
  second_ += share * (first_ - second_);
  since_s_ += dt;
  ++samples_;
  if (since_s_ < kLoadUpdate_s) return;
  const double between_s = since_s_ / samples_;
  since_s_ = 0.0;
  samples_ = 0;
  const auto drift = [](double reported) {
    return (reported * reported + kBiasDrift * kBiasDrift) * kLoadUpdate_s;
  };
  covariance_.diagonal().segment<3>(4).array() += drift(sensing_.force_drift_n);
  covariance_.diagonal().tail<3>().array() += drift(sensing_.moment_drift_nm);
  if (free_s_ > kLoadSettled_s + kLoadFirst_s)
    update({second_, (first_ - second_) / kLoadBand_s, motion.gravity, between_s});
}

void LoadIdentifier::update(const Smoothed& at) {
  const Signals &smooth = at.signals, &change = at.change;
  const Vector3 push = smooth.segment<3>(6),
                lever[] = {smooth.segment<3>(9), smooth.segment<3>(12), smooth.segment<3>(15)};
  // Mass that may be there: what a bond makes of its force is in proportion.
  const double most_kg = std::min(load_max_kg_, std::max(state_[0], 0.0) + sd_kg());
  const double lag_s = load_max_kg_ > 0.0 ? kBondLag_s * std::sqrt(most_kg / load_max_kg_) : 0.0;
  const double unlike = kUnlike * (push - at.gravity).norm() + lag_s * change.segment<3>(6).norm();
  const auto variance = [&](double noise, double by_bond) {
    return noise * noise * std::min(at.between_s / kLoadUpdate_s, 1.0) + by_bond * by_bond;
  };
  const double force_n2 = variance(sensing_.force_noise_n + sensing_.force_resolution_n, most_kg * unlike);
  // Moments of inertia are not identified: they count as noise.
  Matrix3 turns;
  turns << lever[0], lever[1], lever[2];
  const double moment_nm2 = variance(sensing_.moment_noise_nm + sensing_.moment_resolution_nm,
                                     most_kg * kCentreMost_m * (unlike + kCentreMost_m * turns.norm()));
  const Matrix3 arm = -cross_matrix(push);  // h × (g - a) = -(g - a)× h
  for (int i = 0; i < 3; ++i) {
    Row row = Row::Zero();
    row[0] = push[i];
    row.segment<3>(1) = -turns.row(i).transpose();
    row[4 + i] = 1.0;
    take(row, smooth[i], force_n2);
  }
  for (int i = 0; i < 3; ++i) {
    Row row = Row::Zero();
    row.segment<3>(1) = arm.row(i).transpose();
    row[7 + i] = 1.0;
    take(row, smooth[3 + i], moment_nm2);
  }
}

void LoadIdentifier::take(const Row& row, double value, double variance) {
  const Row spread = covariance_ * row;
  const double total = row.dot(spread) + variance;
  if (!(total > 0.0)) return;
  state_ += spread * ((value - row.dot(state_)) / total);
  covariance_ -= spread * spread.transpose() / total;
  covariance_ = 0.5 * (covariance_ + covariance_.transpose()).eval();
  covariance_.diagonal() = covariance_.diagonal().cwiseMax(0.0);
}

ToolLoadConfig LoadIdentifier::load() const {
  ToolLoadConfig load;
  const double m = std::min(state_[0], load_max_kg_);
  if (!(m > kLoadSds * sd_kg())) return load;
  load.mass_kg = m;
  load.com_m = clamp_norm(Vector3(state_.segment<3>(1) / m), kCentreMost_m);
  return load;
}

double LoadIdentifier::sd_kg() const { return std::sqrt(std::max(0.0, covariance_(0, 0))); }

bool LoadIdentifier::known() const {
  return closed_ && sd_kg() < std::max(kKnownShare * state_[0], kNothing_kg / kLoadSds);
}

bool LoadIdentifier::holds() const { return known() && load().mass_kg > kNothing_kg; }

double LoadIdentifier::bound_kg() const {
  return closed_ ? std::min(load_max_kg_, std::max(state_[0], 0.0) + kLoadSds * sd_kg()) : 0.0;
}

double LoadIdentifier::uncertainty_kg() const {
  if (!closed_) return 0.0;
  return std::min(load_max_kg_, std::hypot(kUnmodelled * load().mass_kg, kLoadSds * sd_kg()));
}

}  // namespace longreach
