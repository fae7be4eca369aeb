#include "common/wire/codec.hpp"

#include <tuple>

#include "common/core/check.hpp"
#include "common/wire/values.hpp"
#include "proto/bodies.pb.h"
#include "proto/motion.pb.h"
#include "proto/stiffness.pb.h"
#include "proto/telemetry.pb.h"

namespace longreach {
namespace {

template <class... Fields>
void reserve(int numbers, Fields*... fields) {
  (fields->Reserve(numbers), ...);
}

void make_room(proto::MotionCommand& m) { reserve(3, m.mutable_position_m(), m.mutable_rotation_rad()); }

void make_room(proto::StiffnessReport& m) {
  constexpr int kMost = static_cast<int>(kSurfaces);
  reserve(kLineNumbers * kMost, m.mutable_translation_lines(), m.mutable_rotation_lines());
  reserve(kMost, m.mutable_translation_places(), m.mutable_rotation_places());
  reserve(kMost, m.mutable_translation_touches(), m.mutable_rotation_touches());
  reserve(3, m.mutable_translation_tool_m(), m.mutable_translation_held_back(), m.mutable_rotation_tool_rad(),
          m.mutable_rotation_held_back());
}

void make_room(proto::Telemetry& m) {
  for (proto::PoseXyzw* pose : {m.mutable_tool(), m.mutable_goal()})
    reserve(4, pose->mutable_position_m(), pose->mutable_quaternion());
  reserve(kMaxJoints, m.mutable_joint_rad(), m.mutable_force_n(), m.mutable_moment_nm(),
          m.mutable_estimate_sd());
}

void make_room(proto::BodyPoses& m) {
  constexpr int kMost = static_cast<int>(kTrackedBodies);
  reserve(kMost, m.mutable_bodies());
  reserve(4 * kMost, m.mutable_positions_m(), m.mutable_quaternions(), m.mutable_ages_s());
}

template <class Message>
std::size_t serialise(const Message& message, std::span<std::byte> body) {
  const std::size_t size = message.ByteSizeLong();
  CHECK(size <= body.size() && size <= kBodyMaxBytes);
  message.SerializeWithCachedSizesToArray(reinterpret_cast<std::uint8_t*>(body.data()));
  return size;
}

// What all bodies begin with.
template <class Wire>
void write(const Stamp& stamp, Wire& out) {
  out.set_sent_ns(stamp.sent.time_since_epoch().count());
  out.clear_echo_sent_ns();
  if (stamp.echo) out.set_echo_sent_ns(stamp.echo->sent_ns);
  out.set_echo_held_ns(stamp.echo ? stamp.echo->held.count() : 0);
}

template <class Wire>
bool read(const Wire& in, Stamp& out) {
  const auto possible = [](std::int64_t ns) { return ns >= -kInstantMaxNs && ns <= kInstantMaxNs; };
  if (!in.has_sent_ns() || !possible(in.sent_ns()) || !possible(in.echo_sent_ns())) return false;
  if (in.echo_held_ns() < 0 || in.echo_held_ns() > kHeldMaxNs) return false;
  out.sent = PeerTime(Duration(in.sent_ns()));
  out.echo.reset();
  if (in.has_echo_sent_ns()) out.echo = Echo{in.echo_sent_ns(), Duration(in.echo_held_ns())};
  return true;
}

}  // namespace

// Used over and over. What is written sets every field, so it need not be cleared; sub-messages are
// `optional` in the schema, so that clearing what is parsed keeps them.
struct Codec::State {
  struct Messages
      : std::tuple<proto::MotionCommand, proto::StiffnessReport, proto::Telemetry, proto::BodyPoses> {
    Messages() {
      std::apply([](auto&... message) { (make_room(message), ...); }, static_cast<tuple&>(*this));
    }
  };
  Messages written, parsed;
};

Codec::Codec() : state_(std::make_unique<State>()) {}
Codec::~Codec() = default;

template <class Message>
std::size_t Codec::encode(const Stamp& stamp, const Message& message, std::span<std::byte> body) {
  auto& wire = std::get<WireMessage<Message>>(state_->written);
  write(message, wire);
  write(stamp, wire);
  return serialise(wire, body);
}

template <class Message>
std::optional<Rejection> Codec::decode(std::span<const std::byte> body, Stamp& stamp, Message& message) {
  auto& wire = std::get<WireMessage<Message>>(state_->parsed);
  if (body.size() > kBodyMaxBytes || !wire.ParseFromArray(body.data(), static_cast<int>(body.size())))
    return Rejection::kDecode;
  const bool possible = read(wire, stamp) && read(wire, message);
  return possible ? std::nullopt : std::optional(Rejection::kValue);
}

template std::size_t Codec::encode(const Stamp&, const MotionCommand&, std::span<std::byte>);
template std::size_t Codec::encode(const Stamp&, const StiffnessReport&, std::span<std::byte>);
template std::size_t Codec::encode(const Stamp&, const Telemetry&, std::span<std::byte>);
template std::size_t Codec::encode(const Stamp&, const BodyPoses&, std::span<std::byte>);
template std::optional<Rejection> Codec::decode(std::span<const std::byte>, Stamp&, MotionCommand&);
template std::optional<Rejection> Codec::decode(std::span<const std::byte>, Stamp&, StiffnessReport&);
template std::optional<Rejection> Codec::decode(std::span<const std::byte>, Stamp&, Telemetry&);
template std::optional<Rejection> Codec::decode(std::span<const std::byte>, Stamp&, BodyPoses&);

}  // namespace longreach
