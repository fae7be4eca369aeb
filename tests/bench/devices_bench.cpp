// Cost of the kinematics of both devices. Nanoseconds are a reading; the measure is the count of
// instructions:
//   valgrind --tool=callgrind --toggle-collect='longreach::SphericalKinematics::forward(*' bench_devices
//     --benchmark_filter=SphericalForward/tick --benchmark_min_time=0.01

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>

#include "deploy/lab/devices/delta_catalog.hpp"
#include "deploy/lab/devices/spherical_catalog.hpp"
#include "master/devices/delta/delta_kinematics.hpp"
#include "master/devices/spherical/spherical_kinematics.hpp"
#include "master/devices/spherical/spherical_statics.hpp"

namespace longreach {
namespace {

constexpr std::size_t kTicks = 1024;

/// A closed motion about home with amplitude `reach`, one tick a millisecond.
Vector3 motion(std::size_t tick, double reach) {
  const double turn = 2.0 * 3.141592653589793 * static_cast<double>(tick) / kTicks;
  return reach * Vector3(std::sin(turn), std::cos(turn) - 1.0, std::sin(2.0 * turn));
}

struct DeltaMotion {
  explicit DeltaMotion(const DeltaDesign& d) : k(d.geometry), home(d.home_m) {
    for (std::size_t n = 0; n < kTicks; ++n) {
      p[n] = d.home_m + motion(n, 0.02);
      theta[n] = k.inverse(p[n]).theta_rad;
    }
  }
  DeltaKinematics k;
  Vector3 home;
  std::array<Vector3, kTicks> p, theta;
};

void DeltaInverse(benchmark::State& state) {
  const DeltaMotion m(omega_like());
  std::size_t n = 0;
  for (auto _ : state) benchmark::DoNotOptimize(m.k.inverse(m.p[n++ % kTicks]));
}
BENCHMARK(DeltaInverse);

void DeltaForward(benchmark::State& state) {
  const DeltaMotion m(omega_like());
  std::size_t n = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(m.k.forward(m.theta[n++ % kTicks], m.k.geometry().working_assembly(), m.home));
}
BENCHMARK(DeltaForward);

/// As the handle tracks it: from where the last tick's stride leads on.
void FalconForward(benchmark::State& state) {
  const DeltaMotion m(novint_falcon());
  Vector3 p = m.p[0], stride = Vector3::Zero();
  std::size_t n = 0;
  double iterations = 0.0;
  for (auto _ : state) {
    const DeltaPosition found =
        m.k.forward(m.theta[n++ % kTicks], m.k.geometry().working_assembly(), p + stride);
    stride = found.p_m - p;
    p = found.p_m;
    iterations += found.iterations;
    benchmark::DoNotOptimize(p);
  }
  state.counters["iterations"] = iterations / static_cast<double>(state.iterations());
}
BENCHMARK(FalconForward);

void DeltaGravity(benchmark::State& state) {
  const DeltaMotion m(omega_like());
  const DeltaDesign d = omega_like();
  std::size_t n = 0;
  for (auto _ : state) {
    const std::size_t i = n++ % kTicks;
    const DeltaVelocity at = velocity(d.geometry, m.theta[i], m.p[i]);
    benchmark::DoNotOptimize(gravity_torques(d.geometry, d.masses, {0, 0, -9.81}, m.theta[i], at));
  }
}
BENCHMARK(DeltaGravity);

struct SphericalMotion {
  explicit SphericalMotion(double reach) : k(reconstructed_spherical()) {
    for (std::size_t n = 0; n < kTicks; ++n) {
      q[n] = exp_rotation(motion(n, reach));
      theta[n] = k.inverse(q[n]).theta_rad;
    }
  }
  SphericalKinematics k;
  std::array<Quaternion, kTicks> q;
  std::array<Vector3, kTicks> theta;
};

void SphericalInverse(benchmark::State& state) {
  const SphericalMotion m(0.3);
  std::size_t n = 0;
  for (auto _ : state) benchmark::DoNotOptimize(m.k.inverse(m.q[n++ % kTicks]));
}
BENCHMARK(SphericalInverse);

/// The argument is the amplitude in mrad: about 6e-6, 2e-3 or 3e-3 rad a tick.
void SphericalForward(benchmark::State& state) {
  const SphericalMotion m(1e-3 * static_cast<double>(state.range(0)));
  SphericalPose pose{SolutionStatus::kFound, m.q[0]};
  std::size_t n = 0;
  double iterations = 0.0;
  for (auto _ : state) {
    pose = m.k.forward(m.theta[n++ % kTicks], pose);
    benchmark::DoNotOptimize(pose);
    iterations += pose.iterations;
  }
  state.counters["iterations"] = iterations / static_cast<double>(state.iterations());
}
BENCHMARK(SphericalForward)->ArgName("mrad")->Arg(1)->Arg(50)->Arg(300);

void SphericalForwardAll(benchmark::State& state) {
  const SphericalMotion m(0.3);
  std::size_t n = 0;
  for (auto _ : state) benchmark::DoNotOptimize(m.k.forward_all(m.theta[n++ % kTicks]));
}
BENCHMARK(SphericalForwardAll);

}  // namespace
}  // namespace longreach
