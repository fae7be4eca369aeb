#include "deploy/lab/networks/spherical_network.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "common/core/geometry_error.hpp"
#include "common/spatial/sin_cos.hpp"
#include "master/devices/spherical/spherical_closure.hpp"

namespace longreach {
namespace {

constexpr double kTrainedAxis = 1e-9;  // tolerance for axes that differ only in their last digits
constexpr double kSingularStep =
    1e-3;  // 1 / |J^-1| below which no step is taken; the workspace keeps far above

// Processes four units at once and sums over the lanes at the end. The order of additions is fixed in the
// source, so that every processor gives the same bits, whether it has two or four numbers per instruction.
using Lanes [[gnu::vector_size(32), gnu::may_alias]] = double;
constexpr int kLanes = sizeof(Lanes) / sizeof(double);
static_assert(SphericalPerceptron::kUnits % kLanes == 0);

#if defined(__x86_64__) && !defined(__SANITIZE_THREAD__)  // as in spherical_tracking.cpp
#ifndef __clang__                                         // Clang 14 leaves the name itself undefined
[[gnu::target_clones("avx", "default")]]
#endif
#endif
Vector3
evaluate(const SphericalPerceptron& net, const Vector3& theta_rad) {
  const auto lanes = [](const auto& numbers) { return reinterpret_cast<const Lanes*>(numbers.data()); };
  const Lanes* const bias = lanes(net.bias);
  const Lanes *const in0 = lanes(net.in[0]), *const in1 = lanes(net.in[1]), *const in2 = lanes(net.in[2]);
  const Lanes *const out0 = lanes(net.out[0]), *const out1 = lanes(net.out[1]),
                     *const out2 = lanes(net.out[2]);
  Lanes sum0{}, sum1{}, sum2{};
  for (int i = 0; i < SphericalPerceptron::kUnits / kLanes; ++i) {
    const Lanes z = bias[i] + in0[i] * theta_rad[0] + in1[i] * theta_rad[1] + in2[i] * theta_rad[2];
    const Lanes zz = z * z;
    const Lanes s = z * (27.0 + zz) / (27.0 + 9.0 * zz);
    sum0 += out0[i] * s;
    sum1 += out1[i] * s;
    sum2 += out2[i] * s;
  }
  return {net.offset[0] + ((sum0[0] + sum0[1]) + (sum0[2] + sum0[3])),
          net.offset[1] + ((sum1[0] + sum1[1]) + (sum1[2] + sum1[3])),
          net.offset[2] + ((sum2[0] + sum2[1]) + (sum2[2] + sum2[3]))};
}

bool is_finite(const SphericalPerceptron& net) {
  const auto finite = [](const auto& numbers) {
    return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
  };
  return finite(net.bias) && finite(net.offset) && std::all_of(net.in.begin(), net.in.end(), finite) &&
         std::all_of(net.out.begin(), net.out.end(), finite);
}

void require(bool condition, const std::string& sentence) {
  if (!condition) throw GeometryError(sentence);
}

void require_same(const SphericalGeometry& mine, const SphericalGeometry& trained) {
  const std::string other = "the network was trained for another geometry: ";
  require(std::abs(mine.cos_alpha2() - trained.cos_alpha2()) <= kTrainedAxis, other + "alpha2 differs");
  for (int i = 0; i < 3; ++i) {
    const SphericalGeometry::Leg &a = mine.leg(i), &b = trained.leg(i);
    const std::string differs = " axis of leg " + std::to_string(i + 1) + " differs";
    require((a.u - b.u).norm() <= kTrainedAxis, other + "the base" + differs);
    require((a.v - b.v).norm() <= kTrainedAxis, other + "the platform" + differs);
    require((a.w_axial - b.w_axial).norm() + (a.w_cos - b.w_cos).norm() <= kTrainedAxis,
            other + "the middle" + differs);
  }
}

void require_numbers(const SphericalNetworkConfig& c) {
  const int n = c.cells.per_axis;
  require(n >= 1 && n <= 9 && n % 2 == 1, "cells.per_axis of the network must be an odd number from 1 to 9");
  require(c.fine.size() == static_cast<std::size_t>(n * n * n), "there must be one fine network per cell");
  require((c.cells.width.array() > 0.0).all() && c.cells.width.allFinite(),
          "cells.width of the network must be finite and greater than 0");
  require(c.cells.overlap > 0.0 && c.cells.overlap <= 0.5,
          "cells.overlap of the network is outside (0, 0.5]");
  const SphericalWorkspace& w = c.workspace;
  require(w.home_rad.allFinite() && std::abs(w.q_home.norm() - 1.0) <= kTrainedAxis,
          "the home orientation of the network must be a unit quaternion, and the motor angles there "
          "must be finite");
  require(w.common_rad > 0.0 && w.differential_rad > 0.0 && std::isfinite(w.common_rad + w.differential_rad),
          "the workspace of the network is empty");
  require(is_finite(c.rough) && std::all_of(c.fine.begin(), c.fine.end(), is_finite),
          "a weight of the network is not finite");
}

/// F of the three legs and their Jacobian about q.
struct Closures {
  SphericalClosure legs[3];

