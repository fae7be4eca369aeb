// Renders a wall of 1000 N/m at 1 kHz: the hand presses 5 mm deep and retreats; the stiffness arrives late.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <longreach/passive_spring.hpp>

int main() {
  longreach::PassiveSpring spring;
  constexpr double kTurn = 6.283185307179586, kPeriod_s = 0.001;
  double force_max_n = 0.0, energy_min_j = 0.0;
  spring.engage(0.0, 0.010);
  for (int i = 0; i < 8000; ++i) {
    const double t = i * kPeriod_s;
    const double position_m = 0.0075 * (1.0 - std::cos(kTurn * t / 4.0));
    const double velocity_m_per_s = 0.0075 * kTurn / 4.0 * std::sin(kTurn * t / 4.0);
    if (i == 3000) spring.update(0.010, 1000.0);  // after the first retreat from the wall
    const longreach::SpringForce now = spring.step(position_m, velocity_m_per_s);
    force_max_n = std::max(force_max_n, now.force_n);
    energy_min_j = std::min(energy_min_j, now.port_energy_j);
  }
  std::printf("stiffness %.0f N/m\n", spring.stiffness_n_per_m());
  std::printf("maximum force %.2f N\n", force_max_n);
  std::printf("returned at most %.1f mJ\n", -1e3 * energy_min_j);
}
