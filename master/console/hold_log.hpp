#pragma once
// Log of the holds, stops and faults of a run with their time, duration and cause, including the current one.
// A hold is an event of the run. It is a fault only if it lasts until the end and its cause must be repaired.
// add() does not allocate.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "master/master_node.hpp"

namespace longreach {

struct HoldRecord {
  double began_s = 0.0, lasted_s = 0.0;
  Reason cause{};      // cause at the master
  Reason far_cause{};  // cause at the slave, if it was reported during the hold
  HoldAttribution attribution = HoldAttribution::kProtection;
  bool lasts = false;  // the hold is in progress
};

/// Why the handle has counted as released since `began_s`, with a remedy.
struct HandTrouble {
  double began_s = 0.0;
  std::string text;
};

class HoldLog {
 public:
  /// `outages` is true if the profile of the link specifies outages.
  explicit HoldLog(bool outages = false) : outages_(outages) {}

  /// Adds a sample of the run. `seconds` is the time since the start; it must not decrease.
  void add(double seconds, const MasterView& view);

  /// Returns the number of holds with this attribution, including the current one.
  [[nodiscard]] std::uint64_t count(HoldAttribution attribution) const {
    return counts_[static_cast<std::size_t>(attribution)] + (now() == attribution ? 1 : 0);
  }
  /// Returns the total number of holds, including the current one.
  [[nodiscard]] std::uint64_t count() const;
  /// Returns the attribution of the current hold, or none if there is no hold.
  [[nodiscard]] std::optional<HoldAttribution> now() const {
    return holds_ ? std::optional(attribution(hold_)) : std::nullopt;
  }
  /// Returns the total duration of the holds caused by the machine, s, including the current one.
  [[nodiscard]] double machine_s() const;
  /// A sentence about one hold.
  struct Sentence {
    std::string text;
    HoldAttribution attribution = HoldAttribution::kProtection;
    bool lasts = false;  // the hold is in progress
  };
  /// Returns one sentence for each of the first few holds, including any hold in progress. `hand` contains
  /// the input problems of the run in chronological order. A device fault that starts at the same time as
  /// such a problem is described by the text of the problem.
  [[nodiscard]] std::vector<Sentence> words(const std::vector<HandTrouble>& hand = {}) const;

 private:
  static constexpr std::size_t kKept = 16;
  [[nodiscard]] HoldAttribution attribution(const HoldRecord& hold) const;
  [[nodiscard]] HoldRecord present() const;

  bool outages_;
  bool engaged_ = false, holds_ = false;
  double now_s_ = 0.0, machine_s_ = 0.0;
  HoldRecord hold_{};
  std::array<HoldRecord, kKept> kept_{};
  std::array<std::uint64_t, 5> counts_{};
};

}  // namespace longreach
