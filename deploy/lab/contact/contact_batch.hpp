#pragma once
// Maximum likelihood fit of (k, λ, n) to a whole record with Ceres Solver. No online estimator can be more
// accurate than this fit.

#include <ceres/ceres.h>

#include "deploy/lab/contact/contact_record.hpp"

namespace longreach::test {

/// Residuals of all samples in contact. The parameters are the logarithm of the maximum elastic force, n, and
/// a times the maximum depth.
class ContactResiduals : public ceres::CostFunction {
 public:
  ContactResiduals(const Samples& samples, double deepest) : deepest_(deepest) {
    for (const PenetrationSample& s : samples)
      if (s.x_m > 0.0) contact_.push_back(s);
    set_num_residuals(static_cast<int>(contact_.size()));
    mutable_parameter_block_sizes()->push_back(3);
  }
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const double* p = parameters[0];
    for (std::size_t i = 0; i < contact_.size(); ++i) {
      const PenetrationSample& s = contact_[i];
      const double log_depth = std::log(s.x_m / deepest_), speed = s.v_m_per_s / deepest_;
      const double elastic = std::exp(p[0] + p[1] * log_depth);
      const double force = elastic * (1.0 + p[2] * speed);
      residuals[i] = force - s.force_n;
      if (jacobians == nullptr || jacobians[0] == nullptr) continue;
      jacobians[0][3 * i] = force;
      jacobians[0][3 * i + 1] = force * log_depth;
      jacobians[0][3 * i + 2] = elastic * speed;
    }
    return true;
  }

 private:
  Samples contact_;
  double deepest_;
};

struct ContactBatch {
  double k = 0.0, lambda = 0.0, n = 0.0;
};

/// Fits the record. The optimisation starts at the true values, so that it converges to the global maximum.
inline ContactBatch batch_fit(const ContactCell& cell, const Samples& record) {
  double p[3] = {std::log(10.0), cell.n, cell.a * cell.deepest_m()};
  ceres::Problem problem;
  problem.AddResidualBlock(new ContactResiduals(record, cell.deepest_m()), nullptr, p);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.function_tolerance = 1e-14;
  options.parameter_tolerance = 1e-12;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  const double k = std::exp(p[0] - p[1] * std::log(cell.deepest_m()));
  return {k, k * p[2] / cell.deepest_m(), p[1]};
}

}  // namespace longreach::test
