#pragma once
// The holds, stops and faults of a run: time, duration and cause, including the present one. A hold caused by
// a busy machine (a control loop that stalled or was late) is not a fault of the system; neither is one by
// the operator, nor an outage that the profile of the link specifies. add() allocates nothing.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "master/master_node.hpp"

namespace longreach {

struct HoldRecord {
  double began_s = 0.0, lasted_s = 0.0;
  Reason cause{};      // at the master
  Reason far_cause{};  // at the slave, as far as it was reported during the hold
  HoldAttribution attribution = HoldAttribution::kSystem;
};

/// Why the handle was released from then on, and a remedy.
struct HandTrouble {
  double began_s = 0.0;
  std::string text;
};

class HoldLog {
 public:
  /// `outages`: the profile of the link specifies outages.
  explicit HoldLog(bool outages = false) : outages_(outages) {}

  /// `seconds` since the start must not fall.
  void add(double seconds, const MasterView& view);

  [[nodiscard]] std::uint64_t count(HoldAttribution attribution) const {
    return counts_[static_cast<std::size_t>(attribution)] + (now() == attribution ? 1 : 0);
  }
  [[nodiscard]] std::uint64_t count() const;
  /// Attribution of the present hold; none: there is no hold.
  [[nodiscard]] std::optional<HoldAttribution> now() const {
    return holds_ ? std::optional(attribution(hold_)) : std::nullopt;
  }
  /// Duration of the holds caused by the machine, including the present one.
  [[nodiscard]] double machine_s() const;
  /// A sentence for each of the first holds, including the present one.
  struct Sentence {
    std::string text;
    bool fault = false;  // of the system
  };
  /// `hand`: troubles of the run, by time. A device fault that begins with one of them is described by its
  /// text.
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
  std::array<std::uint64_t, 4> counts_{};
};

}  // namespace longreach
