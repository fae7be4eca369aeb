#include "common/wire/codec.hpp"

#include <google/protobuf/arena.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/check.hpp"
#include "common/wire/values.hpp"
#include "proto/motion.pb.h"
#include "proto/stiffness.pb.h"
#include "proto/telemetry.pb.h"

namespace longreach {

// The largest message that fits a datagram needs under 4 KiB; parsing beyond it would only fall back to the
// heap.
constexpr std::size_t kArenaBytes = 16384;

struct Codec::State {
  alignas(16) std::array<char, kArenaBytes> block;
  google::protobuf::Arena arena{block.data(), block.size()};
  proto::MotionCommand command;
  proto::StiffnessReport report;
  proto::Telemetry telemetry;
};

Codec::Codec() : state_(std::make_unique<State>()) {}
Codec::~Codec() = default;

namespace {

template <class Message>
std::size_t serialise(const Message& message, std::span<std::byte> body) {
  const std::size_t size = message.ByteSizeLong();
  CHECK(size <= body.size() && size <= kBodyMaxBytes);
  message.SerializeWithCachedSizesToArray(reinterpret_cast<std::uint8_t*>(body.data()));
  return size;
}

/// A message in the arena's own block: parsing a message of ours allocates nothing.
template <class Message>
const Message* parse(google::protobuf::Arena& arena, std::span<const std::byte> body) {
  arena.Reset();
  auto* message = google::protobuf::Arena::CreateMessage<Message>(&arena);
  const bool ok =
      body.size() <= kBodyMaxBytes && message->ParseFromArray(body.data(), static_cast<int>(body.size()));
  return ok ? message : nullptr;
}

}  // namespace

std::size_t Codec::encode(const Stamp& stamp, const MotionCommand& command, std::span<std::byte> body) {
  write(command, state_->command);
  write(stamp, *state_->command.mutable_stamp());
  return serialise(state_->command, body);
}

std::size_t Codec::encode(const Stamp& stamp, const StiffnessReport& report, std::span<std::byte> body) {
  write(report, state_->report);
  write(stamp, *state_->report.mutable_stamp());
  return serialise(state_->report, body);
}

std::size_t Codec::encode(const Stamp& stamp, const Telemetry& telemetry, std::span<std::byte> body) {
  write(telemetry, state_->telemetry);
  write(stamp, *state_->telemetry.mutable_stamp());
  return serialise(state_->telemetry, body);
}

template <class Message>
std::variant<Decoded<Message>, Rejection> Codec::decode(std::span<const std::byte> body) {
  const auto* wire = parse<WireMessage<Message>>(state_->arena, body);
  if (wire == nullptr) return Rejection::kDecode;
  const auto stamp = wire->has_stamp() ? read_stamp(wire->stamp()) : std::nullopt;
  if (!stamp) return Rejection::kValue;
  const auto message = read(*wire);
  if (!message) return Rejection::kValue;
  return Decoded<Message>{*stamp, *message};
}

template std::variant<Decoded<MotionCommand>, Rejection> Codec::decode(std::span<const std::byte>);
template std::variant<Decoded<StiffnessReport>, Rejection> Codec::decode(std::span<const std::byte>);
template std::variant<Decoded<Telemetry>, Rejection> Codec::decode(std::span<const std::byte>);

}  // namespace longreach
