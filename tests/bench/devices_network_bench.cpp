// Cost of the forward kinematics of the 3-RRR device by networks, one tick of a slow motion about home. What
// the weights are makes no difference to the cost, so these are straight networks about home, and no file is
// read. The error that each buys, and the other solvers beside it: `longreach-lab run fk-network`.
// Instructions:
//   valgrind --tool=callgrind --toggle-collect='longreach::SphericalNetwork::forward(*' bench_devices
//     --benchmark_filter=NetworkForward --benchmark_min_time=0.01

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>

#include "deploy/lab/devices/spherical_catalog.hpp"
#include "deploy/lab/networks/spherical_network.hpp"
#include "master/devices/spherical/spherical_kinematics.hpp"
#include "master/devices/spherical/spherical_statics.hpp"

namespace longreach {
namespace {

constexpr std::size_t kPoses = 1024;

struct NetworkMotion {
  NetworkMotion() {
    for (std::size_t n = 0; n < kPoses; ++n) {
      const double turn = 2.0 * 3.141592653589793 * static_cast<double>(n) / kPoses;
      theta[n] = k.inverse(exp_rotation(0.3 * Vector3(std::sin(turn), std::cos(turn), std::sin(2.0 * turn))))
                     .theta_rad;
    }
  }

  /// g = (slope at home) (θ - home), in three of the units.
  static SphericalNetworkConfig straight(const SphericalKinematics& k) {
    SphericalNetworkConfig c;
    c.axes.alpha1 = c.axes.alpha2 = std::acos(0.0);
    for (int i = 0; i < 3; ++i) {
      c.axes.u.row(i) = k.geometry().leg(i).u;
      c.axes.v.row(i) = k.geometry().leg(i).v;
      c.axes.w0.row(i) = k.geometry().leg(i).w_axial + k.geometry().leg(i).w_cos;
    }
    c.workspace.home_rad = k.inverse(Quaternion::Identity()).theta_rad;
    c.workspace.common_rad = c.workspace.differential_rad = 1.0;
    c.cells = {3, Vector3::Constant(0.2), 0.25};
    const Matrix3 slope =
        0.5 * inverse_jacobian(velocity(k.geometry(), c.workspace.home_rad, Quaternion::Identity())).matrix;
    for (std::size_t u = 0; u < 3; ++u) {
      const auto i = static_cast<Eigen::Index>(u);
      c.rough.in[u][u] = 1e-3;
      c.rough.bias[u] = -1e-3 * c.workspace.home_rad[i];
      for (std::size_t row = 0; row < 3; ++row)
        c.rough.out[row][u] = 1e3 * slope(static_cast<Eigen::Index>(row), i);
    }
    c.fine.assign(27, c.rough);
    return c;
  }

  SphericalKinematics k{reconstructed_spherical()};
  SphericalNetwork net{k.geometry(), straight(k)};
  std::array<Vector3, kPoses> theta;
};

/// `solve(motion, theta)` returns an estimate; one that is not found would be cheaper than it should.
template <class Solve>
void run(benchmark::State& state, Solve solve) {
  const NetworkMotion m;
  std::size_t n = 0, found = 0;
  for (auto _ : state) {
    const auto estimate = solve(m, m.theta[n++ % kPoses]);
    benchmark::DoNotOptimize(estimate);
    found += estimate.status == SolutionStatus::kFound ? 1 : 0;
  }
  if (found != n) state.SkipWithError("not found");
}

void NetworkRough(benchmark::State& state) {
  run(state, [](const NetworkMotion& m, const Vector3& theta) { return m.net.rough(theta); });
}
BENCHMARK(NetworkRough);

void NetworkForwardFromNothing(benchmark::State& state) {
  run(state, [](const NetworkMotion& m, const Vector3& theta) { return m.net.forward(theta); });
}
BENCHMARK(NetworkForwardFromNothing);

void NetworkForward(benchmark::State& state) {
  SphericalEstimate estimate;
  run(state, [&](const NetworkMotion& m, const Vector3& theta) {
    return estimate = m.net.forward(theta, estimate);
  });
}
BENCHMARK(NetworkForward);

void NetworkForwardNewtonStep(benchmark::State& state) {
  SphericalEstimate estimate;
  run(state, [&](const NetworkMotion& m, const Vector3& theta) {
    return m.net.refined(theta, estimate = m.net.forward(theta, estimate));
  });
}
BENCHMARK(NetworkForwardNewtonStep);

void NewtonStep(benchmark::State& state) {
  SphericalEstimate estimate{SolutionStatus::kFound, Quaternion::Identity(), 13};
  run(state, [&](const NetworkMotion& m, const Vector3& theta) {
    return estimate = m.net.refined(theta, estimate);
  });
}
BENCHMARK(NewtonStep);

void NewtonFromRough(benchmark::State& state) {
  run(state, [](const NetworkMotion& m, const Vector3& theta) {
    return m.k.forward(theta, {SolutionStatus::kFound, m.net.rough(theta).q});
  });
}
BENCHMARK(NewtonFromRough);

void NewtonFromHome(benchmark::State& state) {
  run(state, [](const NetworkMotion& m, const Vector3& theta) {
    return m.k.forward(theta, {SolutionStatus::kFound, Quaternion::Identity()});
  });
}
BENCHMARK(NewtonFromHome);

}  // namespace
}  // namespace longreach
