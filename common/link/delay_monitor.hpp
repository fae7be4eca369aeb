#pragma once
// What the link is like, seen from one side: round-trip time, variation of the one-way time, loss,
// reordering, age. RTT of a sample = now - echo.sent - echo.held, all but `held` on this side's clock; `held`
// is a duration of the peer's. One-way variation is taken about the running minimum of (received - sent),
// whose unknown clock offset cancels. Windows are short (2 s) so that a changed link shows at once. Pure:
// time comes in.
//
// Loss is 1 - came / sent over the datagrams that the peer sent in a window of 2 s, by the gaps of each
// type's numbers. A datagram that was overtaken is not lost: where that happens, the window ends as much
// earlier (up to 1 s) as the overtaken were late. Does not count what was sent before the first datagram of a
// session.
//
// A datagram that the peer sent more than 0.5 s before another that came already counts in all figures, but
// is not heard: it tells nothing of the peer's life.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/core/ring.hpp"
#include "common/core/time.hpp"
#include "common/link/envelope.hpp"

namespace longreach {

struct LinkFigures {
  std::optional<double> rtt_s{};  // median of the window; none until an echo came
  double rtt_min_s = 0.0;         // least of the window
  double jitter_s = 0.0;          // standard deviation of the one-way time over the window
  double loss = 0.0;              // fraction of the datagrams of the window that never came
  double reorder = 0.0;           // fraction that came after a newer one of its type
  std::optional<double>
      age_s{};               // since this side sent what the peer had last heard; none until an echo came
  double silence_s = 0.0;    // since the last accepted datagram (infinite before the first)
  double rate_hz = 0.0;      // accepted datagrams a second
  double bytes_per_s = 0.0;  // accepted bytes a second, without UDP and IP headers
};

class DelayMonitor {
 public:
  DelayMonitor();

  /// Books an accepted datagram. `rtt`: below zero where its echo did not allow to compute one.
  void on_datagram(Time now, const Header& header, PeerTime sent, Duration rtt, std::size_t bytes);

  /// Books when this side had sent what the peer had last heard.
  void on_echo(Time sent) { echoed_ = std::max(echoed_.value_or(sent), sent); }

  [[nodiscard]] LinkFigures figures(Time now) const;
  [[nodiscard]] std::optional<Time> last_heard() const { return last_heard_; }
  void clear();

  bool operator==(const DelayMonitor&) const = default;

 private:
  struct Sample {
    Time received{};
    PeerTime sent{};
    Duration rtt = kNoRtt;
    std::uint64_t sequence = 0;
    std::uint32_t bytes = 0;
    std::uint8_t type = 0;  // index, 0 to kDatagramTypes - 1
    bool late = false;      // came after a newer one of its type
    bool operator==(const Sample&) const = default;
  };
  /// Place of a datagram in its type's numbers; sequence 0: none.
  struct Mark {
    std::uint64_t sequence = 0;
    PeerTime sent{};
    bool operator==(const Mark&) const = default;
  };

  [[nodiscard]] std::size_t first_since(Time t) const;
  [[nodiscard]] Duration settling(std::size_t first) const;
  [[nodiscard]] double loss(std::size_t first) const;

  Ring<Sample> samples_;
  mutable std::vector<std::int64_t> scratch_;
  std::array<std::uint64_t, kDatagramTypes> newest_{};  // highest sequence of each type
  std::optional<PeerTime> newest_sent_{};               // of all types
  std::array<Mark, kDatagramTypes>
      forgotten_{};  // of the samples that left the ring, the one with the highest sequence
  std::optional<Time> first_received_{};
  std::optional<Time> last_heard_{};
  std::optional<Time> echoed_{};  // when this side had sent the newest that came back
};

}  // namespace longreach
