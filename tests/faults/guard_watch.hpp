#pragma once
// Counts how often each guard of the product acted. These actions are observed from outside, through causes
// in the reports, clamps in the telemetry, and refusals in the counters of the ports. A campaign in which a
// guard never acted has not tested it.

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tests/faults/world.hpp"

namespace longreach {

/// Returns the names of all guards that a campaign must activate.
std::vector<std::string> guard_names();

class GuardWatch {
 public:
  void see(const World& world, const Moment& moment);
  void end(const World& world);
  [[nodiscard]] const std::map<std::string, std::uint64_t>& acted() const { return acted_; }

 private:
  void clamps(const Telemetry& reported);

  std::map<std::string, std::uint64_t> acted_;
  HoldCause far_ = HoldCause::kNone, near_ = HoldCause::kNone;
  std::array<bool, 8> clamped_{};
  bool watchdog_ = false, hand_ = false, injecting_ = false;
};

}  // namespace longreach
