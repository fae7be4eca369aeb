#include "deploy/lab/networks/train_perceptron.hpp"

#include <ceres/ceres.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

namespace longreach {
namespace {

constexpr int kHidden = SphericalPerceptron::kUnits;
constexpr int kWeights = 7 * kHidden + 3;  // parameters per unit: in (3), bias, out (3); then the offsets
constexpr int kBias = 3, kOut = 4;         // index within the seven parameters of a unit

/// s(z) as in spherical_network.hpp, and its slope s' = (z² - 9)² / (z² + 3)² / 9.
struct Sigmoid {
  double value, slope;
  explicit Sigmoid(double z) {
    const double zz = z * z, q = (zz - 9.0) / (zz + 3.0);
    value = z * (27.0 + zz) / (27.0 + 9.0 * zz);
    slope = q * q / 9.0;
  }
};

class Misfit : public ceres::CostFunction {
 public:
  explicit Misfit(const std::vector<PerceptronSample>& samples) : samples_(samples) {
    set_num_residuals(static_cast<int>(3 * samples.size()));
    mutable_parameter_block_sizes()->push_back(kWeights);
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    for (std::size_t k = 0; k < samples_.size(); ++k) {
      double* const rows =
          jacobians != nullptr && jacobians[0] != nullptr ? jacobians[0] + 3 * k * kWeights : nullptr;
      sample(samples_[k], parameters[0], residuals + 3 * k, rows);
    }
    return true;
  }

 private:
  static void sample(const PerceptronSample& s, const double* weights, double* residual, double* rows) {
    if (rows != nullptr) std::fill(rows, rows + 3 * kWeights, 0.0);
    for (int out = 0; out < 3; ++out) residual[out] = weights[7 * kHidden + out] - s.out[out];
    for (int u = 0; u < kHidden; ++u) {
      const double* const w = weights + 7 * u;
      const Sigmoid at(w[0] * s.in[0] + w[1] * s.in[1] + w[2] * s.in[2] + w[kBias]);
      for (int out = 0; out < 3; ++out) {
        residual[out] += w[kOut + out] * at.value;
        if (rows == nullptr) continue;
        double* const row = rows + out * kWeights + 7 * u;
        const double slope = w[kOut + out] * at.slope;
        for (int in = 0; in < 3; ++in) row[in] = slope * s.in[in];
        row[kBias] = slope;
        row[kOut + out] = at.value;
      }
    }
    for (int out = 0; rows != nullptr && out < 3; ++out) rows[out * kWeights + 7 * kHidden + out] = 1.0;
  }

  const std::vector<PerceptronSample>& samples_;
};

/// Centre and half of the longest side of the bounding box of the samples.
struct Scale {
  Vector3 centre;
  double half = 0.0;

  Scale(const std::vector<PerceptronSample>& samples, Vector3 PerceptronSample::*side) {
    Vector3 low = samples.front().*side, high = low;
    for (const PerceptronSample& s : samples) low = low.cwiseMin(s.*side), high = high.cwiseMax(s.*side);
    centre = 0.5 * (low + high);
    half = 0.5 * (high - low).maxCoeff();
  }
  [[nodiscard]] Vector3 scaled(const Vector3& v) const { return (v - centre) / half; }
};

double nine_digits(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", x);
  return std::strtod(text, nullptr);
}

/// Includes the scales in the weights.
SphericalPerceptron unscaled(const std::vector<double>& weights, const Scale& in, const Scale& out) {
  SphericalPerceptron net;
  for (int u = 0; u < kHidden; ++u) {
    const double* const w = weights.data() + 7 * u;
    const auto n = static_cast<std::size_t>(u);
    double bias = w[kBias];
    for (int i = 0; i < 3; ++i) {
      const auto axis = static_cast<std::size_t>(i);
      net.in[axis][n] = nine_digits(w[i] / in.half);
      net.out[axis][n] = nine_digits(w[kOut + i] * out.half);
      bias -= net.in[axis][n] * in.centre[i];
    }
    net.bias[n] = nine_digits(bias);
  }
  for (int i = 0; i < 3; ++i)
    net.offset[static_cast<std::size_t>(i)] =
        nine_digits(weights[static_cast<std::size_t>(7 * kHidden + i)] * out.half + out.centre[i]);
  return net;
}

}  // namespace

SphericalPerceptron train_perceptron(const std::vector<PerceptronSample>& samples, int iterations,
                                     Random random) {
  if (samples.empty()) throw std::runtime_error("training a perceptron requires at least one sample");
  const Scale in(samples, &PerceptronSample::in), out(samples, &PerceptronSample::out);
  std::vector<PerceptronSample> scaled;
  for (const PerceptronSample& s : samples) scaled.push_back({in.scaled(s.in), out.scaled(s.out)});

  std::vector<double> weights(kWeights, 0.0);
  for (std::size_t i = 0; i < 7 * kHidden; ++i) weights[i] = (i % 7 < kOut ? 0.5 : 0.2) * random.normal();

  ceres::Problem problem;
  problem.AddResidualBlock(new Misfit(scaled), nullptr, weights.data());
  ceres::Solver::Options options;
  options.max_num_iterations = iterations;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.dense_linear_algebra_library_type = ceres::EIGEN;
  options.num_threads = 1;
  options.function_tolerance = options.gradient_tolerance = options.parameter_tolerance = 0.0;
  options.max_solver_time_in_seconds = 1e9;  // no time limit, so that the result is deterministic
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) throw std::runtime_error("training failed: " + summary.message);
  return unscaled(weights, in, out);
}

}  // namespace longreach
