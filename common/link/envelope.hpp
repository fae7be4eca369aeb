#pragma once
// What every datagram carries besides its message, and what a receiver learns with a message.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "common/core/time.hpp"

namespace longreach {

enum class DatagramType : std::uint8_t { kMotionCommand = 1, kStiffnessReport = 2, kTelemetry = 3 };
constexpr std::size_t kDatagramTypes = 3;

/// Identifies a datagram. `session` is common to both sides; `sequence` grows with each datagram of a type.
struct Header {
  DatagramType type = DatagramType::kMotionCommand;
  std::uint64_t session = 0;
  std::uint64_t sequence = 0;
};

/// What the sender had last heard in this session, so that the receiver can date it with its own clock.
struct Echo {
  std::int64_t sent_ns = 0;  // its send time, on the clock of the one who sent it
  Duration held{0};          // how long it lay at the echoing side before this datagram left
};

/// The part of a datagram's body that is common to all messages.
struct Stamp {
  PeerTime sent{};             // sender's clock
  std::optional<Echo> echo{};  // none: no datagram yet
};

constexpr Duration kNoRtt{-1};  // a round trip that is not known; so is any below zero

/// A message with what its receiver knows about the way it came.
template <class Message>
struct Received {
  std::uint64_t sequence = 0;
  PeerTime sent{};                  // on the sender's clock
  Time received{};                  // on this clock
  std::optional<Time> echo_sent{};  // when this side had sent what the peer had last heard; none: not yet
  Duration rtt = kNoRtt;            // from then until now, without the time that it lay at the peer
  bool newest = true;               // no newer one of its type came before it
  Message message{};
};

/// Why a datagram was dropped. Order of the checks. Before authentication nothing changes but a counter.
enum class Rejection : std::uint8_t {
  kLength,          // shorter than header and tag, or longer than 508 bytes
  kVersion,         // other wire version
  kType,            // not a type that this side receives
  kSession,         // not of the present session
  kReplay,          // seen already, or too old to tell
  kAuthentication,  // damaged, or not sealed by the other side
  kDecode,          // body is not the message that the header promises
  kValue,           // a field is missing, not finite or out of range
  kStalled,         // lay there while this side stood still: too old to follow
  kCount
};

constexpr std::size_t kRejectionCount = static_cast<std::size_t>(Rejection::kCount);
using RejectionCounts = std::array<std::uint64_t, kRejectionCount>;

constexpr std::string_view to_string(Rejection r) {
  constexpr std::array<std::string_view, kRejectionCount> kNames = {
      "length", "version", "type", "session", "replay", "authentication", "decode", "value", "stalled"};
  return r < Rejection::kCount ? kNames[static_cast<std::size_t>(r)] : "unknown";
}

}  // namespace longreach
