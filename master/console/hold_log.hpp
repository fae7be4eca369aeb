#pragma once
// The holds, stops and faults of a run: when, for how long, and what caused them. The present one counts. A
// hold that a busy machine caused (a control loop that stalled or ran late) is not a fault of the system;
// neither is one by the operator, nor one by an outage that the link's profile has. add() allocates nothing.

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
  Reason far_cause{};  // at the slave, as far as it was reported meanwhile
  HoldAttribution attribution = HoldAttribution::kSystem;
};

/// Why there was nothing in the hand from then on, and what to do, in words.
struct HandTrouble {
  double began_s = 0.0;
  std::string text;
};

class HoldLog {
 public:
  /// `outages`: the link's profile has some.
  explicit HoldLog(bool outages = false) : outages_(outages) {}

  /// `seconds` since the start must not fall.
  void add(double seconds, const MasterView& view);

  [[nodiscard]] std::uint64_t count(HoldAttribution attribution) const {
    return counts_[static_cast<std::size_t>(attribution)] + (now() == attribution ? 1 : 0);
  }
  [[nodiscard]] std::uint64_t count() const;
  /// Of the present hold; none: there is none.
  [[nodiscard]] std::optional<HoldAttribution> now() const {
    return holds_ ? std::optional(attribution(hold_)) : std::nullopt;
  }
  /// Time of the holds that the machine caused, the present one included.
  [[nodiscard]] double machine_s() const;
  /// A sentence for each of the first holds; the present one is among them.
  struct Sentence {
    std::string text;
    bool fault = false;  // of the system
  };
  /// `hand`: of the run, by time. A fault of the device that begins with one of them is told in its words.
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
