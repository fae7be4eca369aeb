#pragma once
// Bounds the effect of keys that arrive in a burst, for example after the terminal or this program has stalled. In one
// poll at most as many keys count as a keyboard that repeats 30 times a second gives since the last poll, plus 5. After a
// poll that came more than 0.2 s late, the keys that were waiting are dropped: they were meant for a situation that is
// over. While another hand has the handle, no keys count. Stop, quit and help always count.

#include <cstdint>

#include "master/input/keys.hpp"

namespace longreach {

class KeyAllowance {
 public:
  enum class Why : std::uint8_t { kNone, kBurst, kLate, kElsewhere };

  /// Starts a poll, `since_s` after the previous one. `elsewhere`: another hand has the handle.
  void poll(double since_s, bool elsewhere) {
    constexpr double kRepeat_hz = 30.0, kLate_s = 0.22, kExtra = 5.0;
    now_ = elsewhere ? Why::kElsewhere : since_s > kLate_s ? Why::kLate : Why::kBurst;
    left_ = now_ == Why::kBurst ? static_cast<int>(kRepeat_hz * since_s + kExtra) : 0;
    if (dropped_ > 0 && (shown_s_ -= since_s) <= 0.0) dropped_ = 0, why_ = Why::kNone;
  }
  /// Returns whether a key counts.
  bool takes(const Key& key) {
    constexpr double kShown_s = 5.0;
    if (key.action == KeyAction::kStop || key.action == KeyAction::kQuit || key.action == KeyAction::kHelp)
      return true;
    if (left_ > 0) return --left_, true;
    if (why_ != now_) dropped_ = 0;
    why_ = now_;
    ++dropped_;
    shown_s_ = kShown_s;
    return false;
  }
  /// Number of keys dropped for the reason why(), until none was dropped for 5 s.
  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }
  [[nodiscard]] Why why() const { return why_; }

 private:
  int left_ = 0;
  Why now_ = Why::kNone, why_ = Why::kNone;
  std::uint64_t dropped_ = 0;
  double shown_s_ = 0.0;
};

}  // namespace longreach
