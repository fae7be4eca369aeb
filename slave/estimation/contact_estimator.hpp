#pragma once
// Identifies a Hunt-Crossley contact F = k (x - x0)ⁿ (1 + a v) with known exponent n while the tool is in it:
// surface x0, k and a = λ/k together, so that the error of each is counted in the others. With y = F^(1/n)
// the law reads
//   y = b x + c + (a/n) y v,   b = k^(1/n),  c = -b x0        (first order in a v, exact for n = 1)
// and is fitted by recursive least squares. y is linearised about the filtered force, so that noise does not
// bias its root; the weight (dF/dy)² makes the errors those of the force again. Samples below 5 sd of the
// noise are left out. Forgetting acts only along the direction that a sample informs about (Kulhavy 1987),
//   A += (w - (1 - f)/(φᵀA⁻¹φ)) φφᵀ,
// which does not depend on units and leaves the rest untouched: a still hold forgets and winds up nothing.
// Answer: secant S = k p^(n-1), with its sd from the joint covariance and the residuals. The depth p is where
// the operator is expected to work, p = (F_w/k)^(1/n) at the working force F_w, so that the answer does not
// chase every movement; where the low-passed depth leaves p/4..4p, it is taken instead and held in the same
// way. Limits: constant speed cannot tell k and a apart (a prior of sd 10 s/m keeps it bounded and its share
// is in the sd); position noise near the depth biases the fit.

#include <Eigen/Core>
#include <cstdint>

#include "slave/estimation/estimator_config.hpp"

namespace longreach {

struct ContactSample {
  double x_m = 0.0;               // tool along the inward normal, from any fixed point near the touch
  double v_m_per_s = 0.0;         // its derivative
  double force_n = 0.0;           // measured, along the outward normal
  double force_filtered_n = 0.0;  // the same, low-passed
  bool guarded = false;           // the force guard holds the tool: this depth is not the work's
};

struct SecantEstimate {
  bool valid = false;              // the secant is known to better than 50 %; else only depth_m may be used
  double stiffness_n_per_m = 0.0;  // secant F/p at depth_m
  double stiffness_sd_n_per_m = 0.0;
  double k = 0.0;             // N/mⁿ
  double lambda = 0.0;        // N s/m^(n+1); 0 while unknown
  bool lambda_known = false;  // its sd is below half of its value
  double n = 1.0;
  double surface_m = 0.0;  // x0, on the axis of x_m
  double surface_sd_m = 0.0;
  double depth_m = 0.0;     // that the secant belongs to
  double force_sd_n = 0.0;  // of a sample, from the residuals
};

class ContactEstimator {
 public:
  ContactEstimator(const EstimatorConfig& config, double force_noise_n);

  /// The exponent is taken over at the next begin().
  void configure(const EstimatorConfig& config) { config_ = config; }

  /// A new contact: nothing of the one before is kept. `working_force_n` > 0: expected at the tool.
  void begin(double working_force_n);

  const SecantEstimate& step(const ContactSample& sample, double dt);

  [[nodiscard]] const SecantEstimate& estimate() const { return estimate_; }
  [[nodiscard]] std::uint64_t samples() const { return samples_; }
  [[nodiscard]] std::uint64_t ignored() const { return ignored_; }  // not finite, or numerically unusable

 private:
  using Matrix = Eigen::Matrix3d;
  using Vector = Eigen::Vector3d;

  bool update(const ContactSample& sample, double force_before_n, double dt);
  void answer(const ContactSample& sample, double dt);
  void choose_depth(double present_m, double dt);

  EstimatorConfig config_;
  double noise_n_;
  double n_ = 1.0;
  Matrix information_ = Matrix::Zero();  // A, in units of the force's variance
  Matrix covariance_ = Matrix::Zero();   // A⁻¹ after the last sample
  Vector theta_ = Vector::Zero();        // [b per mm; c; a/n]
  double variance_n2_ = 0.0;             // of the force, from the residuals
  double variance_weight_ = 0.0;         // samples that it stands for
  double working_force_n_ = 1.0;
  double depth_filtered_m_ = 0.0;  // 0: no depth yet
  double depth_held_m_ = 0.0;      // 0: the working depth
  double force_before_n_ = 0.0;
  std::uint64_t samples_ = 0;
  std::uint64_t ignored_ = 0;
  SecantEstimate estimate_{};
};

}  // namespace longreach
