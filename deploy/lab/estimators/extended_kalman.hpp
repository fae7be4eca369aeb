#pragma once
// Extended Kalman filter for (ln f, n, a) of F = f ξⁿ (1 + a v), initialised by weighted_log_linear.hpp:
//   H = (F̂, F̂ ln ξ, f ξⁿ v),  s = H P Hᵀ,  K = P Hᵀ/(s + s²/F̂² + σ²),  θ ← θ + K (F - F̂),  P ← P - K H P
// Published: the extended Kalman filter for the parameters k, λ and n of this law (Zhu, Gao, Zhong, Gu and
// Choi, J. Mech. Behav. Biomed. Mater. 2021). Added: (1) the logarithm and a normalised depth, because in
// units of N/mⁿ and metres the error of the filter is 98 % for k above 1e5; (2) the initialisation, so that
// the law is approximately linear around the initial values; (3) the term s²/F̂², which models the
// linearisation error as noise (the second-order filter uses half of this term: Bar-Shalom, Li and
// Kirubarajan, Estimation with Applications to Tracking and Navigation). Without (3), the filter diverges
// where a v is about 1.

#include "deploy/lab/estimators/weighted_log_linear.hpp"

namespace longreach {

class ExtendedKalman {
 public:
  explicit ExtendedKalman(double forgetting) : forgetting_(forgetting), start_(forgetting) {}

  void reset() { *this = ExtendedKalman(forgetting_); }

  /// Adds a sample, whose x_m must be > 0. Returns the force minus the predicted force, N, or NaN if there is
  /// no fit.
  double step(const PenetrationSample& sample, double force_variance_n2) {
    if (!begun_) return begin(sample, force_variance_n2);
    const double log_xi = std::log(sample.x_m / fit_.reference_m);
    const double elastic = std::exp(log_force_ + fit_.n * log_xi);
    const double foreseen = elastic * (1.0 + fit_.a_s_per_m * sample.v_m_per_s);
    const double innovation = sample.force_n - foreseen;
    const Eigen::Vector3d h(foreseen, foreseen * log_xi, elastic * sample.v_m_per_s);
    const Eigen::Vector3d Ph = P_ * h;
    const double spread = h.dot(Ph);
    const double variance = spread + spread * spread / (foreseen * foreseen) + force_variance_n2;
    const Eigen::Vector3d change = Ph * (innovation / variance);
    // The linearisation is invalid for larger steps or without a force.
    if (!(variance > 0.0 && std::abs(change[0]) < kReach && std::abs(change[1]) < kReach)) return innovation;
    P_ -= Ph * Ph.transpose() / variance;
    const bool bounded = P_(1, 1) < weak_prior::kExponentSd * weak_prior::kExponentSd &&
                         P_(2, 2) < weak_prior::kDampingSd * weak_prior::kDampingSd;
    if (forgetting_ < 1.0 && bounded) P_ /= forgetting_;
    log_force_ += change[0];
    fit_.force_n = std::exp(log_force_);
    fit_.n += change[1];
    fit_.a_s_per_m += change[2];
    fit_.covariance.topLeftCorner<3, 3>() = P_;
    return innovation;
  }
  [[nodiscard]] const ContactFit& fit() const { return fit_; }

 private:
  // The filter starts when the standard deviations of ln f, of n, and of a v at the maximum speed are below
  // these values.
  static constexpr double kForceSd = 0.05, kExponentSd = 0.2, kDampingSd = 0.2;
  static constexpr double kReach = 1.0;  // maximum change of ln f and of n per step

  double begin(const PenetrationSample& sample, double force_variance_n2) {
    const double innovation = start_.step(sample, force_variance_n2);
    speed_max_ = std::max(speed_max_, std::abs(sample.v_m_per_s));
    fit_ = start_.fit();
    P_ = fit_.covariance.topLeftCorner<3, 3>();
    log_force_ = std::log(fit_.force_n);
    begun_ = fit_.valid && start_.fresh() && P_(0, 0) < kForceSd * kForceSd &&
             P_(1, 1) < kExponentSd * kExponentSd &&
             P_(2, 2) * speed_max_ * speed_max_ < kDampingSd * kDampingSd;
    return innovation;
  }

  double forgetting_;
  WeightedLogLinear start_;
  bool begun_ = false;
  double speed_max_ = 0.0;
  double log_force_ = 0.0;  // ln f
  Eigen::Matrix3d P_ = Eigen::Matrix3d::Zero();
  ContactFit fit_{};
};

}  // namespace longreach
