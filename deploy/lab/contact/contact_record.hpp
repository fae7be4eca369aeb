#pragma once
// Synthetic recordings of a Hunt-Crossley contact with white noise on the force (2 s at 1 kHz, 10 N at the
// maximum depth), and the Cramér-Rao bound for estimates from one recording. The contact law is implemented
// here independently of the production code.

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <vector>

#include "common/core/random.hpp"
#include "slave/estimation/contact_fit.hpp"

namespace longreach::test {

using Samples = std::vector<PenetrationSample>;

enum class Excitation { kProbe, kTouchCycles, kSine };

struct ContactCell {
  double k = 1e4;  // N/mⁿ
  double n = 1.5;
  double a = 0.15;        // λ/k, s/m
  double noise_n = 0.05;  // standard deviation
  Excitation excitation = Excitation::kProbe;

  [[nodiscard]] double lambda() const { return a * k; }
  [[nodiscard]] double deepest_m() const { return std::pow(10.0 / k, 1.0 / n); }
  [[nodiscard]] double force(double x, double v) const {
    return x > 0.0 ? k * std::pow(x, n) * (1.0 + a * v) : 0.0;
  }
};

/// Returns the depth relative to the maximum depth, and its derivative in 1/s. The force of the returned
/// sample is 0.
inline PenetrationSample motion(Excitation excitation, double t) {
  constexpr double w = 2.0 * std::numbers::pi;
  switch (excitation) {
    case Excitation::kProbe:
      return {0.6 + 0.25 * std::sin(1.3 * w * t - 1.2) + 0.15 * std::sin(3.1 * w * t),
              0.25 * 1.3 * w * std::cos(1.3 * w * t - 1.2) + 0.15 * 3.1 * w * std::cos(3.1 * w * t), 0.0};
    case Excitation::kTouchCycles:
      return {0.4 - 0.6 * std::cos(1.5 * w * t), 0.6 * 1.5 * w * std::sin(1.5 * w * t), 0.0};
    case Excitation::kSine:
      break;
  }
  return {0.5 + 0.45 * std::sin(w * t), 0.45 * w * std::cos(w * t), 0.0};
}

inline Samples exact_record(const ContactCell& cell, double seconds = 2.0) {
  Samples record;
  for (int i = 0; i < static_cast<int>(seconds * 1e3); ++i) {
    PenetrationSample sample = motion(cell.excitation, 1e-3 * i);
    sample.x_m *= cell.deepest_m();
    sample.v_m_per_s *= cell.deepest_m();
    sample.force_n = cell.force(sample.x_m, sample.v_m_per_s);
    record.push_back(sample);
  }
  return record;
}

inline Samples with_noise(Samples record, double sd_n, Random& random) {
  for (PenetrationSample& sample : record) sample.force_n += sd_n * random.normal();
  return record;
}

/// Minimum standard deviation of any unbiased estimator if the surface is known: absolute for n, relative for
/// the other parameters. `stiffness` is the tangent stiffness at the maximum depth.
struct ContactBound {
  double k = 0.0, lambda = 0.0, n = 0.0, stiffness = 0.0;
};

inline ContactBound cramer_rao(const ContactCell& cell, const Samples& exact) {
  /// Information matrix of (ln of the maximum force, n, a times the maximum depth).
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  const double deepest = cell.deepest_m();
  for (const PenetrationSample& s : exact) {
    if (!(s.x_m > 0.0)) continue;
    const double elastic = cell.k * std::pow(s.x_m, cell.n);
    const Eigen::Vector3d h(s.force_n, s.force_n * std::log(s.x_m / deepest),
                            elastic * s.v_m_per_s / deepest);
    A += h * h.transpose() / (cell.noise_n * cell.noise_n);
  }
  const Eigen::Matrix3d C = A.inverse();
  const auto sd = [&](const Eigen::Vector3d& h) { return std::sqrt(h.dot(C * h)); };
  const double to_metre = -std::log(deepest);
  return {sd({1.0, to_metre, 0.0}), sd({1.0, to_metre, 1.0 / (cell.a * deepest)}), sd({0.0, 1.0, 0.0}),
          sd({1.0, 1.0 / cell.n, 0.0})};
}

}  // namespace longreach::test
