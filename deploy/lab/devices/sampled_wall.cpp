#include "deploy/lab/devices/sampled_wall.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

namespace longreach {
namespace {

/// exp(A t) for [x, v, u] with constant u, by scaling and squaring of the series.
Eigen::Matrix3d held_transition(const SampledWall& w) {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  A(0, 1) = 1.0;
  A(1, 0) = -w.hand_n_per_m / w.mass_kg;
  A(1, 1) = -(w.device_n_s_per_m + w.hand_n_s_per_m) / w.mass_kg;
  A(1, 2) = 1.0 / w.mass_kg;
  const int halvings = std::max(0, std::ilogb(A.lpNorm<Eigen::Infinity>() * w.period_s) + 4);
  A *= std::ldexp(w.period_s, -halvings);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Identity(), term = sum;
  for (int i = 1; i <= 16; ++i) {
    term = term * A / i;
    sum += term;
  }
  for (int i = 0; i < halvings; ++i) sum *= sum;
  return sum;
}

}  // namespace

double spectral_radius(const SampledWall& w, double stiffness_n_per_m) {
  const Eigen::Matrix3d held = held_transition(w);
  // State: x, v, x[-1] ... x[-d-1].
  const int d = w.delay_samples, n = 3 + d;
  Eigen::VectorXd feedback = Eigen::VectorXd::Zero(n);
  const auto past = [](int samples) { return samples == 0 ? 0 : 1 + samples; };
  feedback[past(d)] -= stiffness_n_per_m + w.wall_n_s_per_m / w.period_s;
  feedback[past(d + 1)] += w.wall_n_s_per_m / w.period_s;
  Eigen::MatrixXd step = Eigen::MatrixXd::Zero(n, n);
  step.topLeftCorner<2, 2>() = held.topLeftCorner<2, 2>();
  step.topRows<2>() += held.topRightCorner<2, 1>() * feedback.transpose();
  step(2, 0) = 1.0;
  for (int i = 3; i < n; ++i) step(i, i - 1) = 1.0;
  return step.eigenvalues().cwiseAbs().maxCoeff();
}

double exact_limit_n_per_m(const SampledWall& wall) {
  double low = 0.0, high = 1.0;
  while (high < 1e9 && spectral_radius(wall, high) <= 1.0) low = std::exchange(high, 2.0 * high);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (spectral_radius(wall, middle) <= 1.0 ? low : high) = middle;
  }
  return low;
}

double formula_limit_n_per_m(const SampledWall& w) {
  return (w.device_n_s_per_m + w.hand_n_s_per_m + w.wall_n_s_per_m) /
         (0.5 * w.period_s + w.delay_samples * w.period_s);
}

double passive_limit_n_per_m(const SampledWall& w) {
  return std::max(0.0, (w.device_n_s_per_m - std::abs(w.wall_n_s_per_m)) / (0.5 * w.period_s));
}

}  // namespace longreach
