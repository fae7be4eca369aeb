#pragma once
// What goes wrong in one run, and when: a plain list, drawn from a seed, that can be printed, read again and
// shortened. Swarm testing (Groce et al. 2012): each seed has a few kinds of fault only, several times each,
// so that kinds meet that rarely would if all were always there. Durations are log-uniform; faults overlap.
// What takes seconds to make a guard act comes besides, in a share of the seeds, from a stream of its own.
//
//   seed 17
//   faults_end_s 31.5
//   end_s 45
//   fault sensor-stuck start_s 3.2 duration_s 0.5 size 0.7 seed 99

#include <cstdint>
#include <string>
#include <vector>

namespace longreach {

struct Fault {
  std::string kind;
  double start_s = 0.0;
  double duration_s = 0.0;
  double size = 0.5;       // 0 to 1: how bad; each kind has a scale of its own
  std::uint64_t seed = 0;  // of what the fault draws
};

struct Schedule {
  std::uint64_t seed = 1;     // of the scenario and of all streams
  double faults_end_s = 0.0;  // from then on nothing goes wrong, and the system must come back
  double end_s = 0.0;
  std::vector<Fault> faults;
};

/// `round_trip_s`: of the scenario's link; what comes back needs as long.
Schedule draw_schedule(std::uint64_t seed, double round_trip_s);

std::string to_text(const Schedule& schedule);
/// Throws ConfigError that names the line.
Schedule parse_schedule(const std::string& text);

}  // namespace longreach
