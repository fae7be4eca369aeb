#include "deploy/lab/devices/wall_bench.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "master/devices/delta/delta_handle.hpp"
#include "master/simulation/simulated_delta.hpp"

namespace longreach {
namespace {

constexpr double kPress_n = 0.2;

/// Runs the loop sample by sample: read, wall, write.
class Wall {
 public:
  Wall(const WallCase& c, double stiffness_n_per_m)
      : case_(c), stiffness_(stiffness_n_per_m), device_(c.device), handle_(c.device) {}

  /// Depth at which the wall balances the pressing force, m.
  [[nodiscard]] double rest_m() const { return kPress_n / stiffness_; }
  /// True depth of the handle, m.
  [[nodiscard]] double depth_m() const { return -device_.position_m().z(); }
  [[nodiscard]] double depth_rate() const { return -device_.velocity_m_per_s().z(); }

  void place(double depth_m) {
    device_.place({0.0, 0.0, -depth_m});
    measured_m_ = rest_m();  // as if the handle had been at rest there
  }

  /// Reads, renders, writes.
  void control() {
    handle_.read(device_.encoder_rad(), 0.0);
    const double before_m = std::exchange(measured_m_, -handle_.position_m().z());
    double push_n = 0.0;
    if (measured_m_ > 0.0)
      push_n = stiffness_ * measured_m_ + case_.wall_n_s_per_m * (measured_m_ - before_m) / case_.period_s;
    device_.command(handle_.torques({0.0, 0.0, std::max(0.0, push_n) - kPress_n}));
  }

  void move(double dt_s, const HandModel& hand, double hand_depth_m, double hand_rate = 0.0) {
    device_.step(dt_s, hand, {0.0, 0.0, -hand_depth_m}, {0.0, 0.0, -hand_rate});
  }

 private:
  const WallCase& case_;
  double stiffness_;
  SimulatedDelta device_;
  DeltaHandle handle_;
  double measured_m_ = 0.0;
};

/// Along the vertical at home.
double vertical_rates2(const DeviceConfig& device) {
  const DeltaDynamics d(device.delta);
  return d.pose(d.home_m()).rates.col(2).squaredNorm();
}

}  // namespace

DeviceConfig ideal_device(DeviceConfig device) {
  device.gravity_m_per_s2.setZero();
  device.delta.drive.coulomb_nm = 0.0;
  device.delta.drive.resolution_rad = 0.0;
  device.delta.drive.bandwidth_hz = 0.0;
  device.delta.drive.torque_max_nm = 1e3;
  return device;
}

DeviceConfig with_damping(DeviceConfig device, double vertical_n_s_per_m) {
  device.delta.drive.viscous_nm_s_per_rad = vertical_n_s_per_m / vertical_rates2(device);
  return device;
}

SampledWall model_of(const WallCase& c) {
  const DeltaDynamics d(c.device.delta);
  const HandModel hand = hand_model(c.grip);
  return {.mass_kg = d.mass_kg(d.pose(d.home_m()))(2, 2) + hand.mass_kg,
          .device_n_s_per_m = c.device.delta.drive.viscous_nm_s_per_rad * vertical_rates2(c.device),
          .hand_n_s_per_m = hand.damping_n_s_per_m,
          .hand_n_per_m = hand.stiffness_n_per_m,
          .wall_n_s_per_m = c.wall_n_s_per_m,
          .period_s = c.period_s,
          .delay_samples = static_cast<int>(c.device.delay_samples)};
}

bool decays(const WallCase& c, double stiffness_n_per_m) {
  Wall wall(c, stiffness_n_per_m);
  const double rest_m = wall.rest_m();
  wall.place(1.01 * rest_m);
  const HandModel hand = hand_model(c.grip);
  const int ticks = static_cast<int>(2.0 / c.period_s);
  double middle_m = 0.0, late_m = 0.0;
  for (int i = 0; i < ticks; ++i) {
    wall.control();
    wall.move(c.period_s, hand, rest_m);
    const double off_m = std::abs(wall.depth_m() - rest_m);
    if (i > ticks / 4 && i <= ticks / 2) middle_m = std::max(middle_m, off_m);
    if (i > 3 * ticks / 4) late_m = std::max(late_m, off_m);
    if (off_m > rest_m) return false;  // out of contact
  }
  return late_m <= middle_m;
}

double simulated_limit_n_per_m(const WallCase& c) {
  double low = 25.0, high = 50.0;
  while (high < 1e8 && decays(c, high)) low = std::exchange(high, 2.0 * high);
  while (high > 1.01 * low) {
    const double middle = std::sqrt(low * high);
    (decays(c, middle) ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

double residual_m(const WallCase& c, double stiffness_n_per_m, double tap_m) {
  Wall wall(c, stiffness_n_per_m);
  const double rest_m = wall.rest_m();
  wall.place(rest_m + tap_m);
  const HandModel hand = hand_model(c.grip);
  const int ticks = static_cast<int>(16.0 / c.period_s);
  double sum_m = 0.0, sum_m2 = 0.0;
  for (int i = 0; i < ticks; ++i) {
    wall.control();
    wall.move(c.period_s, hand, rest_m);
    if (i < 3 * ticks / 4) continue;
    sum_m += wall.depth_m();
    sum_m2 += wall.depth_m() * wall.depth_m();
  }
  const double n = ticks - 3 * ticks / 4, mean_m = sum_m / n;
  return std::sqrt(std::max(0.0, sum_m2 / n - mean_m * mean_m));
}

double cycle_energy_j(const WallCase& c, double stiffness_n_per_m) {
  constexpr HandModel kDriving{0.0, 200.0, 2e5};
  constexpr double kHz = 20.0;
  constexpr int kCycles = 20, kSubsteps = 20;
  Wall wall(c, stiffness_n_per_m);
  const double rest_m = wall.rest_m(), swing_m = 0.3 * rest_m, w = 2.0 * std::numbers::pi * kHz;
  wall.place(rest_m);
  const double dt_s = c.period_s / kSubsteps;
  const int ticks = static_cast<int>(kCycles / kHz / c.period_s);
  double energy_j = 0.0, power_w = 0.0, t = 0.0;
  for (int i = 0; i < ticks; ++i) {
    wall.control();
    for (int k = 0; k < kSubsteps; ++k) {
      const double target_m = rest_m + swing_m * std::sin(w * t), rate = swing_m * w * std::cos(w * t);
      wall.move(dt_s, kDriving, target_m, rate);
      t += dt_s;
      const double after_m = rest_m + swing_m * std::sin(w * t), after_rate = swing_m * w * std::cos(w * t);
      // The wall balances the pressing force, so only the additional work of the hand counts.
      const double force_n = kDriving.stiffness_n_per_m * (after_m - wall.depth_m()) +
                             kDriving.damping_n_s_per_m * (after_rate - wall.depth_rate());
      const double now_w = force_n * wall.depth_rate();
      if (i >= ticks / 2) energy_j += 0.5 * (power_w + now_w) * dt_s;  // settled, whole cycles
      power_w = now_w;
    }
  }
  return energy_j / (kCycles / 2);
}

}  // namespace longreach
