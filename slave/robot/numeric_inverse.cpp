#include "slave/robot/numeric_inverse.hpp"

#include <algorithm>
#include <cmath>

namespace longreach {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

// Below this share of the reach a direction counts as nearly singular and is damped.
constexpr double kSingular = 0.005;
// A step longer than this leaves the region in which the Jacobian means something.
constexpr double kStepMaxRad = 0.3;

struct Candidate {
  JointVector joint_rad;
  ToolKinematics tool;
  Vector6 error;
  double residual_m;
};

Candidate evaluate(const Kinematics& kinematics, const Pose& goal, const JointVector& joint_rad) {
  Candidate c{joint_rad, kinematics.forward_with_jacobian(joint_rad), Vector6::Zero(), 0.0};
  const double length = kinematics.reach_m();
  c.error << length * log_rotation(goal.q * c.tool.X_WE.q.conjugate()), goal.p - c.tool.X_WE.p;
  c.tool.J.topRows<3>() *= length;
  c.residual_m = c.error.norm();
  return c;
}

struct Step {
  JointVector joint_rad;
  double least_pivot;  // of JᵀJ, m²
};

// Solves A x = b for symmetric A = L D Lᵀ by elimination without pivoting, which a positive definite A does
// not need. Returns the least of D; x is meaningless unless that is positive.
double solve_symmetric(Matrix6 A, JointVector& x) {
  double least = A(0, 0);
  for (int k = 0; k < 6; ++k) {
    least = std::min(least, A(k, k));
    for (int i = k + 1; i < 6; ++i) {
      const double factor = A(i, k) / A(k, k);
      for (int j = i; j < 6; ++j) A(j, i) -= factor * A(j, k);
      x[i] -= factor * x[k];
    }
  }
  for (int k = 5; k >= 0; --k) {
    for (int i = k + 1; i < 6; ++i) x[k] -= A(i, k) * x[i];
    x[k] /= A(k, k);
  }
  return least;
}

Step damped_step(const Candidate& c, double boost, double singular_m2) {
  const JointVector gradient = c.tool.J.transpose() * c.error;
  Matrix6 normal = c.tool.J.transpose() * c.tool.J;
  const double damping = boost * c.residual_m * c.residual_m;
  normal.diagonal().array() += damping;
  JointVector step = gradient;
  const double least = std::max(solve_symmetric(normal, step) - damping, 0.0);
  if (!(least >= singular_m2)) {
    normal.diagonal().array() += 0.1 * (singular_m2 - least);
    step = gradient;
    solve_symmetric(normal, step);
  }
  const double largest = step.cwiseAbs().maxCoeff();
  if (!(largest <= kStepMaxRad)) step *= kStepMaxRad / largest;
  return {step, least};
}

}  // namespace

NumericInverse::NumericInverse(const RobotConfig& robot) : kinematics_(robot) {
  for (int i = 0; i < kMaxJoints; ++i) {
    min_rad_[i] = robot.joint[static_cast<std::size_t>(i)].min_rad;
    max_rad_[i] = robot.joint[static_cast<std::size_t>(i)].max_rad;
  }
}

InverseResult NumericInverse::solve(const Pose& X_WE_goal, const JointVector& start_rad,
                                    const InverseTolerance& tolerance) const {
  const double length = kinematics_.reach_m();
  const double singular_m2 = kSingular * kSingular * length * length;
  Candidate best = evaluate(kinematics_, X_WE_goal, start_rad);
  InverseResult result;
  if (!std::isfinite(best.residual_m)) {
    result.joint_rad = start_rad;
    result.X_WE = kinematics_.forward(start_rad);
    result.residual_m = best.residual_m;
    return result;
  }
  double boost = 1.0;
  // A loose tolerance must not freeze a slow motion: one step is made unless the start is exact.
  for (std::uint32_t i = 0; i < tolerance.iterations_max; ++i) {
    const double enough = i == 0 ? 1e-14 * length : tolerance.residual_m;
    if (best.residual_m <= enough) break;
    const Step step = damped_step(best, boost, singular_m2);
    result.conditioning = std::sqrt(step.least_pivot) / length;
    ++result.iterations;
    if (!step.joint_rad.allFinite()) break;
    const JointVector wanted = best.joint_rad + step.joint_rad;
    const JointVector allowed = wanted.cwiseMax(min_rad_).cwiseMin(max_rad_);
    result.at_joint_limit = result.at_joint_limit || allowed != wanted;
    const Candidate next = evaluate(kinematics_, X_WE_goal, allowed);
    if (next.residual_m < best.residual_m) {
      best = next;
      boost = std::max(0.1 * boost, 1.0);
    } else {
      boost = std::min(100.0 * boost, 1e12);
    }
  }
  if (result.iterations == 0) {
    result.conditioning = std::sqrt(damped_step(best, boost, singular_m2).least_pivot) / length;
  }
  result.status =
      best.residual_m <= tolerance.residual_m ? InverseStatus::kFound : InverseStatus::kNotConverged;
  result.joint_rad = best.joint_rad;
  result.X_WE = best.tool.X_WE;
  result.residual_m = best.residual_m;
  return result;
}

}  // namespace longreach
