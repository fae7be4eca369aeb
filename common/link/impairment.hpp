#pragma once
// The network as a seeded, pure queue: bytes go in with the time, and come out, or not, when their time has come.
// Effects, in the order in which they act on a datagram: blackout, loss (independent or Gilbert-Elliott bursts),
// corruption (one bit flipped), duplication, rate limit (a queue that drops when full), delay with steps, drift and
// normal jitter (never below zero), reordering (a chosen datagram is let past its predecessors).
// The same object serves the laboratory and, on the receiving side, the real UDP channel of both programs.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/core/random.hpp"
#include "common/core/time.hpp"

namespace longreach {

/// One direction of a link. All times one-way.
struct ImpairmentConfig {
  double delay_s = 0.0;             // 0 to 100
  double jitter_s = 0.0;            // standard deviation, 0 to 10
  double loss = 0.0;                // mean fraction lost, 0 to 1
  double loss_burst = 1.0;          // mean length of a loss burst in datagrams; 1: independent losses
  double duplicate = 0.0;           // fraction sent twice
  double reorder = 0.0;             // fraction let past: delivered with half of the delay
  double corrupt = 0.0;             // fraction with one bit flipped
  double rate_bit_per_s = 0.0;      // 0: unlimited
  double queue_s = 0.2;             // longest queue before the rate limit drops
  double step_delay_s = 0.0;        // added to the delay while the step lasts
  double step_start_s = 0.0;        // start of the step, after the profile was set
  double step_duration_s = 0.0;     // 0: no step
  double drift_s_per_s = 0.0;       // change of delay with time (range rate over c)
  double blackout_start_s = 0.0;    // first loss of signal, after the profile was set
  double blackout_duration_s = 0.0; // 0: none
  double blackout_period_s = 0.0;   // repeat; 0: once
};

/// What happened to the datagrams that were pushed.
struct ImpairmentCounts {
  std::uint64_t in = 0, out = 0, lost = 0, blacked_out = 0, corrupted = 0, duplicated = 0, queue_dropped = 0,
                reordered = 0;
};

class Impairment {
 public:
  Impairment(const ImpairmentConfig& config, Random random);

  /// Takes effect for the datagrams pushed from `now` on; the clock of steps and blackouts starts anew.
  void configure(const ImpairmentConfig& config, Time now);

  void push(Time now, std::span<const std::byte> datagram);

  /// The next datagram that is due, or none. Valid until the next call. Call until none.
  std::optional<std::span<const std::byte>> pop(Time now);

  [[nodiscard]] const ImpairmentConfig& config() const { return config_; }
  [[nodiscard]] const ImpairmentCounts& counts() const { return counts_; }

 private:
  struct Parcel;                    // bytes with their due time: fixed slots, allocated once
  // implementation's choice: a bounded heap of slots ordered by (due time, arrival number)
};

}  // namespace longreach
