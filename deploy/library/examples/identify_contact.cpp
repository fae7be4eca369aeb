// Identifies a contact from samples of a press: F = 2e4 N/m^1.5 x^1.5 + λ x^1.5 v, 5 mm behind the start.
#include <cmath>
#include <cstdio>
#include <longreach/identification.hpp>
#include <vector>

int main() {
  constexpr double kTurn = 6.283185307179586, kStiffness = 2e4, kDamping = 4e3, kSurface_m = 0.005;
  std::vector<double> time_s, position_m, force_n;
  for (int i = 0; i < 3000; ++i) {
    const double t = 1e-3 * i;
    const double x = 0.006 * (1.0 - std::cos(kTurn * t)), v = 0.006 * kTurn * std::sin(kTurn * t);
    const double depth = std::max(0.0, x - kSurface_m);
    const double noise_n = 0.01 * std::sin(12345.678 * i * i);
    time_s.push_back(t);
    position_m.push_back(x);
    force_n.push_back(std::pow(depth, 1.5) * (kStiffness + kDamping * v) + noise_n);
  }
  const longreach::ContactResult contact =
      longreach::identify(time_s, position_m, force_n, {.depth_m = 0.005});
  std::printf("exponent %.3f\n", contact.n.value);
  std::printf("tangent at 5 mm %.0f N/m, sd %.1f\n", contact.tangent.value, contact.tangent.sd);
  std::printf("surface %.3f mm\n", 1e3 * contact.surface.value);
  std::printf("identified %d\n", contact.tangent.verdict == longreach::ContactVerdict::kIdentified);
}
