#pragma once
// Turns jittery arrivals into a smooth goal. Goals are played at earliest arrival + playout delay, linearly
// interpolated between sequences; on silence the last goal is held. A larger delay gives smoother but later
// motion. The delay is fixed, or the `quantile` of the lateness in the last 5 s (adaptive; lateness beyond
// `delay_max_s` is ignored). It changes by at most 0.05 s/s while goals are played, so that the goal does not
// jump. A goal that is later than the delay is played on arrival. If the transit time of the link falls by
// more than 0.25 s at once, the delay follows immediately. The class also stores recent goals, to find the
// command that led to a given position.
//
// Orientation is not handled separately: a goal is a 6-vector [position_m; rotation_rad] from the anchor.

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "common/core/ring.hpp"
#include "common/core/time.hpp"
#include "common/link/clock_offset.hpp"
#include "common/spatial/spatial.hpp"

namespace longreach {

struct PlayoutConfig {
  bool adaptive = true;         // choose the delay from the measured lateness
  double fixed_delay_s = 0.02;  // used when not adaptive, 0 to 2
  double quantile = 0.9;        // of lateness, when adaptive
  double delay_max_s = 0.5;     // adaptive delay never exceeds this
};

/// A goal with the command that it belongs to.
struct PlayoutGoal {
  double sequence = 0.0;           // fractional between two commands
  Vector6 goal = Vector6::Zero();  // [position_m; rotation_rad]
};

class Playout {
 public:
  explicit Playout(const PlayoutConfig& config = {});

  void configure(const PlayoutConfig& config) { config_ = config; }

  /// Adds a goal. Old, reordered goals fill gaps of the past; duplicates change nothing.
  void push(Time received, PeerTime sent, std::uint64_t sequence, const Vector6& goal);

  /// Returns the goal to follow now; none before the first push. Never returns to an older sequence.
  std::optional<PlayoutGoal> play(Time now);

  /// Returns the fractional sequence of the newest goal, not after `last_sequence`, that crosses the plane
  /// through `point_m` with normal `n` (unit): where n . (position - point) changes its sign from negative,
  /// or is nearest to zero; none if that is further than `most_m` from it.
  [[nodiscard]] std::optional<double> crossing(const Vector3& n, const Vector3& point_m, double last_sequence,
                                               double most_m = std::numeric_limits<double>::infinity()) const;

  [[nodiscard]] double delay_s() const;  // playout delay in use
  void clear();

 private:
  struct Entry {
    std::uint64_t sequence = 0;
    PeerTime sent{};
    Vector6 goal = Vector6::Zero();
  };
  struct Lateness {
    Time received{};
    std::int64_t transit_ns = 0;  // received - sent, across two clocks
    std::int64_t late_ns = 0;     // beyond the earliest arrival known at that time
  };

  bool insert(const Entry& entry);
  void book_lateness(Time received, PeerTime sent);
  void adapt(Time now);
  [[nodiscard]] Duration offset() const;
  [[nodiscard]] Duration wanted_delay(Time now);
  [[nodiscard]] Duration lateness_quantile();
  [[nodiscard]] PlayoutGoal goal_at(PeerTime instant) const;
  [[nodiscard]] std::size_t first_beyond(double sequence) const;

  PlayoutConfig config_;
  ClockOffset offset_;
  Ring<Entry> entries_;      // ascending in sequence
  Ring<Lateness> lateness_;  // of the last 5 s
  std::vector<std::int64_t> scratch_;
  Duration lag_{0};       // now - lag_ is the send time of the goal played now: offset + playout delay
  Duration quantile_{0};  // adaptive delay as last computed
  std::optional<Time> quantile_at_{};  // time of that computation
  std::optional<Time> stepped_at_{};   // last play()
  std::optional<PlayoutGoal> played_{};
};

}  // namespace longreach
