#pragma once
// Content that all datagrams have in common, and the metadata that accompanies a received message.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "common/core/time.hpp"

namespace longreach {

enum class DatagramType : std::uint8_t {
  kMotionCommand = 1,
  kStiffnessReport = 2,
  kTelemetry = 3,
  kBodyPoses = 4
};
constexpr std::size_t kDatagramTypes = 4;

/// Identifies a datagram. Both sides use the same `session`; `sequence` increases with each datagram of a
/// type.
struct Header {
  DatagramType type = DatagramType::kMotionCommand;
  std::uint64_t session = 0;
  std::uint64_t sequence = 0;
};

/// Echo of the newest datagram that the sender had received in this session. The echoed send time is on the
/// clock of the echo's receiver.
struct Echo {
  std::int64_t sent_ns = 0;  // send time of the echoed datagram, on the clock of its sender
  /// Time from the arrival of the echoed datagram to the departure of this one.
  Duration held{0};
};

/// The part of a datagram's body that all messages have in common.
struct Stamp {
  PeerTime sent{};             // send time on the sender's clock
  std::optional<Echo> echo{};  // none: the sender has not received a datagram yet
};

constexpr Duration kNoRtt{-1};  // unknown round-trip time, as is any other negative value

/// A message with the metadata of its transmission.
template <class Message>
struct Received {
  std::uint64_t sequence = 0;
  PeerTime sent{};  // send time on the sender's clock
  Time received{};  // arrival on this side's clock
  /// When this side sent the newest datagram that the peer had received; none if there is no echo yet.
  std::optional<Time> echo_sent{};
  Duration rtt = kNoRtt;  // time since echo_sent, without the time held at the peer
  bool newest = true;     // no newer datagram of this type arrived earlier
  Message message{};
};

/// Why a datagram was dropped, in the order of the checks. Until a datagram is authenticated, it changes
/// nothing except a counter.
enum class Rejection : std::uint8_t {
  kLength,          // shorter than header and tag, or longer than 508 bytes
  kVersion,         // different wire version
  kType,            // this side does not receive this type
  kSession,         // not of the current session
  kReplay,          // already received, or older than the replay window
  kAuthentication,  // corrupted, or not sealed by the peer
  kDecode,          // the body is not a message of the type given in the header
  kValue,           // a field is missing, not finite or out of range
  kStalled,         // received while this side was stalled, and therefore too old to follow
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
