#pragma once
// Converts the bodies of datagrams from protobuf (proto/motion, stiffness, telemetry, bodies) to the
// structs of common/link and back. Decoding checks every value, so that the result is complete, finite and within the
// bounds below. A body that cannot be parsed is rejected with kDecode, and an invalid value with kValue.
// Decoding messages of this codec does not allocate memory. Unknown fields are ignored, but each requires an
// allocation.

#include <cstddef>
#include <memory>
#include <optional>
#include <span>

#include "common/link/body_poses.hpp"
#include "common/link/envelope.hpp"
#include "common/link/header.hpp"
#include "common/link/stiffness_report.hpp"
#include "schema/state_link.hpp"

namespace longreach {

constexpr std::size_t kBodyMaxBytes = kDatagramMaxBytes - kOverheadBytes;
constexpr double kGoalMaxM = 1e3;    // bound on each component of the displacement from the anchor
constexpr double kGoalMaxRad = 1e2;  // bound on each component of the rotation vector from the anchor
constexpr double kBodyMaxM = 1e6;    // bound on each component of the position of a body
constexpr double kBodyAgeMaxS = 1e6;
constexpr double kScaleMin = 0.05;
constexpr double kScaleMax = 1.0;
constexpr std::int64_t kInstantMaxNs =
    4'000'000'000'000'000'000;  // 126 years, so that differences cannot overflow
constexpr std::int64_t kHeldMaxNs = 1'000'000'000'000'000'000;  // 31 years

/// Encodes and decodes MotionCommand, StiffnessReport, Telemetry and BodyPoses. Each side and thread needs its own
/// codec, because a codec reuses its protobuf objects.
class Codec {
 public:
  Codec();
  ~Codec();

  /// Writes the body and returns its size. `body` must have room for kBodyMaxBytes, which is enough for every
  /// message. An estimate that is not finite is sent as invalid, and a body with an impossible pose is omitted.
  template <class Message>
  std::size_t encode(const Stamp& stamp, const Message& message, std::span<std::byte> body);

  /// Reads a body. If the body is rejected, the content of `stamp` and `message` is unspecified.
  template <class Message>
  [[nodiscard]] std::optional<Rejection> decode(std::span<const std::byte> body, Stamp& stamp,
                                                Message& message);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
