#include "slave/estimation/exponent_sums.hpp"

#include <cmath>

namespace longreach {
namespace {

constexpr double kShallow = 0.02;
constexpr double kDeep = 2.0;           // beyond it the reference follows
constexpr double kRootWeightMax = 1e6;  // then all are scaled back
constexpr double kFactorial[] = {1.0, 1.0, 2.0, 6.0, 24.0, 120.0};

constexpr double binomial(std::size_t n, std::size_t k) {
  return kFactorial[n] / (kFactorial[k] * kFactorial[n - k]);
}

// f(n) of which the derivatives are given, becomes e^(g n) f(n).
template <std::size_t N>
void multiply_by_exponential(std::array<double, N>& f, double g, double value) {
  for (std::size_t i = N; i-- > 0;) {
    double sum = 0.0;
    double power = 1.0;
    for (std::size_t k = 0; k <= i; ++k, power *= g) sum += binomial(i, k) * power * f[i - k];
    f[i] = value * sum;
  }
}

template <std::size_t N>
std::array<double, N> shifted(const std::array<double, N>& f, double delta) {
  std::array<double, N> result = f;
  double factor = 1.0;
  for (std::size_t k = 1; k < N; ++k) {
    factor *= delta / static_cast<double>(k);
    for (std::size_t i = 0; i + k < N; ++i) result[i] += factor * f[i + k];
  }
  return result;
}

using Weights = std::array<std::array<double, ExponentGrid::kNodes>, 6>;  // [order][node]

// Lagrange's polynomials for evenly spaced nodes and their derivatives, as products from the left and from
// the right: nothing is divided by a distance from a node.
Weights lagrange(double n, std::size_t order) {
  constexpr std::size_t kLast = ExponentGrid::kNodes - 1;
  const double s = (n - ExponentGrid::node(0)) / ExponentGrid::kSpacing;
  Weights left{}, right{}, result{};
  left[0][0] = right[0][kLast] = 1.0;
  for (std::size_t j = 1; j <= kLast; ++j) {
    const double share = 1.0 / static_cast<double>(j);
    const double from_left = (s - static_cast<double>(j - 1)) * share;
    const std::size_t i = kLast - j;
    const double from_right = (static_cast<double>(i + 1) - s) * share;
    for (std::size_t d = 0; d <= order; ++d) {
      const double times = static_cast<double>(d) * share;
      left[d][j] = left[d][j - 1] * from_left + (d > 0 ? times * left[d - 1][j - 1] : 0.0);
      right[d][i] = right[d][i + 1] * from_right - (d > 0 ? times * right[d - 1][i + 1] : 0.0);
    }
  }
  double scale = 1.0;
  for (std::size_t d = 0; d <= order; ++d, scale /= ExponentGrid::kSpacing) {
    for (std::size_t k = 0; k <= d; ++k) {
      const double factor = scale * binomial(d, k);
      for (std::size_t j = 0; j <= kLast; ++j) result[d][j] += factor * left[k][j] * right[d - k][j];
    }
  }
  return result;
}

template <std::size_t N>
double dot(const std::array<double, N>& a, const std::array<double, N>& b) {
  double sum = 0.0;
  for (std::size_t j = 0; j < N; ++j) sum += a[j] * b[j];
  return sum;
}

}  // namespace

SampleScale::Change SampleScale::step(const PenetrationSample& sample, double forgetting) {
  Change change;
  if (reference_m_ <= 0.0) reference_m_ = sample.x_m;
  if (sample.x_m > kDeep * reference_m_) {
    change.log_ratio = std::log(reference_m_ / sample.x_m);
    reference_m_ = sample.x_m;
  }
  const double xi = sample.x_m / reference_m_;
  change.counts = xi >= kShallow;
  if (!change.counts) return change;
  if (forgetting < 1.0) root_weight_ /= std::sqrt(forgetting);
  if (root_weight_ > kRootWeightMax) {
    change.weight_ratio = 1.0 / (root_weight_ * root_weight_);
    root_weight_ = 1.0;
  }
  change.sample = {std::log(xi), sample.v_m_per_s, root_weight_ * sample.force_n, root_weight_};
  return change;
}

void ExponentGrid::add(const WeighedSample& sample) {
  const double ratio = std::exp(kSpacing * sample.log_depth);
  double p = sample.root_weight * std::exp(node(0) * sample.log_depth);
  const double v = sample.v_m_per_s;
  for (std::size_t j = 0; j < kNodes; ++j, p *= ratio) {
    S_[0][j] += p * p;
    S_[1][j] += p * p * v;
    S_[2][j] += p * p * v * v;
    R_[0][j] += p * sample.force_n;
    R_[1][j] += p * sample.force_n * v;
  }
}

void ExponentGrid::rescale(double log_ratio, double weight_ratio) {
  for (std::size_t j = 0; j < kNodes; ++j) {
    const double factor = std::exp(node(j) * log_ratio);
    for (Nodes& S : S_) S[j] *= weight_ratio * factor * factor;
    for (Nodes& R : R_) R[j] *= weight_ratio * factor;
  }
}

ExponentSums ExponentGrid::at(double n, std::size_t order) const {
  const Weights weights = lagrange(n, order);
  ExponentSums sums;
  for (std::size_t d = 0; d <= order; ++d) {
    for (std::size_t p = 0; p < 3; ++p) sums.S[p][d] = dot(weights[d], S_[p]);
    for (std::size_t p = 0; p < 2 && d < 4; ++p) sums.R[p][d] = dot(weights[d], R_[p]);
  }
  return sums;
}

ExponentSums ExponentGrid::at_node(std::size_t j) const {
  ExponentSums sums;
  for (std::size_t p = 0; p < 3; ++p) sums.S[p][0] = S_[p][j];
  for (std::size_t p = 0; p < 2; ++p) sums.R[p][0] = R_[p][j];
  return sums;
}

double ExponentSeries::add(const WeighedSample& sample, double n) {
  const double p = sample.root_weight * std::exp(n0_ * sample.log_depth);
  const double v = sample.v_m_per_s;
  const double d = sample.log_depth;
  const double pp = p * p, pf = p * sample.force_n;
  const double e = 2.0 * d, ee = e * e;
  const Eigen::Array<double, 6, 1> powers(1.0, e, ee, e * ee, ee * ee, e * (ee * ee));
  const Eigen::Array4d roots(1.0, d, d * d, d * d * d);
  using S = Eigen::Map<Eigen::Array<double, 6, 1>, Eigen::Aligned16>;
  using R = Eigen::Map<Eigen::Array4d, Eigen::Aligned16>;
  S(sums_.S[0].data()) += pp * powers;
  S(sums_.S[1].data()) += (pp * v) * powers;
  S(sums_.S[2].data()) += (pp * v * v) * powers;
  R(sums_.R[0].data()) += pf * roots;
  R(sums_.R[1].data()) += (pf * v) * roots;
  const double z = (n - n0_) * d;
  return p / sample.root_weight * (1.0 + z * (1.0 + z * (0.5 + z / 6.0)));
}

void ExponentSeries::rescale(double log_ratio, double weight_ratio) {
  const double factor = std::exp(n0_ * log_ratio);
  for (auto& S : sums_.S) multiply_by_exponential(S, 2.0 * log_ratio, weight_ratio * factor * factor);
  for (auto& R : sums_.R) multiply_by_exponential(R, log_ratio, weight_ratio * factor);
}

ExponentSums ExponentSeries::at(double n) const {
  const double delta = n - n0_;
  ExponentSums sums;
  for (std::size_t p = 0; p < 3; ++p) sums.S[p] = shifted(sums_.S[p], delta);
  for (std::size_t p = 0; p < 2; ++p) sums.R[p] = shifted(sums_.R[p], delta);
  return sums;
}

}  // namespace longreach
