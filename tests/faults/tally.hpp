#pragma once
// What many trials gave together: kinds and how often they were injected, guards and how often they acted,
// invariants and how often they were judged and violated. Sums that can be written, read and added.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tests/faults/trial.hpp"

namespace longreach {

struct Failure {
  std::uint64_t seed = 0;
  Breach violation{};
};

struct Tally {
  std::uint64_t seeds = 0;
  double virtual_s = 0.0, engaged_s = 0.0;
  std::map<std::string, std::uint64_t> kinds, guards, judged, violated;  // by name
  std::vector<Failure> failures;
  std::uint64_t trajectories = 0;  // hash of all

  void add(std::uint64_t seed, const Trial& trial);
  void add(const Tally& other);
  /// Of what was tried besides the trial (twin.hpp).
  void judge(std::uint64_t seed, const char* invariant, bool good, const char* words);
};

std::string to_text(const Tally& tally);
/// Throws ConfigError for what is no tally.
Tally parse_tally(const std::string& text);

/// What a complete campaign lacks: kinds that were never injected, guards that never acted, invariants that
/// were never judged.
std::vector<std::string> never_seen(const Tally& tally);

}  // namespace longreach
