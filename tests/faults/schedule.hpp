#pragma once
// The faults of one run and their times: a list, drawn from a seed, that can be printed, read and shortened.
// The method is swarm testing (Groce et al. 2012): each schedule has only a few kinds of fault, several times
// each, which produces combinations that would be rare if all kinds were always present. Durations are
// distributed log-uniformly, and faults overlap. Faults that activate a guard only if they last for seconds
// are added to a fraction of the seeds, using a separate random stream.
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
  std::uint64_t seed = 0;  // seed of the random numbers of this fault
};

struct Schedule {
  std::uint64_t seed = 1;  // seed of the scenario and of all random streams
  /// After this time no fault is active, and the system must recover.
  double faults_end_s = 0.0;
  double end_s = 0.0;
  std::vector<Fault> faults;
};

/// Draws the schedule of a seed. `round_trip_s` is the round-trip time of the link of the scenario; the time
/// allowed for recovery depends on it.
Schedule draw_schedule(std::uint64_t seed, double round_trip_s);

std::string to_text(const Schedule& schedule);
/// Parses the output of to_text(). Throws a ConfigError that names the invalid line.
Schedule parse_schedule(const std::string& text);

}  // namespace longreach
