#pragma once
// The network between the two sides, in the hands of somebody who hears all, may hold back, drop, repeat and
// add, but knows no secret. Each side has a socket that keeps what comes while the side does not run, up to a
// bound, as a system's does.

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

/// What is done to one way, in this tick.
struct DirectionFaults {
  bool cut = false;          // all is lost
  bool held = false;         // all is kept until it is no longer so, then comes at once
  bool late = false;         // likewise, but what is newer comes first
  double delay_s = 0.0;      // more than the link's
  std::uint32_t copies = 0;  // more than the one
  bool swapped = false;      // every other one is overtaken by the next
};

/// One way of the wire.
class WireDirection {
 public:
  explicit WireDirection(Random random) : random_(random) {}

  /// What a side has just sent.
  void take(double now_s, Bytes datagram);
  /// A datagram that nobody has sent arrives.
  void inject(Bytes datagram);
  /// What has come by now goes to the side's socket.
  void pass(double now_s);
  /// All that is kept comes at once: nothing goes wrong any more.
  void release();
  /// Something that was sent comes later than the link would bring it, which outlasts what has delayed it:
  /// what is sent afterwards queues behind it.
  [[nodiscard]] bool keeps_back(double now_s) const { return now_s < kept_until_s_ || !held_.empty(); }
  /// The side reads its socket, not more at a time than it reads.
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
  [[nodiscard]] const std::vector<Bytes>& heard() const { return received_; }  // some of what arrived
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
  double kept_until_s_ = -1e9;  // due time of the last that was delayed
  std::uint64_t oversized_ = 0;
};

}  // namespace longreach
