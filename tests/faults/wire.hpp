#pragma once
// The network between the two sides, under the control of an attacker who receives everything and can delay,
// drop, repeat and add datagrams, but does not know the secrets. Each side has a socket that buffers
// datagrams while the side does not run, up to a limit, as an operating system does.

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
  bool cut = false;          // everything is lost
  bool held = false;         // everything is kept until this ends, then arrives at once
  bool late = false;         // likewise, but the newest arrives first
  double delay_s = 0.0;      // in addition to the delay of the link
  std::uint32_t copies = 0;  // additional copies
  bool swapped = false;      // every other datagram is overtaken by the next one
};

/// One direction of the network.
class WireDirection {
 public:
  explicit WireDirection(Random random) : random_(random) {}

  /// Accepts what a side has just sent.
  void take(double now_s, Bytes datagram);
  /// Adds a datagram that was never sent.
  void inject(Bytes datagram);
  /// Passes what has arrived by now to the socket of the side.
  void pass(double now_s);
  /// Delivers everything that is kept; there are no faults from now on.
  void release();
  /// Returns whether a sent datagram arrives later than the link would deliver it. This outlasts the cause of
  /// the delay, since later datagrams queue behind it.
  [[nodiscard]] bool keeps_back(double now_s) const { return now_s < kept_until_s_ || !held_.empty(); }
  /// The side reads its socket, with its limit per read.
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
  [[nodiscard]] const std::vector<Bytes>& heard() const { return received_; }  // a part of what arrived
  [[nodiscard]] std::uint64_t oversized() const { return oversized_; }         // of those that were read

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
  std::deque<Kept> line_;  // in the order of their due times
  std::deque<Bytes> held_;
  std::vector<Bytes> socket_;
  std::vector<Bytes> received_;
  std::optional<Bytes> swapped_;
  double release_s_ = 0.0;      // of what is held
  double kept_until_s_ = -1e9;  // due time of the last delayed datagram
  std::uint64_t oversized_ = 0;
};

}  // namespace longreach
