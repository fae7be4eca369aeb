#pragma once
// The network as a seeded, pure queue: datagrams are pushed with the time, and popped, or dropped, when they
// are due. Effects, in the order in which they act on a datagram: blackout, loss (independent or
// Gilbert-Elliott bursts), corruption (one bit flipped), duplication, rate limit (a queue that drops when
// full), delay with steps, drift and normal jitter (never below zero), reordering (a chosen datagram passes
// its predecessors). The same class serves the laboratory and, on the receiving side, the real UDP channel of
// both programs.
//
// Jitter is drawn for each datagram independently, so that it changes the order, as in tc netem. Equal due
// times keep the order of arrival. Each effect has its own random stream: enabling one does not change the
// numbers of another. Bounded: 16384 queued datagrams (more count as queue_dropped), each with up to 600
// bytes: longer ones are truncated to 600, which every receiver rejects by their length. A datagram keeps its
// origin.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/core/random.hpp"
#include "common/core/time.hpp"
#include "common/link/origin.hpp"

namespace longreach {

/// One direction of a link. All times one-way.
struct ImpairmentConfig {
  double delay_s = 0.0;           // 0 to 100
  double jitter_s = 0.0;          // standard deviation, 0 to 10
  double loss = 0.0;              // mean fraction of lost datagrams, 0 to 1
  double loss_burst = 1.0;        // mean length of a loss burst in datagrams; 1: independent losses
  double duplicate = 0.0;         // fraction of duplicated datagrams
  double reorder = 0.0;           // fraction that passes its predecessors: delivered with half of the delay
  double corrupt = 0.0;           // fraction with one bit flipped
  double rate_bit_per_s = 0.0;    // 0: unlimited
  double queue_s = 0.2;           // longest queue before the rate limit drops
  double step_delay_s = 0.0;      // added to the delay while the step lasts
  double step_start_s = 0.0;      // start of the step, after the profile was set
  double step_duration_s = 0.0;   // 0: no step
  double drift_s_per_s = 0.0;     // change of delay with time (range rate over c)
  double blackout_start_s = 0.0;  // first loss of signal, after the profile was set
  double blackout_duration_s = 0.0;  // 0: none
  double blackout_period_s = 0.0;    // repeat; 0: once

  bool operator==(const ImpairmentConfig&) const = default;
};

/// What happened to the datagrams that were pushed.
struct ImpairmentCounts {
  std::uint64_t in = 0, out = 0, lost = 0, blacked_out = 0, corrupted = 0, duplicated = 0, queue_dropped = 0,
                reordered = 0;
};

class Impairment {
 public:
  Impairment(const ImpairmentConfig& config, Random random);

  /// Takes effect for datagrams pushed from `now` on; the time of steps and blackouts restarts.
  void configure(const ImpairmentConfig& config, Time now);

  void push(Time now, std::span<const std::byte> datagram, const Origin& origin = {});

  /// Returns whether a datagram pushed now would be delivered immediately and unchanged; pass() can then
  /// count it instead.
  [[nodiscard]] bool clear() const { return clear_ && heap_.empty(); }
  void pass() { ++counts_.in, ++counts_.out; }

  /// Returns the next due datagram, or none. Valid until the next call. Call until it returns none.
  std::optional<std::span<const std::byte>> pop(Time now);
  /// Origin of the datagram that pop() returned last.
  [[nodiscard]] const Origin& origin() const { return origin_; }

  [[nodiscard]] const ImpairmentConfig& config() const { return config_; }
  [[nodiscard]] const ImpairmentCounts& counts() const { return counts_; }

 private:
  static constexpr std::size_t kSlots = 16384;
  static constexpr std::size_t kSlotBytes = 600;
  static constexpr std::size_t kCopies = 2;

  /// A queued datagram; its bytes are in a slot.
  struct QueuedDatagram {
    Time due{};
    std::uint64_t arrival = 0;  // counts queued datagrams: keeps the order of equal due times
    std::uint32_t slot = 0;
    std::uint32_t size = 0;  // bytes, at most kSlotBytes
    // Orders a heap whose front is due first.
    bool operator<(const QueuedDatagram& other) const {
      return due != other.due ? due > other.due : arrival > other.arrival;
    }
  };

  /// Random decisions about one datagram, also if another effect has dropped it before.
  struct Decision {
    bool lost = false;
    bool corrupted = false;
    bool duplicated = false;
    double flipped = 0.0;                  // position of the flipped bit, fraction of the datagram
    std::array<double, kCopies> jitter{};  // normal deviates of the original and of its copy
    std::array<bool, kCopies> let_past{};
  };
  struct Streams {
    Random loss, corrupt, duplicate;
    std::array<Random, kCopies> jitter, reorder;
  };

  Decision draw_decision();
  bool draw_loss();
  void start_clock(Time now);
  [[nodiscard]] bool blacked_out(double t_s) const;
  [[nodiscard]] double base_delay_s(double t_s) const;
  std::optional<Time> leave_queue(Time now, std::size_t bytes);
  bool store(Time due, std::span<const std::byte> datagram, const Origin& origin, const Decision& decision);

  ImpairmentConfig config_;
  bool clear_ = false;  // no effect is active
  ImpairmentCounts counts_{};
  Streams streams_;
  std::optional<bool> in_burst_{};  // Gilbert-Elliott state; none before the first draw
  std::optional<Time> set_at_{};    // when the profile took effect; none before the first push or pop
  Time queue_free_at_{};            // when the rate limit has sent its queue
  std::uint64_t arrivals_ = 0;
  Origin origin_{};
  std::vector<std::byte> bytes_;     // kSlots times kSlotBytes
  std::vector<Origin> origins_;      // one per slot
  std::vector<std::uint32_t> free_;  // slots without a datagram
  std::vector<QueuedDatagram> heap_;
};

}  // namespace longreach
