#pragma once
// Test datagrams for a port: ordinary and extreme messages, and bodies sealed by the test itself.

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "common/crypto/seal.hpp"
#include "common/link/header.hpp"
#include "common/wire/port.hpp"

namespace longreach::samples {

/// Returns a session whose secret depends on its number.
inline Session session(std::uint64_t number = 1000, Cipher cipher = Cipher::kChaCha20Poly1305) {
  Session s{.number = number, .cipher = cipher};
  for (std::size_t i = 0; i < s.secret.size(); ++i) s.secret[i] = static_cast<std::byte>(7 * number + i);
  return s;
}

inline Stamp stamp(std::int64_t sent_ns = 1'000'000) { return {PeerTime(Duration(sent_ns)), Echo{}}; }

inline Stamp extreme_stamp() {
  return {PeerTime(Duration(-kInstantMaxNs)), Echo{kInstantMaxNs, Duration(kHeldMaxNs)}};
}

inline MotionCommand command() {
  MotionCommand c;
  c.engagement = 3;
  c.request = Request::kEngage;
  c.mode = MotionMode::kRate;
  c.scale = 0.35;
  c.grip = c.let_go = true;
  c.position_m = {0.1, -0.2, 0.3};
  return c;
}

inline MotionCommand turn() {
  MotionCommand c = command();
  c.goal_kind = GoalKind::kGoalOrientation;
  c.position_m.setZero();
  c.rotation_rad = {-0.4, 0.5, 3.0};
  return c;
}

// All numbers are exactly representable as floats.
inline ContactReport contact(double scale) {
  ContactReport c;
  c.surfaces[0] = {.normal = -Vector3::UnitX(),
                   .stiffness = 2.5 * scale,
                   .foot = 0.0078125,
                   .touch_sequence = 1234.75,
                   .touch = 7,
                   .pressed = true};
  c.surfaces[1] = {.normal = Vector3::UnitZ(), .stiffness = 3.5 * scale, .offset = -0.1, .touch = 6};
  c.place = {0.25, -0.5, 0.125};
  c.held_back = {0.0, -0.6, 0.8};
  c.threshold = 0.5;
  c.guard = 20.0;
  return c;
}

inline StiffnessReport report() {
  return {5,
          SafetyState::kEngaged,
          HoldCause::kOperator,
          contact(1000.0),
          contact(0.25),
          1230,
          6,
          {HoldCause::kJointLimit, 5, 2.125, 2.0}};
}

inline Telemetry telemetry() {
  Telemetry t;
  t.state = SafetyState::kHolding;
  t.cause = HoldCause::kLinkSilent;
  t.engagement = 5;
  t.X_WE = {{10.0, -2.0, 0.5}, Quaternion(0.5, -0.5, 0.5, 0.5)};
  t.X_WE_goal = {{10.1, -2.1, 0.6}, Quaternion(0.0, 0.6, 0.0, 0.8)};
  t.joint_rad << 0.5, -0.25, 1.0, 2.0, -3.0, 0.125;
  t.F_E_W = {{0.5, 0.25, -0.125}, {1.5, -2.5, 3.5}};
  t.estimate = {1000.0, 10.0, 3e4, 3e3, 1.5, 0.002, true};
  t.estimate.k_sd = 300.0;
  t.estimate.lambda_sd = 200.0;
  t.estimate.n_sd = 0.125;
  t.estimate.correlation = -0.5;
  t.estimate.stiffness_verdict = t.estimate.n_verdict = Verdict::kIdentified;
  t.estimate.lambda_verdict = Verdict::kNotIdentifiable;
  t.penetration_m = 0.0015;
  t.clamps = {true, false, true, false, true, false, true};
  t.up_loss = 0.25;
  t.up_jitter_s = 0.5;
  t.playout_delay_s = 0.125;
  t.rejected = 11;
  t.limit_violations = 12;
  t.late_ticks = 13;
  t.gripper = {.holds = true, .closed = true, .load_kg = 4.5, .load_sd_kg = 0.25};
  t.load_acceleration_m_per_s2 = 0.5;
  t.load_acceleration_rad_per_s2 = 0.125;
  return t;
}

inline BodyPoses body_poses() {
  BodyPoses b;
  b.body[0] = BodyPose{{{1.5, -2.25, 0.125}, Quaternion(0.5, -0.5, 0.5, 0.5)}, 0.0};
  b.body[4] = BodyPose{{{-0.5, 0.25, 8.0}, Quaternion(0.0, 1.0, 0.0, 0.0)}, 0.375};
  return b;
}

// Messages in which every field has its maximum length on the wire.
inline MotionCommand extreme_command() {
  MotionCommand c;
  c.engagement = std::numeric_limits<std::uint32_t>::max();
  c.request = Request::kStop;
  c.position_m.setConstant(-kGoalMaxM);
  return c;
}

inline StiffnessReport extreme_report() {
  ContactReport c = contact(1.0);
  for (std::size_t i = 0; i < kSurfaces; ++i)
    c.surfaces[i] = {.normal = Vector3::Unit(static_cast<Eigen::Index>(i)),
                     .stiffness = 0.9 * kStiffnessMaxNPerM,
                     .foot = 1.0,
                     .touch_sequence = 9e15,
                     .touch = std::numeric_limits<std::uint32_t>::max() / 4,
                     .pressed = true};
  const Reason far{HoldCause::kSensorConstant, kMaxJoints, -1e300, 1e300};
  return {std::numeric_limits<std::uint32_t>::max(),
          SafetyState::kFault,
          far,
          c,
          c,
          std::numeric_limits<std::uint64_t>::max(),
          std::numeric_limits<std::uint32_t>::max(),
          far};
}

inline Telemetry extreme_telemetry() {
  Telemetry t = telemetry();
  t.state = SafetyState::kFault;
  t.cause = HoldCause::kSensorConstant;
  t.engagement = std::numeric_limits<std::uint32_t>::max();
  const double big = std::numeric_limits<double>::max();
  t.estimate = {-big, big, -big, big, -big, big, true};
  t.estimate.k_sd = t.estimate.lambda_sd = t.estimate.n_sd = t.estimate.correlation = big;
  t.estimate.stiffness_verdict = t.estimate.k_verdict = Verdict::kNotIdentifiable;
  t.estimate.lambda_verdict = t.estimate.n_verdict = Verdict::kNotIdentifiable;
  t.joint_rad.fill(-1e9);
  t.F_E_W = {Vector3::Constant(1e12), Vector3::Constant(-1e12)};
  t.clamps = {true, true, true, true, true, true, true, true};
  t.up_loss = 1.0;
  t.up_jitter_s = t.playout_delay_s = 1e8;
  t.rejected = t.limit_violations = t.late_ticks = std::numeric_limits<std::uint64_t>::max();
  return t;
}

inline BodyPoses extreme_body_poses() {
  BodyPoses b;
  for (auto& one : b.body)
    one = BodyPose{{Vector3::Constant(-kBodyMaxM), Quaternion(0.5, 0.5, -0.5, 0.5)}, kBodyAgeMaxS};
  return b;
}

/// Seals a body as the sender of such a datagram does.
template <class Bytes>
std::vector<std::byte> sealed(DatagramType type, std::uint64_t sequence, const Bytes& body,
                              const Session& with = session()) {
  std::vector<std::byte> out(kOverheadBytes + body.size());
  std::transform(body.begin(), body.end(), out.begin() + kHeaderBytes, [](auto c) { return std::byte(c); });
  write_header({type, with.number, sequence}, out);
  Seal(with, way_of(type))
      .close({static_cast<std::uint8_t>(type), sequence}, std::span(out).first(kHeaderBytes),
             std::span(out).subspan(kHeaderBytes));
  return out;
}

template <class Message>
constexpr DatagramType type_of();
template <>
constexpr DatagramType type_of<MotionCommand>() {
  return DatagramType::kMotionCommand;
}
template <>
constexpr DatagramType type_of<StiffnessReport>() {
  return DatagramType::kStiffnessReport;
}
template <>
constexpr DatagramType type_of<Telemetry>() {
  return DatagramType::kTelemetry;
}

template <>
constexpr DatagramType type_of<BodyPoses>() {
  return DatagramType::kBodyPoses;
}

template <class Message>
std::string body_of(const Message& message, const Stamp& at = stamp()) {
  Codec codec;
  std::array<std::byte, kBodyMaxBytes> body;
  const std::size_t size = codec.encode(at, message, body);
  return {reinterpret_cast<const char*>(body.data()), size};
}

template <class Message>
std::vector<std::byte> datagram(const Message& message, std::uint64_t sequence,
                                const Session& with = session()) {
  return sealed(type_of<Message>(), sequence, body_of(message), with);
}

}  // namespace longreach::samples
