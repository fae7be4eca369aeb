#pragma once
// Converts bodies of datagrams between protobuf (proto/motion, stiffness, telemetry) and the structs of
// common/link. Decoding checks every value, so that the result is finite, of the right shape and within the
// bounds below: a body that is not the message gives kDecode, an invalid value kValue. Messages of this codec
// need no allocation; unknown fields are ignored (they cost an allocation each).

#include <cstddef>
#include <memory>
#include <optional>
#include <span>

#include "common/link/envelope.hpp"
#include "common/link/header.hpp"
#include "common/link/motion_command.hpp"
#include "common/link/stiffness_report.hpp"
#include "common/link/telemetry.hpp"

namespace longreach {

constexpr std::size_t kBodyMaxBytes = kDatagramMaxBytes - kOverheadBytes;
constexpr double kGoalMaxM = 1e3;    // displacement from the anchor, each component
constexpr double kGoalMaxRad = 1e2;  // rotation vector from the anchor, each component
constexpr double kScaleMin = 0.05;
constexpr double kScaleMax = 1.0;
constexpr std::int64_t kInstantMaxNs = 4'000'000'000'000'000'000;  // 126 years: differences cannot overflow
constexpr std::int64_t kHeldMaxNs = 1'000'000'000'000'000'000;     // 31 years

/// One per side and thread: it keeps the protobuf objects, so that they are allocated once. For
/// MotionCommand, StiffnessReport and Telemetry.
class Codec {
 public:
  Codec();
  ~Codec();

  /// Writes the body and returns its size; `body` has kBodyMaxBytes. Every message fits. An estimate that is
  /// not finite is sent as not valid.
  template <class Message>
  std::size_t encode(const Stamp& stamp, const Message& message, std::span<std::byte> body);

  /// After a rejection the content of `stamp` and `message` is undefined.
  template <class Message>
  [[nodiscard]] std::optional<Rejection> decode(std::span<const std::byte> body, Stamp& stamp,
                                                Message& message);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
