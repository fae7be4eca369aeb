#include "master/devices/spherical/octic_roots.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>
#include <numbers>

namespace longreach {
namespace {

constexpr int kHalfDegree = 4;
constexpr int kPowers = 2 * kHalfDegree + 1;
using Octic = std::array<double, kPowers>;
using Matrix8 = Eigen::Matrix<double, 8, 8>;

/// Coefficients in t of cos kχ (1 + t²)^4 and sin kχ (1 + t²)^4: real and imaginary parts of (1 + it)^(4+k)
/// (1 - it)^(4-k).
struct HalfAngle {
  std::array<Octic, kHalfDegree + 1> cosine{}, sine{};
};

HalfAngle half_angle() {
  HalfAngle table;
  for (std::size_t k = 0; k <= kHalfDegree; ++k) {
    std::array<std::complex<double>, kPowers> product{1.0};
    for (std::size_t n = 0; n + 1 < kPowers; ++n) {
      const std::complex<double> factor(0.0, n < kHalfDegree + k ? 1.0 : -1.0);
      for (std::size_t p = n + 1; p > 0; --p) product[p] += factor * product[p - 1];
    }
    for (std::size_t p = 0; p < kPowers; ++p) {
      table.cosine[k][p] = product[p].real();
      table.sine[k][p] = product[p].imag();
    }
  }
  return table;
}

const HalfAngle kHalfAngle = half_angle();

/// Discrete Fourier transform of the samples relative to the angle `origin`, rad, collected in powers of t.
Octic octic(const std::array<double, OcticRoots::kSamples>& F, double origin) {
  constexpr std::size_t n = OcticRoots::kSamples;
  Octic result{};
  for (std::size_t k = 0; k <= kHalfDegree; ++k) {
    double a = 0.0, b = 0.0;
    for (std::size_t j = 0; j < n; ++j) {
      const double angle = 2.0 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(n) - origin;
      a += F[j] * std::cos(static_cast<double>(k) * angle);
      b += F[j] * std::sin(static_cast<double>(k) * angle);
    }
    const double weight = (k == 0 ? 1.0 : 2.0) / static_cast<double>(n);
    for (std::size_t p = 0; p < kPowers; ++p)
      result[p] += weight * (a * kHalfAngle.cosine[k][p] + b * kHalfAngle.sine[k][p]);
  }
  return result;
}

Matrix8 companion(const Octic& p) {
  Matrix8 result = Matrix8::Zero();
  for (int i = 0; i < 8; ++i) {
    result(i, 7) = -p[static_cast<std::size_t>(i)] / p[8];
    if (i > 0) result(i, i - 1) = 1.0;
  }
  return result;
}

// The QR iteration stagnates for some symmetric sets of double roots. Another origin breaks the symmetry.
constexpr std::array<double, 4> kTurns{0.03, 0.11, -0.07, 0.17};

}  // namespace

OcticRoots octic_roots(const std::array<double, OcticRoots::kSamples>& F, double scale) {
  constexpr std::size_t n = OcticRoots::kSamples;
  OcticRoots result;
  std::size_t largest = 0;
  for (std::size_t j = 1; j < n; ++j) {
    if (std::abs(F[j]) > std::abs(F[largest])) largest = j;
  }
  if (!(std::abs(F[largest]) > 1e-13 * scale)) {
    result.outcome = OcticRoots::Outcome::kVanishes;
    return result;
  }
  result.outcome = OcticRoots::Outcome::kNotConverged;
  for (const double turn : kTurns) {
    const double origin = 2.0 * std::numbers::pi * static_cast<double>(largest) / static_cast<double>(n) +
                          std::numbers::pi + turn;
    const Eigen::EigenSolver<Matrix8> solver(companion(octic(F, origin)), false);
    if (solver.info() != Eigen::Success) continue;
    result.outcome = OcticRoots::Outcome::kFound;
    for (int i = 0; i < 8; ++i) {
      const std::complex<double> t = solver.eigenvalues()[i];
      if (2.0 * std::abs(t.imag()) > kBeside * (1.0 + std::norm(t))) continue;
      result.phi_rad[static_cast<std::size_t>(result.count++)] = origin + 2.0 * std::atan(t.real());
    }
    break;
  }
  return result;
}

}  // namespace longreach
