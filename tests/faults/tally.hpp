#pragma once
// Sum of the results of many trials: the number of injections of each kind of fault, the number of
// activations of each guard, and the numbers of checks and violations of each invariant. Tallies can be
// written, read and added.

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
  std::uint64_t trajectories = 0;  // hash of the trajectories of all trials

  void add(std::uint64_t seed, const Trial& trial);
  void add(const Tally& other);
  /// Adds the result of a check that is not part of a trial (twin.hpp).
  void judge(std::uint64_t seed, const char* invariant, bool good, const char* words);
};

std::string to_text(const Tally& tally);
/// Parses the output of to_text(). Throws a ConfigError for any other text.
Tally parse_tally(const std::string& text);

/// Returns what is missing for a complete campaign: kinds without an injection, guards without an activation,
/// and invariants without a check.
std::vector<std::string> never_seen(const Tally& tally);

}  // namespace longreach
