#pragma once
// A sender, a link and a playout buffer in virtual time. The goals move along x at 0.1 m/s according to the
// sender's clock.

#include <functional>
#include <vector>

#include "common/link/playout.hpp"

namespace longreach {

constexpr double kGoalSpeedMPerS = 0.1;

struct PlayoutRun {
  PlayoutConfig config{};
  double duration_s = 20.0;
  double period_s = 0.005;
  double tick_s = 0.001;
  double clock_ratio = 1.0;      // seconds on the receiver's clock per second on the sender's
  double clock_offset_s = -1e4;  // the sender's clock minus the receiver's
  /// Returns the one-way delay of the datagram that is sent at `sent_s` after the start, s; negative if the
  /// datagram is lost.
  std::function<double(double sent_s)> delay_s;
};

struct PlayedTick {
  double now_s = 0.0;  // time since the start, on the receiver's clock
  double sequence = 0.0;
  double x_m = 0.0;
  double delay_s = 0.0;
  double newest = 0.0;  // highest sequence number that has arrived
};

inline std::vector<PlayedTick> run(const PlayoutRun& r) {
  struct Flight {
    double due_s = 0.0, sent_s = 0.0;
    std::uint64_t sequence = 0;
  };
  std::vector<Flight> flights;
  std::uint64_t sequence = 0;
  for (; static_cast<double>(sequence) * r.period_s < r.duration_s; ++sequence) {
    const double sent_s = static_cast<double>(sequence) * r.period_s;
    const double delay_s = r.delay_s(sent_s);
    if (delay_s >= 0.0) flights.push_back({sent_s * r.clock_ratio + delay_s, sent_s, sequence + 1});
  }
  std::stable_sort(flights.begin(), flights.end(),
                   [](const Flight& a, const Flight& b) { return a.due_s < b.due_s; });

  Playout playout(r.config);
  std::vector<PlayedTick> ticks;
  std::size_t next = 0;
  double newest = 0.0;
  for (std::int64_t tick = 0;; ++tick) {
    const double now_s = static_cast<double>(tick) * r.tick_s;
    if (now_s > r.duration_s * r.clock_ratio + 1.0 && next == flights.size()) break;
    const Time now{from_seconds(now_s)};
    for (; next < flights.size() && flights[next].due_s <= now_s + 1e-9; ++next) {
      const Flight& f = flights[next];
      Vector3 goal = Vector3::Zero();
      goal.x() = kGoalSpeedMPerS * r.period_s * static_cast<double>(f.sequence);
      playout.push(now, PeerTime{from_seconds(f.sent_s + r.clock_offset_s)}, f.sequence, goal);
      newest = std::max(newest, static_cast<double>(f.sequence));
    }
    if (const auto goal = playout.play(now)) {
      ticks.push_back({now_s, goal->sequence, goal->goal.x(), playout.delay_s(), newest});
    }
  }
  return ticks;
}

}  // namespace longreach
