#pragma once
// Simulates the network as a seeded, pure queue: datagrams are pushed with the current time and, unless they
// were dropped, popped when they are due. The effects act on a datagram in this order: blackout, loss
// (independent or Gilbert-Elliott bursts), corruption (one bit flipped), duplication, rate limit (a queue
// that drops when full), delay with steps, drift and normally distributed jitter (never below zero),
// reordering (a selected datagram passes its predecessors). The laboratory uses this class for its simulated
// link, and both programs use it for the datagrams that they receive.
//
// Jitter is drawn independently for each datagram and therefore changes the order, as in tc netem. Datagrams
// with equal due times keep the order of arrival. Each effect has its own random stream, so that enabling one
// does not change the numbers of another. Memory is bounded: at most 16384 datagrams are queued (others count
// as queue_dropped), and a datagram longer than 600 bytes is truncated to 600, so that every receiver rejects
// it by its length. The origin of each datagram is preserved.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/core/random.hpp"
#include "common/core/time.hpp"
#include "common/link/origin.hpp"
#include "schema/config_common.hpp"

namespace longreach {

/// Counts of pushed datagrams and of the effects on them.
struct ImpairmentCounts {
  std::uint64_t in = 0, out = 0, lost = 0, blacked_out = 0, corrupted = 0, duplicated = 0, queue_dropped = 0,
                reordered = 0;
};

class Impairment {
 public:
  Impairment(const ImpairmentConfig& config, Random random);

  /// Takes effect for datagrams pushed from `now` on. Steps and blackouts are timed from `now`.
  void configure(const ImpairmentConfig& config, Time now);

  void push(Time now, std::span<const std::byte> datagram, const Origin& origin = {});

  /// Returns whether a datagram pushed now would be delivered immediately and unchanged. The caller may then
  /// deliver it directly and count it with pass().
  [[nodiscard]] bool clear() const { return clear_ && heap_.empty(); }
  void pass() { ++counts_.in, ++counts_.out; }

  /// Returns the next due datagram, valid until the next call, or none. Call this repeatedly until it returns
  /// none.
  std::optional<std::span<const std::byte>> pop(Time now);
  /// Returns the origin of the datagram that pop() returned last.
  [[nodiscard]] const Origin& origin() const { return origin_; }

  [[nodiscard]] const ImpairmentConfig& config() const { return config_; }
  [[nodiscard]] const ImpairmentCounts& counts() const { return counts_; }

 private:
  static constexpr std::size_t kSlots = 16384;
  static constexpr std::size_t kSlotBytes = 600;
  static constexpr std::size_t kCopies = 2;

  /// A queued datagram. Its bytes are stored in a slot.
  struct QueuedDatagram {
    Time due{};
    std::uint64_t arrival = 0;  // number of the datagram; orders equal due times
    std::uint32_t slot = 0;
    std::uint32_t size = 0;  // bytes, at most kSlotBytes
    // Orders the heap so that the front element is due first.
    bool operator<(const QueuedDatagram& other) const {
      return due != other.due ? due > other.due : arrival > other.arrival;
    }
  };

  /// Random decisions about one datagram. They are drawn even if an earlier effect drops it, so that the
  /// streams stay independent.
  struct Decision {
    bool lost = false;
    bool corrupted = false;
    bool duplicated = false;
    double flipped = 0.0;                  // position of the flipped bit as a fraction of the datagram
    std::array<double, kCopies> jitter{};  // normal deviates for the original and its copy
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
  Time queue_free_at_{};            // time at which the rate limit will have sent its queue
  std::uint64_t arrivals_ = 0;
  Origin origin_{};
  std::vector<std::byte> bytes_;     // kSlots times kSlotBytes
  std::vector<Origin> origins_;      // one per slot
  std::vector<std::uint32_t> free_;  // unused slots
  std::vector<QueuedDatagram> heap_;
};

}  // namespace longreach
