#pragma once
// Common content of every datagram, and the metadata that a receiver gets with a message.

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

/// Echo of the newest datagram that the sender had received in this session, so that the receiver can date it
/// by its own clock.
struct Echo {
  std::int64_t sent_ns = 0;  // its send time, on the clock of its sender
  Duration held{0};  // time between its arrival at the echoing side and the departure of this datagram
};

/// The part of a datagram's body that is common to all messages.
struct Stamp {
  PeerTime sent{};             // sender's clock
  std::optional<Echo> echo{};  // none: no datagram received yet
};

constexpr Duration kNoRtt{-1};  // an unknown round trip, like any value below zero

/// A message with the metadata of its transmission.
template <class Message>
struct Received {
  std::uint64_t sequence = 0;
  PeerTime sent{};  // on the sender's clock
  Time received{};  // on this clock
  /// when this side sent the newest datagram that the peer had received; none: not yet
  std::optional<Time> echo_sent{};
  Duration rtt = kNoRtt;  // from then until now, without the time held at the peer
  bool newest = true;     // no newer one of its type has arrived before
  Message message{};
};

/// Why a datagram was dropped, in the order of the checks. Before authentication nothing changes except a
/// counter.
enum class Rejection : std::uint8_t {
  kLength,          // shorter than header and tag, or longer than 508 bytes
  kVersion,         // other wire version
  kType,            // this side does not receive this type
  kSession,         // not of the present session
  kReplay,          // already received, or too old to check
  kAuthentication,  // corrupted, or not sealed by the other side
  kDecode,          // the body is not the message that the header states
  kValue,           // a field is missing, not finite or out of range
  kStalled,         // received while this side was stalled: too old to follow
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
