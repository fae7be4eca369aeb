#pragma once
// The values of recorded messages, whose fields proto/state_*.proto name once. The conversion is exact: doubles keep all
// bits, and times are exact to the nanosecond.

#include <stdexcept>
#include <string>

#include "common/link/body_poses.hpp"
#include "common/link/envelope.hpp"
#include "common/link/stiffness_report.hpp"
#include "common/messages/conversion.hpp"
#include "common/recording/recording_error.hpp"
#include "proto/recording.pb.h"

namespace longreach {

/// Reads a struct. Throws RecordingError for values that it cannot represent.
template <class S>
S from_recorded(const google::protobuf::Message& message) {
  try {
    return from_message<S>(message);
  } catch (const std::out_of_range& problem) {
    throw RecordingError("a recorded enumeration value is unknown: " + std::string(problem.what()));
  }
}

/// The recorded form of a received message, and the name of the message in it.
template <class Message>
struct ReceivedForm;
template <>
struct ReceivedForm<StiffnessReport> {
  using Type = recording::ReceivedReport;
  static constexpr const char* kName = "report";
};
template <>
struct ReceivedForm<Telemetry> {
  using Type = recording::ReceivedTelemetry;
  static constexpr const char* kName = "telemetry";
};
template <>
struct ReceivedForm<BodyPoses> {
  using Type = recording::ReceivedBodies;
  static constexpr const char* kName = "bodies";
};
template <>
struct ReceivedForm<MotionCommand> {
  using Type = recording::ReceivedCommand;
  static constexpr const char* kName = "command";
};

/// Adds a received message to an empty `out`.
template <class Message>
void to_recorded(const Received<Message>& received, typename ReceivedForm<Message>::Type& out) {
  recording::Receipt& receipt = *out.mutable_receipt();
  receipt.set_sequence(received.sequence);
  receipt.set_sent_ns(received.sent.time_since_epoch().count());
  receipt.set_received_ns(received.received.time_since_epoch().count());
  if (received.echo_sent) receipt.set_echo_sent_ns(received.echo_sent->time_since_epoch().count());
  if (received.rtt >= Duration{0}) receipt.set_rtt_ns(received.rtt.count());
  receipt.set_newest(received.newest);
  MessageWriter writer(out);
  writer(ReceivedForm<Message>::kName, received.message);
}

/// Throws RecordingError for values that the message cannot represent.
template <class Message>
Received<Message> from_recorded(const typename ReceivedForm<Message>::Type& in) {
  const recording::Receipt& receipt = in.receipt();
  Received<Message> out;
  out.sequence = receipt.sequence();
  out.sent = PeerTime(Duration(receipt.sent_ns()));
  out.received = Time(Duration(receipt.received_ns()));
  if (receipt.has_echo_sent_ns()) out.echo_sent = Time(Duration(receipt.echo_sent_ns()));
  if (receipt.has_rtt_ns()) out.rtt = Duration(receipt.rtt_ns());
  out.newest = receipt.newest();
  const auto* field = in.GetDescriptor()->FindFieldByName(ReceivedForm<Message>::kName);
  out.message = from_recorded<Message>(in.GetReflection()->GetMessage(in, field));
  return out;
}

}  // namespace longreach
