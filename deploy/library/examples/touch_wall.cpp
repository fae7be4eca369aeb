// Touches a wall of 1000 N/m as far away as the Moon, in virtual time: both sides, a scripted operator, 40 s.
#include <algorithm>
#include <cstdio>
#include <longreach/virtual_loop.hpp>

int main() {
  longreach::VirtualLoop loop({"profile=moon"}, 1);
  double force_max_n = 0.0;
  while (loop.state().time_s < 40.0) {
    loop.run(0.1);
    force_max_n = std::max(force_max_n, loop.state().handle_force_n.norm());
  }
  const longreach::LoopState now = loop.state();
  std::printf("round trip %.3f s\n", now.round_trip_s.value_or(0.0));
  std::printf("rendered %.0f N/m of %.0f N/m\n", now.rendered_stiffness_n_per_m, now.true_stiffness_n_per_m);
  std::printf("maximum force %.1f N\n", force_max_n);
}
