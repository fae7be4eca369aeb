#include "slave/estimation/maximum_likelihood.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace longreach {
namespace {

constexpr double kPriorN = 1.75;
constexpr double kPriorNSd = 1.0;
constexpr double kPriorASd = 10.0;   // s/m
constexpr double kSettledSd = 0.1;   // of n: the best node is looked for until then
constexpr double kKnownSd = 0.06;    // of n: from then on the series, which is exact within some of them
constexpr double kConverged = 0.3;   // sd of n; a step of Newton below it
constexpr double kReach = 0.3;       // a step of Newton at most
constexpr double kOffCentre = 0.02;  // of the series: then it is moved
constexpr int kShareUnused = 32;
constexpr int kUnusedMax = 32;
constexpr int kSamplesMin = 3;

struct Linear {
  double c0 = 0.0, c1 = 0.0;
  double ridge = 0.0;  // of c1, from the prior of a
  double determinant = 0.0;
  bool valid = false;
};

Linear solve(const ExponentSums& sums, double variance) {
  Linear result;
  const double c = sums.S[0][0] > 0.0 ? sums.R[0][0] / sums.S[0][0] : 0.0;
  result.ridge = variance / (c * c * kPriorASd * kPriorASd + std::numeric_limits<double>::min());
  const double s22 = sums.S[2][0] + result.ridge;
  result.determinant = sums.S[0][0] * s22 - sums.S[1][0] * sums.S[1][0];
  result.c0 = (sums.R[0][0] * s22 - sums.R[1][0] * sums.S[1][0]) / result.determinant;
  result.c1 = (sums.R[1][0] * sums.S[0][0] - sums.R[0][0] * sums.S[1][0]) / result.determinant;
  result.valid = result.determinant > 0.0 && std::isfinite(result.c0) && std::isfinite(result.c1);
  return result;
}

double prior_cost(double n, double variance) {
  return variance * (n - kPriorN) * (n - kPriorN) / (kPriorNSd * kPriorNSd);
}

struct NewtonStep {
  bool valid = false;
  double n = 0.0;              // its change
  double c0 = 0.0, c1 = 0.0;   // after it
  Eigen::Matrix3d covariance;  // of (ln c0, n, c1/c0)
};

// With p = ξⁿ: d(c0 p + c1 p v)/dn = p ln ξ (c0 + c1 v), and S' = 2 Σ w p² ln ξ vᵖ, S'' = 4 Σ w p² ln² ξ vᵖ.
NewtonStep newton(const ExponentSums& sums, double n, double variance) {
  NewtonStep step;
  const auto& [S, R] = sums;
  const Linear linear = solve(sums, variance);
  double c0 = linear.c0, c1 = linear.c1;
  const double cross0 = 0.5 * (S[0][1] * c0 + S[1][1] * c1);
  const double cross1 = 0.5 * (S[1][1] * c0 + S[2][1] * c1);
  const double prior = variance / (kPriorNSd * kPriorNSd);
  const double own = 0.25 * (S[0][2] * c0 * c0 + 2.0 * S[1][2] * c0 * c1 + S[2][2] * c1 * c1) + prior;
  const double score = R[0][1] * c0 + R[1][1] * c1 - cross0 * c0 - cross1 * c1 - prior * (n - kPriorN);
  const double s22 = S[2][0] + linear.ridge;
  const double y0 = (cross0 * s22 - cross1 * S[1][0]) / linear.determinant;
  const double y1 = (cross1 * S[0][0] - cross0 * S[1][0]) / linear.determinant;
  const double information = own - cross0 * y0 - cross1 * y1;  // about n, with c0 and c1 free
  if (!linear.valid || !(information > 0.0)) return step;
  const double lowest = ExponentGrid::node(0), highest = ExponentGrid::node(ExponentGrid::kNodes - 1);
  step.n = std::clamp(n + std::clamp(score / information, -kReach, kReach), lowest, highest) - n;
  step.c0 = c0 = c0 - y0 * step.n;
  step.c1 = c1 = c1 - y1 * step.n;

  // Of (ln c0, n, a = c1/c0): J C Jᵀ with C of (c0, n, c1).
  const double var_n = variance / information;
  const double v = variance / linear.determinant;
  const double a = c1 / c0, per_c0 = 1.0 / c0;
  const double C00 = v * s22 + y0 * y0 * var_n, C02 = -v * S[1][0] + y0 * y1 * var_n;
  const double C22 = v * S[0][0] + y1 * y1 * var_n;
  const double slope = y1 - a * y0;  // of a by n, times -c0
  Eigen::Matrix3d& P = step.covariance;
  P(0, 0) = C00 * per_c0 * per_c0;
  P(1, 1) = var_n;
  P(2, 2) = (C22 - 2.0 * a * C02 + a * a * C00) * per_c0 * per_c0;
  P(0, 1) = P(1, 0) = -y0 * var_n * per_c0;
  P(1, 2) = P(2, 1) = -slope * var_n * per_c0;
  P(0, 2) = P(2, 0) = (C02 - a * C00) * per_c0 * per_c0;
  step.valid = c0 > 0.0 && P.allFinite();
  return step;
}

}  // namespace

