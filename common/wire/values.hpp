#pragma once
// The values of a body but for its stamp: structs of common/link to protobuf messages, and back with every
// value checked. Private to the codec. `read` is false when a value is missing, not finite or out of range;
// `out` then means nothing.

#include "common/link/motion_command.hpp"
#include "common/link/stiffness_report.hpp"
#include "common/link/telemetry.hpp"
#include "proto/motion.pb.h"
#include "proto/stiffness.pb.h"
#include "proto/telemetry.pb.h"

namespace longreach {

template <class Message>
struct WireMessageOf;
template <>
struct WireMessageOf<MotionCommand> {
  using Type = proto::MotionCommand;
};
template <>
struct WireMessageOf<StiffnessReport> {
  using Type = proto::StiffnessReport;
};
template <>
struct WireMessageOf<Telemetry> {
  using Type = proto::Telemetry;
};
template <class Message>
using WireMessage = typename WireMessageOf<Message>::Type;

inline constexpr int kLineNumbers = 5;  // that the line of a surface has in a report

// Every field of `out` is overwritten but its stamp; its memory is used again.
void write(const MotionCommand& command, proto::MotionCommand& out);
void write(const StiffnessReport& report, proto::StiffnessReport& out);
void write(const Telemetry& telemetry, proto::Telemetry& out);

// Every field of `out` is overwritten.
[[nodiscard]] bool read(const proto::MotionCommand& in, MotionCommand& out);
[[nodiscard]] bool read(const proto::StiffnessReport& in, StiffnessReport& out);
[[nodiscard]] bool read(const proto::Telemetry& in, Telemetry& out);

}  // namespace longreach
