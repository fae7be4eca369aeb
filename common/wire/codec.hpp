#pragma once
// Bodies of datagrams: protobuf (proto/motion, stiffness, telemetry) to the structs of common/link and back.
// Decoding checks every value, so that what comes out is finite, of the right shape and within the bounds
// below: a body that is not the message is kDecode, a value that cannot be meant is kValue. Nothing allocates
// for a message that this codec can have encoded; unknown fields are ignored (they cost an allocation each).

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
constexpr double kGoalMaxM = 1e3;            // displacement from the anchor, each component
constexpr double kGoalMaxRad = 1e2;          // rotation vector from the anchor, each component
constexpr double kStiffnessMaxNPerM = 1e12;  // each entry, N/m or N m/rad
constexpr double kScaleMin = 0.05;
constexpr double kScaleMax = 1.0;
constexpr std::int64_t kInstantMaxNs = 4'000'000'000'000'000'000;  // 126 years: differences cannot overflow
constexpr std::int64_t kHeldMaxNs = 1'000'000'000'000'000'000;     // 31 years

/// One a side and thread: it keeps the protobuf objects, so that they are allocated once. For MotionCommand,
/// StiffnessReport and Telemetry.
class Codec {
 public:
  Codec();
  ~Codec();

  /// Writes the body and returns its size; `body` holds kBodyMaxBytes. Every message fits.
  /// An estimate that is not finite is sent as not valid.
  template <class Message>
  std::size_t encode(const Stamp& stamp, const Message& message, std::span<std::byte> body);

  /// What `stamp` and `message` hold after a rejection means nothing.
  template <class Message>
  [[nodiscard]] std::optional<Rejection> decode(std::span<const std::byte> body, Stamp& stamp,
                                                Message& message);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