double MaximumLikelihood::step(const PenetrationSample& sample, double force_variance_n2) {
  const SampleScale::Change change = scale_.step(sample, forgetting_);
  if (change.log_ratio != 0.0 || change.weight_ratio != 1.0) {
    known_ ? series_.rescale(change.log_ratio, change.weight_ratio)
           : grid_.rescale(change.log_ratio, change.weight_ratio);
    if (fit_.valid) refresh(force_variance_n2);  // the fit is told at the reference
  }
  double innovation = std::nan("");
  if (known_ && change.counts) {
    const double power = series_.add(change.sample, n_);
    innovation = sample.force_n - fit_.force_n * power * (1.0 + fit_.a_s_per_m * sample.v_m_per_s);
  } else {
    if (fit_.valid) innovation = sample.force_n - fit_.force_at(sample);
    if (!change.counts) return innovation;
    grid_.add(change.sample);
  }
  samples_ = std::min(samples_ + 1, kShareUnused * kUnusedMax);
  if (++unused_ * kShareUnused >= samples_ && samples_ >= kSamplesMin) refresh(force_variance_n2);
  return innovation;
}

void MaximumLikelihood::search(double variance) {
  double least = std::numeric_limits<double>::infinity();
  double best = n_;
  for (std::size_t j = 0; j < ExponentGrid::kNodes; ++j) {
    const ExponentSums sums = grid_.at_node(j);
    const Linear linear = solve(sums, variance);
    const double cost =
        prior_cost(ExponentGrid::node(j), variance) - linear.c0 * sums.R[0][0] - linear.c1 * sums.R[1][0];
    if (!linear.valid || !(cost < least)) continue;
    least = cost;
    best = ExponentGrid::node(j);
  }
  if (std::abs(best - n_) > 0.6 * ExponentGrid::kSpacing) n_ = best;
}

void MaximumLikelihood::refresh(double force_variance_n2) {
  unused_ = 0;
  const double variance = force_variance_n2 * scale_.weight();
  const bool settled = fit_.valid && fit_.covariance(1, 1) < kSettledSd * kSettledSd;
  if (!known_ && !settled) search(variance);
  const NewtonStep step = newton(known_ ? series_.at(n_) : grid_.at(n_, 2), n_, variance);
  fit_.valid = step.valid;
  if (!step.valid) return;
  n_ += step.n;
  fit_.reference_m = scale_.reference_m();
  fit_.force_n = step.c0;
  fit_.n = n_;
  fit_.a_s_per_m = step.c1 / step.c0;
  fit_.covariance.topLeftCorner<3, 3>() = step.covariance;

  const double sd = std::sqrt(fit_.covariance(1, 1));
  if (!known_ && sd < kKnownSd && std::abs(step.n) < kConverged * sd) {
    series_ = ExponentSeries(grid_.at(n_, 5), n_);
    known_ = true;
  } else if (known_ && std::abs(n_ - series_.n0()) > kOffCentre) {
    series_ = ExponentSeries(series_.at(n_), n_);
  }
}

}  // namespace longreach
