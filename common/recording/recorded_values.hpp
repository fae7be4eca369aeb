#pragma once
// Converts structs of the lower layers to recorded messages (proto/recording.proto) and back. The conversion
// is exact: doubles keep all bits, and times are exact to the nanosecond. Reading throws RecordingError for
// values that the struct cannot represent.
//
// Every field added to a recorded struct must be recorded, too; static assertions on the struct sizes are a
// reminder.

#include <string>
#include <type_traits>

#include "common/link/delay_monitor.hpp"
#include "common/link/envelope.hpp"
#include "common/link/motion_command.hpp"
#include "common/link/stiffness_report.hpp"
#include "common/link/telemetry.hpp"
#include "common/recording/recording_error.hpp"
#include "common/spatial/spatial.hpp"
#include "proto/recording.pb.h"

namespace longreach {

/// Reads an enumeration whose values range from zero to `last`.
template <class Enum>
Enum read_enum(int value, Enum last) {
  if (value < 0 || value > static_cast<int>(last))
    throw RecordingError("a recorded enumeration value is unknown: " + std::to_string(value));
  return static_cast<Enum>(value);
}
/// Converts an enumeration; the schema and the structs use the same numbers.
template <class RecordedEnum, class Enum>
RecordedEnum to_recorded(Enum value) {
  return static_cast<RecordedEnum>(static_cast<int>(value));
}

inline std::int64_t to_ns(Time t) { return t.time_since_epoch().count(); }
inline Time to_time(std::int64_t ns) { return Time(Duration(ns)); }

void write(const Vector3& v, recording::Vector& out);
void write(const Quaternion& q, recording::Quaternion& out);
void write(const Pose& pose, recording::Pose& out);
void write(const Wrench& wrench, recording::Wrench& out);
void write(const ContactEstimate& estimate, recording::ContactEstimate& out);
void write(const Clamps& clamps, recording::Clamps& out);
void write(const MotionCommand& command, recording::MotionCommand& out);
void write(const StiffnessReport& report, recording::StiffnessReport& out);
void write(const Telemetry& telemetry, recording::Telemetry& out);

/// Writes six numbers from an array or an Eigen vector.
template <class Six>
void write_joints(const Six& joints, recording::Joints& out) {
  out.set_joint1(joints[0]);
  out.set_joint2(joints[1]);
  out.set_joint3(joints[2]);
  out.set_joint4(joints[3]);
  out.set_joint5(joints[4]);
  out.set_joint6(joints[5]);
}
template <class Six>
Six read_joints(const recording::Joints& in) {
  Six out;
  out[0] = in.joint1();
  out[1] = in.joint2();
  out[2] = in.joint3();
  out[3] = in.joint4();
  out[4] = in.joint5();
  out[5] = in.joint6();
  return out;
}

Vector3 read(const recording::Vector& in);
Quaternion read(const recording::Quaternion& in);
Pose read(const recording::Pose& in);
Wrench read(const recording::Wrench& in);
ContactEstimate read(const recording::ContactEstimate& in);
Clamps read(const recording::Clamps& in);
MotionCommand read(const recording::MotionCommand& in);
StiffnessReport read(const recording::StiffnessReport& in);
Telemetry read(const recording::Telemetry& in);

template <class Message>
void write_receipt(const Received<Message>& received, recording::Receipt& out) {
  out.set_sequence(received.sequence);
  out.set_sent_ns(received.sent.time_since_epoch().count());
  out.set_received_ns(to_ns(received.received));
  if (received.echo_sent) out.set_echo_sent_ns(to_ns(*received.echo_sent));
  if (received.rtt >= Duration{0}) out.set_rtt_ns(received.rtt.count());
  out.set_newest(received.newest);
}
template <class Message>
Received<Message> read_receipt(const recording::Receipt& in, const Message& message) {
  Received<Message> out;
  out.sequence = in.sequence();
  out.sent = PeerTime(Duration(in.sent_ns()));
  out.received = to_time(in.received_ns());
  if (in.has_echo_sent_ns()) out.echo_sent = to_time(in.echo_sent_ns());
  if (in.has_rtt_ns()) out.rtt = Duration(in.rtt_ns());
  out.newest = in.newest();
  out.message = message;
  return out;
}

void write(const Received<StiffnessReport>& received, recording::ReceivedReport& out);
void write(const Received<Telemetry>& received, recording::ReceivedTelemetry& out);
void write(const Received<MotionCommand>& received, recording::ReceivedCommand& out);
Received<StiffnessReport> read(const recording::ReceivedReport& in);
Received<Telemetry> read(const recording::ReceivedTelemetry& in);
Received<MotionCommand> read(const recording::ReceivedCommand& in);

}  // namespace longreach
