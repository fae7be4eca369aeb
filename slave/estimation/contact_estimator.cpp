#include "slave/estimation/contact_estimator.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace longreach {
namespace {

constexpr double kLengthM = 1e-3;            // of the regressor, for the numerics only
constexpr double kDampingSd = 10.0;          // prior sd of a, s/m
constexpr double kForceFloor = 5.0;          // sd of the noise below which a sample says nothing
constexpr double kResidualSamples = 2000.0;  // memory of the residual variance
constexpr double kPriorSamples = 200.0;      // weight of the configured noise in it
constexpr double kModelSd = 1e-3;            // fraction; what the linearisation leaves
constexpr double kDepthBand = 4.0;           // about the depth of the answer
constexpr double kNoiseFloorN = 1e-4;        // keeps the prior of a alive with a perfect sensor

double power(double x, double exponent) {
  return exponent == 0.0 ? 1.0 : exponent == 1.0 ? x : std::pow(x, exponent);
}

// Inverse of a symmetric positive definite matrix, scaled to a unit diagonal first: its entries differ by
// many decades.
Eigen::Matrix3d inverse_of(const Eigen::Matrix3d& A) {
  const Eigen::Vector3d scale = A.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::Matrix3d inner = (scale.asDiagonal() * A * scale.asDiagonal()).eval().inverse();
  return scale.asDiagonal() * inner * scale.asDiagonal();
}

}  // namespace

ContactEstimator::ContactEstimator(const EstimatorConfig& config, double force_noise_n)
    : config_(config), noise_n_(std::max(force_noise_n, kNoiseFloorN)) {
  begin(1.0);
}

void ContactEstimator::begin(double working_force_n) {
  working_force_n_ = working_force_n;
  depth_filtered_m_ = depth_held_m_ = 0.0;
  n_ = config_.exponent;
  theta_.setZero();
  const double damping_sd = kDampingSd / n_;
  information_ = Vector(1e-18, 1e-12, noise_n_ * noise_n_ / (damping_sd * damping_sd)).asDiagonal();
  variance_n2_ = noise_n_ * noise_n_;
  variance_weight_ = kPriorSamples;
  force_before_n_ = 0.0;
  samples_ = 0;
  estimate_ = {};
  estimate_.n = n_;
}

const SecantEstimate& ContactEstimator::step(const ContactSample& sample, double dt) {
  const bool finite = std::isfinite(sample.x_m) && std::isfinite(sample.v_m_per_s) &&
                      std::isfinite(sample.force_n) && std::isfinite(sample.force_filtered_n);
  if (!finite) {
    ++ignored_;
    return estimate_;
  }
  // The force of the samples before this one: what shares the sample's own noise would explain it away.
  const double force_before_n = force_before_n_;
  force_before_n_ = sample.force_filtered_n;
  if (force_before_n > kForceFloor * noise_n_) {
    if (update(sample, force_before_n, dt)) {
      ++samples_;
    } else {
      ++ignored_;
    }
  }
  answer(sample, dt);
  return estimate_;
}

bool ContactEstimator::update(const ContactSample& sample, double force_before_n, double dt) {
  const double root = power(force_before_n, 1.0 / n_);
  const double slope = n_ * force_before_n / root;  // dF/dy
  const double y = root + (sample.force_n - force_before_n) / slope;
  const double weight = slope * slope;
  const Vector phi(sample.x_m / kLengthM, 1.0, root * sample.v_m_per_s);

  const Matrix covariance = inverse_of(information_);
  const Vector gain = covariance * phi;
  const double doubt = phi.dot(gain);  // variance of the predicted y over that of the force
  if (!(doubt > 0.0) || !std::isfinite(doubt) || !(weight > 0.0) || !std::isfinite(weight)) return false;

  const double forget = -std::expm1(std::log(config_.forgetting) * dt * 1e3);
  const double residual = y - phi.dot(theta_);
  const double scale = 1.0 - forget + weight * doubt;
  const Vector theta = theta_ + gain * (weight * residual / scale);
  const double share = weight - forget / doubt;
  const Matrix information = information_ + share * phi * phi.transpose();
  if (!theta.allFinite() || !information.allFinite()) return false;
  theta_ = theta;
  information_ = information;
  covariance_ = covariance - (share / scale) * gain * gain.transpose();

  const double innovation_n2 = weight * residual * residual / (1.0 + weight * doubt);
  variance_weight_ = std::min(variance_weight_ + 1.0, kResidualSamples);
  variance_n2_ += (innovation_n2 - variance_n2_) / variance_weight_;
  return true;
}

void ContactEstimator::choose_depth(double present_m, double dt) {
  const double working_m = power(working_force_n_, 1.0 / n_) / theta_[0] * kLengthM;
  const double chosen_m = depth_held_m_ > 0.0 ? depth_held_m_ : working_m;
  if (depth_filtered_m_ <= 0.0) depth_filtered_m_ = chosen_m;
  depth_filtered_m_ -=
      std::expm1(-dt / config_.depth_filter_s) * (std::max(present_m, 0.0) - depth_filtered_m_);
  const bool left = depth_filtered_m_ > kDepthBand * chosen_m || depth_filtered_m_ * kDepthBand < chosen_m;
  if (left && depth_filtered_m_ > 0.0) depth_held_m_ = depth_filtered_m_;
}

void ContactEstimator::answer(const ContactSample& sample, double dt) {
  SecantEstimate e;
  e.n = n_;
  e.force_sd_n = std::sqrt(variance_n2_);
  const Matrix covariance = covariance_ * variance_n2_;
  const double b = theta_[0];  // per mm
  const double c = theta_[1];
  if (samples_ < 3 || !(b > 0.0) || !covariance.allFinite()) {
    estimate_ = e;
    return;
  }
  e.k = power(b / kLengthM, n_);
  e.surface_m = -c / b * kLengthM;
  const Vector surface_slope(c / (b * b) * kLengthM, -kLengthM / b, 0.0);
  e.surface_sd_m = std::sqrt(std::max(surface_slope.dot(covariance * surface_slope), 0.0));
  // An error of the depth does not count: the secant is that of the depth that is told with it.
  const double fraction =
      std::sqrt(n_ * n_ * std::max(covariance(0, 0), 0.0) / (b * b) + kModelSd * kModelSd);
  e.valid = fraction < 0.5;
  if (fraction < config_.first_sd && !sample.guarded) choose_depth(sample.x_m - e.surface_m, dt);
  e.depth_m = depth_held_m_ > 0.0 ? depth_held_m_ : power(working_force_n_, 1.0 / n_) / b * kLengthM;
  e.stiffness_n_per_m = e.k * power(e.depth_m, n_ - 1.0);
  e.stiffness_sd_n_per_m = fraction * e.stiffness_n_per_m;
  e.valid = e.valid && std::isfinite(e.stiffness_n_per_m);

  const double damping_sd = std::sqrt(std::max(covariance(2, 2), 0.0));
  e.lambda_known = e.valid && damping_sd < 0.5 * std::abs(theta_[2]);
  if (e.lambda_known) e.lambda = n_ * theta_[2] * e.k;
  estimate_ = e;
}

}  // namespace longreach
