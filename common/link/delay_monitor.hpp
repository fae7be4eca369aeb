#pragma once
// Measures the link as seen from one side: round-trip time, variation of the one-way delay, packet loss,
// reordering and age of the data. The round-trip time of a sample is now - echo.sent - echo.held, all on the
// clock of this side except the duration `held`. The one-way variation is relative to the running minimum of
// (received - sent), so that the unknown clock offset cancels. The windows are short (2 s), so that changes
// in the link become visible quickly. The class is pure: the caller supplies the time.
//
// Loss is 1 - received / sent over the datagrams that the peer sent in a window of 2 s, derived from the gaps
// in the sequence numbers of each type. A datagram that was overtaken does not count as lost. Therefore, if
// datagrams overtake each other, the window ends earlier, by the observed lateness of the overtaken datagrams
// (up to 1 s). Datagrams sent before the first one received in a session, or in a stall of this side, are not counted.
//
// A datagram that was sent more than 0.5 s earlier than one that has already arrived does not show that the
// peer is alive. It therefore counts in all statistics except the time of the last datagram.

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
  std::optional<double> rtt_s{};  // median over the window; none until an echo has arrived
  double rtt_min_s = 0.0;         // minimum over the window
  double jitter_s = 0.0;          // standard deviation of the one-way delay over the window
  double loss = 0.0;              // fraction of the datagrams in the window that did not arrive
  double reorder = 0.0;           // fraction that arrived after a newer datagram of the same type
  /// Time since this side sent the newest datagram that the peer has received; none until an echo has arrived.
  std::optional<double> age_s{};
  double silence_s = 0.0;    // since the last accepted datagram; infinite before the first
  double rate_hz = 0.0;      // accepted datagrams per second
  double bytes_per_s = 0.0;  // accepted bytes per second, without UDP and IP headers
};

class DelayMonitor {
 public:
  DelayMonitor();

  /// Records an accepted datagram of `bytes` bytes. `rtt` is its round-trip time, or negative if unknown.
  void on_datagram(Time now, const Header& header, PeerTime sent, Duration rtt, std::size_t bytes);

  /// This side was stalled: what was sent before the next datagram of each type does not count as lost.
  void skip_stall() { skips_.fill(true); }

  /// Records the time at which this side sent the newest datagram that the peer has received.
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
    bool late = false;      // arrived after a newer datagram of the same type
    bool operator==(const Sample&) const = default;
  };
  /// Sequence number and send time of a datagram; sequence 0 means none.
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
  std::array<bool, kDatagramTypes> skips_{};  // the next datagram is the first that counts for the loss
  std::array<std::uint64_t, kDatagramTypes> skipped_{};  // sequences up to this one do not count for the loss
  std::optional<PeerTime> newest_sent_{};                // latest send time, over all types
  /// For each type, the sample with the highest sequence number that has left the ring.
  std::array<Mark, kDatagramTypes> forgotten_{};
  std::optional<Time> first_received_{};
  std::optional<Time> last_heard_{};
  std::optional<Time> echoed_{};  // send time of the newest datagram of this side that was echoed
};

}  // namespace longreach
