#pragma once
// The jitter buffer, which turns jittery arrivals into a smooth goal. A goal is played at its earliest
// arrival time plus the playout delay, with linear interpolation between commands. If no newer goal has
// arrived, the last one is held. A larger delay gives smoother but later motion. The delay is either fixed or
// adaptive: the `quantile` of the lateness over the last 5 s, where lateness beyond `delay_max_s` is ignored.
// While goals are played, the delay changes by at most 0.05 s/s, so that the goal does not jump. A goal that
// misses its playout time is played on arrival. If the transit time of the link suddenly decreases by more
// than 0.25 s, the delay follows immediately. The class also stores recent goals, so that the command at a
// given position can be found.
//
// A goal is a position or a rotation vector relative to the anchor; each of the two has a buffer of its own, since a
// command carries one of them.

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "common/core/ring.hpp"
#include "common/core/time.hpp"
#include "common/link/clock_offset.hpp"
#include "common/spatial/spatial.hpp"
#include "schema/config_common.hpp"

namespace longreach {

/// A goal with the sequence number of its command.
struct PlayoutGoal {
  double sequence = 0.0;           // fractional between two commands
  Vector3 goal = Vector3::Zero();  // m or rad
};

class Playout {
 public:
  explicit Playout(const PlayoutConfig& config = {});

  void configure(const PlayoutConfig& config) { config_ = config; }

  /// Adds the goal of command `sequence`. Old, reordered goals fill gaps in the history; duplicates change
  /// nothing.
  void push(Time received, PeerTime sent, std::uint64_t sequence, const Vector3& goal);

  /// Returns the goal to follow at `now`; none before the first push. The sequence numbers of successive
  /// results never decrease.
  std::optional<PlayoutGoal> play(Time now);

  /// Returns the fractional sequence number, at most `last_sequence`, at which the goal most recently crossed
  /// the plane through `point` with unit normal `n`, so that n . (goal - point) became positive; none if
  /// a command is missing there. If it never did, returns the number at which it was nearest, or none if that
  /// distance is `most` or more. `n`, `point` and `most` are in the frame of the goals.
  [[nodiscard]] std::optional<double> crossing(const Vector3& n, const Vector3& point, double last_sequence,
                                               double most = std::numeric_limits<double>::infinity()) const;

  [[nodiscard]] double delay_s() const;  // current playout delay
  void clear();

 private:
  struct Entry {
    std::uint64_t sequence = 0;
    PeerTime sent{};
    Vector3 goal = Vector3::Zero();
  };
  struct Lateness {
    Time received{};
    std::int64_t transit_ns = 0;  // received - sent; the two times are from different clocks
    std::int64_t late_ns = 0;     // lateness relative to the earliest arrival known at that time
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
  Ring<Entry> entries_;      // in ascending order of sequence
  Ring<Lateness> lateness_;  // samples of the last 5 s
  std::vector<std::int64_t> scratch_;
  Duration lag_{0};       // offset + playout delay; now - lag_ is the send time of the goal played now
  Duration quantile_{0};  // last computed adaptive delay
  std::optional<Time> quantile_at_{};  // time of that computation
  std::optional<Time> stepped_at_{};   // time of the last play()
  std::optional<PlayoutGoal> played_{};
};

}  // namespace longreach
