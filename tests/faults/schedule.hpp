#pragma once
// Faults of one run and their times: a list, drawn from a seed, that can be printed, read and shortened.
// Swarm testing (Groce et al. 2012): each seed has only a few kinds of fault, several times each, which
// produces combinations that would be rare if all kinds were always present. Durations are log-uniform, and
// faults overlap. Faults that must last for seconds to activate a guard are added in a share of the seeds,
// from a stream of their own.
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
  double size = 0.5;       // severity from 0 to 1; each kind has its own scale
  std::uint64_t seed = 0;  // of the random numbers of the fault
};

struct Schedule {
  std::uint64_t seed = 1;     // of the scenario and of all streams
  double faults_end_s = 0.0;  // from then on there are no faults, and the system must recover
  double end_s = 0.0;
  std::vector<Fault> faults;
};

/// `round_trip_s` of the scenario's link; recovery takes as long.
Schedule draw_schedule(std::uint64_t seed, double round_trip_s);

std::string to_text(const Schedule& schedule);
/// Throws ConfigError that names the line.
Schedule parse_schedule(const std::string& text);

}  // namespace longreach
