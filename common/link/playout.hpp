#pragma once
// Turns jittery arrivals into a smooth goal. Goals are played at earliest arrival + playout delay, linearly
// interpolated between sequences; on silence the last goal is held. More delay: smoother motion, later.
// The delay is fixed, or the `quantile` of the lateness seen in the last seconds (adaptive).
// Also keeps the recent goals, to answer which command led to a given place.
//
// Does not handle orientation separately: a goal is a 6-vector [position_m; rotation_rad] from the anchor.

#include <cstdint>
#include <optional>

#include "common/core/ring.hpp"
#include "common/core/time.hpp"
#include "common/link/clock_offset.hpp"
#include "common/spatial/spatial.hpp"

namespace longreach {

struct PlayoutConfig {
  bool adaptive = true;         // choose the delay from the lateness seen
  double fixed_delay_s = 0.02;  // used when not adaptive, 0 to 2
  double quantile = 0.99;       // of lateness, when adaptive
  double delay_max_s = 0.5;     // adaptive delay never exceeds this
};

/// A goal with the command that it came from.
struct PlayoutGoal {
  double sequence = 0.0;            // fractional between two commands
  Vector6 goal = Vector6::Zero();   // [position_m; rotation_rad]
};

class Playout {
 public:
  explicit Playout(const PlayoutConfig& config = {});

  void configure(const PlayoutConfig& config) { config_ = config; }

  /// Books a goal. Old, reordered ones fill gaps of the past; duplicates change nothing.
  void push(Time received, PeerTime sent, std::uint64_t sequence, const Vector6& goal);

  /// The goal to follow now; none before the first push. Never moves back to an older sequence.
  std::optional<PlayoutGoal> play(Time now);

  /// Fractional sequence of the newest goal, not after `last_sequence`, that crosses the plane through `point_m`
  /// with normal `n` (unit): where n . (position - point) changes its sign from negative, or is nearest to zero.
  [[nodiscard]] std::optional<double> crossing(const Vector3& n, const Vector3& point_m, double last_sequence) const;

  [[nodiscard]] double delay_s() const { return delay_s_; }   // playout delay in use
  void clear();

 private:
  struct Entry {
    std::uint64_t sequence = 0;
    Time due{};                       // earliest arrival, without the playout delay
    Vector6 goal = Vector6::Zero();
  };
  PlayoutConfig config_;
  ClockOffset offset_;
  Ring<Entry> entries_;               // ascending in sequence
  Ring<double> lateness_s_;           // arrival minus earliest arrival, last few seconds
  double delay_s_ = 0.0;
  double played_ = 0.0;               // fractional sequence played last
};

}  // namespace longreach
