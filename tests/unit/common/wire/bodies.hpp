#pragma once
// Encodes and decodes message bodies with the codec and with the generated protobuf classes.

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <variant>

#include "common/wire/codec.hpp"
#include "proto/bodies.pb.h"
#include "proto/motion.pb.h"
#include "proto/stiffness.pb.h"
#include "proto/telemetry.pb.h"
#include "tests/unit/common/wire/samples.hpp"

namespace longreach::bodies {

template <class Message>
struct Decoded {
  Stamp stamp{};
  Message message{};
};

template <class Message>
std::variant<Decoded<Message>, Rejection> decode(const std::string& body) {
  Codec codec;
  Decoded<Message> out;
  if (const auto rejection = codec.decode(std::as_bytes(std::span(body)), out.stamp, out.message))
    return *rejection;
  return out;
}

template <class Message>
Message round_trip(const Message& message) {
  return std::get<Decoded<Message>>(decode<Message>(samples::body_of(message))).message;
}

template <class Message>
std::optional<Rejection> rejection_of(const std::string& body) {
  const auto decoded = decode<Message>(body);
  return std::holds_alternative<Rejection>(decoded) ? std::optional(std::get<Rejection>(decoded))
                                                    : std::nullopt;
}

template <class Wire, class Message>
Wire wire_of(const Message& message) {
  Wire wire;
  EXPECT_TRUE(wire.ParseFromString(samples::body_of(message)));
  return wire;
}

}  // namespace longreach::bodies
