#pragma once
// The network between the two sides, controlled by an attacker who receives every datagram and can delay,
// drop, repeat and add datagrams, but does not know the secrets. Each side has a socket. While a side does
// not run, its socket buffers datagrams up to a limit, as an operating system does.

#include <algorithm>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "common/core/random.hpp"
#include "common/wire/memory_channel.hpp"
#include "common/wire/port.hpp"

namespace longreach {

using Bytes = std::vector<std::byte>;

/// Faults of one direction in this tick.
struct DirectionFaults {
  bool cut = false;          // all datagrams are lost
  bool held = false;         // all datagrams are held and arrive together when the fault ends
  bool late = false;         // like `held`, but the newest datagram arrives first
  double delay_s = 0.0;      // delay in addition to that of the link
  std::uint32_t copies = 0;  // number of additional copies of each datagram
  bool swapped = false;      // each pair of datagrams arrives in swapped order
};

/// One direction of the network.
class WireDirection {
 public:
  explicit WireDirection(Random random) : random_(random) {}

  /// Accepts a datagram that a side has just sent.
  void take(double now_s, Bytes datagram);
  /// Adds a datagram that was never sent.
  void inject(Bytes datagram);
  /// Passes the datagrams that have arrived by now to the socket of the side.
  void pass(double now_s);
  /// Delivers all held datagrams. Call this after the last fault.
  void release();
  /// Returns whether datagrams arrive later than the link alone would deliver them. The delay outlasts its
  /// cause because later datagrams queue behind the delayed ones.
  [[nodiscard]] bool keeps_back(double now_s) const { return now_s < kept_until_s_ || !held_.empty(); }
  /// Reads the socket on behalf of the side: calls read() for each datagram, at most kRead times.
  template <class Read>
  void empty(Read&& read) {
    const std::size_t count = std::min(socket_.size(), kRead);
    for (std::size_t i = 0; i < count; ++i) {
      oversized_ += socket_[i].size() > kDatagramMaxBytes ? 1 : 0;
      read(socket_[i]);
    }
    socket_.erase(socket_.begin(), socket_.begin() + static_cast<std::ptrdiff_t>(count));
  }

  DirectionFaults direction_faults{};
  /// A sample of the datagrams that arrived.
  [[nodiscard]] const std::vector<Bytes>& heard() const { return received_; }
  /// Number of oversized datagrams that were read.
  [[nodiscard]] std::uint64_t oversized() const { return oversized_; }

 private:
  static constexpr std::size_t kSocket = 2048, kRead = kDatagramsPerReceive, kReceived = 512, kKept = 20000;
  static constexpr double kNever = std::numeric_limits<double>::infinity();
  struct Kept {
    double due_s;
    Bytes datagram;
  };
  void arrive(Bytes datagram);
  void store(Bytes datagram);

  Random random_;
  std::deque<Kept> line_;  // ordered by due time
  std::deque<Bytes> held_;
  std::vector<Bytes> socket_;
  std::vector<Bytes> received_;
  std::optional<Bytes> swapped_;
  double release_s_ = 0.0;      // due time of held datagrams
  double kept_until_s_ = -1e9;  // due time of the last delayed datagram
  std::uint64_t oversized_ = 0;
};

}  // namespace longreach
