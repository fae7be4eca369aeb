#pragma once
// Converts the values of a body, except for its stamp, from structs of common/link to protobuf messages and
// back, and checks every value. Used only by the codec. `read` returns false, and leaves `out` unspecified,
// if a value is missing, not finite or out of range.

#include "common/link/body_poses.hpp"
#include "common/link/stiffness_report.hpp"
#include "proto/bodies.pb.h"
#include "proto/motion.pb.h"
#include "proto/stiffness.pb.h"
#include "proto/telemetry.pb.h"
#include "schema/state_link.hpp"

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
template <>
struct WireMessageOf<BodyPoses> {
  using Type = proto::BodyPoses;
};
template <class Message>
using WireMessage = typename WireMessageOf<Message>::Type;

inline constexpr int kLineNumbers = 5;  // numbers in a report that describe the tangent of one surface

// Overwrite every field of `out` except its stamp, and reuse its memory.
void write(const MotionCommand& command, proto::MotionCommand& out);
void write(const StiffnessReport& report, proto::StiffnessReport& out);
void write(const Telemetry& telemetry, proto::Telemetry& out);
void write(const BodyPoses& bodies, proto::BodyPoses& out);

// Overwrite every field of `out`.
[[nodiscard]] bool read(const proto::MotionCommand& in, MotionCommand& out);
[[nodiscard]] bool read(const proto::StiffnessReport& in, StiffnessReport& out);
[[nodiscard]] bool read(const proto::Telemetry& in, Telemetry& out);
[[nodiscard]] bool read(const proto::BodyPoses& in, BodyPoses& out);

}  // namespace longreach
