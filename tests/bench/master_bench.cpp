// Cost of the master's whole step, as a program with real devices pays it: encoder angles of both devices to
// the handle's state, mapping, rendering, motor torques. Without network. With 1 as argument, the device does not turn.
// Instructions:
//   valgrind --tool=callgrind --toggle-collect='longreach::tick(*' bench_master --benchmark_filter=MasterStep

#include <benchmark/benchmark.h>

#include <array>

#include "master/master_node.hpp"
#include "master/simulation/simulated_devices.hpp"

namespace longreach {

struct BenchedMaster {
  bool turns;
  DeltaHandle delta;
  SphericalHandle spherical;
  MasterNode node;
  MasterInput in{};
};

/// One tick.
[[gnu::noinline]] Vector3 tick(BenchedMaster& m, const Vector3& delta_rad, const Vector3& spherical_rad) {
  m.in.handle.ok = m.delta.read(delta_rad, 1e-3) && (!m.turns || m.spherical.read(spherical_rad, 1e-3));
  m.in.handle.p_MH = m.delta.position_m();
  m.in.handle.velocity_m_per_s = m.delta.velocity_m_per_s();
  if (m.turns) {
    m.in.handle.q_MH = m.spherical.orientation();
    m.in.handle.angular_rad_per_s = m.spherical.angular_rad_per_s();
  }
  const Wrench F = m.node.step(m.in).F_H_M;
  return m.turns ? m.delta.torques(F.force) + m.spherical.torques(F.moment) : m.delta.torques(F.force);
}

namespace {

constexpr std::size_t kTicks = 1024;

MasterConfig engaging(bool turns) {
  MasterConfig config;
  config.device.turns = turns;
  config.safety.engage_at_start = true;
  return config;
}

void MasterStep(benchmark::State& state) {
  const bool turns = state.range(0) == 0;
  const DeviceConfig device;
  const DeltaDynamics delta(device.delta);
  const SphericalDynamics spherical(device.spherical);
  std::array<Vector3, kTicks> delta_rad, spherical_rad;
  for (std::size_t n = 0; n < kTicks; ++n) {
    const double a = 2.0 * 3.141592653589793 * static_cast<double>(n) / kTicks;
    delta_rad[n] =
        delta.pose(delta.home_m() + 0.015 * Vector3(std::sin(a), std::cos(a) - 1.0, 0.0)).theta_rad;
    spherical_rad[n] =
        spherical.attitude(exp_rotation({0.2 * std::sin(a), 0.0, 0.1 * std::sin(a)})).theta_rad;
  }
  BenchedMaster m{turns, DeltaHandle(device), SphericalHandle(device), MasterNode(engaging(turns))};
  Received<StiffnessReport> report;
  std::size_t n = 0;
  const auto step = [&] {
    m.in.now += std::chrono::milliseconds(1);
    m.in.last_heard = m.in.now;
    const std::size_t i = n++ % kTicks;
    return tick(m, delta_rad[i], spherical_rad[i]);
  };
  // Engaged, and in contact with a wall.
  for (int i = 0; i < 2000; ++i) {
    report.sequence = static_cast<std::uint64_t>(i) + 1;
    report.message.engagement = m.node.view().engagement;
    report.message.state = SafetyState::kEngaged;
    if (i > 1000) {
      report.message.translation.surfaces[0] = {.normal = -Vector3::UnitX(),
                                                .stiffness = 1000.0,
                                                .touch_sequence = 150.0,
                                                .touch = 1,
                                                .pressed = true};
    }
    m.in.reports = i % 100 == 0 ? std::span(&report, 1) : std::span<const Received<StiffnessReport>>();
    step();
  }
  m.in.reports = {};
  double sum = 0.0;
  for (auto _ : state) sum += step().x();
  benchmark::DoNotOptimize(sum);
  if (!m.node.engaged() || !m.node.view().surface_known) state.SkipWithError("not engaged with a wall");
}
BENCHMARK(MasterStep)->Arg(0)->Arg(1);

}  // namespace
}  // namespace longreach