  Closures(const SphericalGeometry& g, const Vector3& theta_rad, const Quaternion& q) {
    const Matrix3 R = q.toRotationMatrix();
    for (int i = 0; i < 3; ++i) {
      const SinCos turn = sin_cos(theta_rad[i]);
      legs[i] = {g.middle_axis(i, turn.c, turn.s), R * g.leg(i).v, g.cos_alpha2()};
    }
  }
  [[nodiscard]] Adjugate adjugate() const { return {legs[0].n, legs[1].n, legs[2].n}; }
};

}  // namespace

SphericalNetwork::SphericalNetwork(const SphericalGeometry& geometry, SphericalNetworkConfig config)
    : geometry_(geometry), config_(std::move(config)) {
  require_same(geometry_, SphericalGeometry(config_.axes));
  require_numbers(config_);
  const SphericalCells& cells = config_.cells;
  per_width_ = cells.width.cwiseInverse();
  const int n = cells.per_axis, middle = n / 2;
  for (int i = 0; i < n * n * n; ++i) {
    centre_.push_back(
        cells.width.cwiseProduct(Vector3(i / (n * n) - middle, i / n % n - middle, i % n - middle)));
  }
  const SphericalWorkspace& w = config_.workspace;
  const double volume = Closures(geometry_, w.home_rad, w.q_home).adjugate().volume;
  require(std::abs(volume) > kSingularStep, "the home orientation of the network is singular");
  side_ = volume > 0.0 ? 1 : -1;
}

int SphericalNetwork::cell_of(const Vector3& g) const {
  const int n = config_.cells.per_axis;
  int cell = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double at = g[axis] * per_width_[axis] + 0.5 * n;
    cell = cell * n + static_cast<int>(std::clamp(at, 0.0, n - 0.5));
  }
  return cell;
}

SphericalEstimate SphericalNetwork::nothing(SolutionStatus status) const {
  return {status, config_.workspace.q_home, -1};
}

SphericalEstimate SphericalNetwork::accept(const Vector3& g, int cell) const {
  const double overlap = config_.cells.overlap;
  const Vector3 centre = centre_[static_cast<std::size_t>(cell)];
  const double off = (g - centre).cwiseAbs().cwiseProduct(per_width_).maxCoeff();  // in widths
  if (off > 0.5 + overlap) return nothing(SolutionStatus::kNotConverged);
  const int next = off <= 0.5 + 0.5 * overlap ? cell : cell_of(g);
  return {SolutionStatus::kFound, turned(g, config_.workspace.q_home), next};
}

SphericalEstimate SphericalNetwork::rough(const Vector3& theta_rad) const {
  if (!config_.workspace.contains(theta_rad)) return nothing(SolutionStatus::kNoSolution);
  const Vector3 g = evaluate(config_.rough, theta_rad);
  return {SolutionStatus::kFound, turned(g, config_.workspace.q_home), cell_of(g)};
}

SphericalEstimate SphericalNetwork::forward(const Vector3& theta_rad) const {
  if (!config_.workspace.contains(theta_rad)) return nothing(SolutionStatus::kNoSolution);
  const int cell = cell_of(evaluate(config_.rough, theta_rad));
  return accept(evaluate(config_.fine[static_cast<std::size_t>(cell)], theta_rad), cell);
}

SphericalEstimate SphericalNetwork::forward(const Vector3& theta_rad,
                                            const SphericalEstimate& previous) const {
  const auto cell = static_cast<std::size_t>(previous.cell);
  if (cell >= config_.fine.size()) return forward(theta_rad);
  if (!config_.workspace.contains(theta_rad)) return nothing(SolutionStatus::kNoSolution);
  const SphericalEstimate estimate = accept(evaluate(config_.fine[cell], theta_rad), previous.cell);
  return estimate.status == SolutionStatus::kFound ? estimate : forward(theta_rad);
}

SphericalEstimate SphericalNetwork::refined(const Vector3& theta_rad,
                                            const SphericalEstimate& estimate) const {
  if (estimate.status != SolutionStatus::kFound) return estimate;
  const Closures closures(geometry_, theta_rad, estimate.q);
  const Adjugate inverse = closures.adjugate();
  const double square = inverse.volume * inverse.volume;
  if (!(side_ * inverse.volume > 0.0 && square > kSingularStep * kSingularStep * inverse.square()))
    return nothing(SolutionStatus::kSingular);
  const auto& legs = closures.legs;
  const Vector3 g =
      (-1.0 / inverse.volume) * inverse.times(legs[0].half_gap, legs[1].half_gap, legs[2].half_gap);
  return {SolutionStatus::kFound, turned(g, estimate.q), estimate.cell};
}

}  // namespace longreach
