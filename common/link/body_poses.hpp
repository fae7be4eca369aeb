#pragma once
// Sent by the slave to the master for display and recording: the poses of the free bodies that the robot tracks. Nothing
// that moves a motor reads them. For example, the simulated robot of the scene `dock` tracks one body, the spacecraft.

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include "common/schema/visit.hpp"
#include "schema/state_link.hpp"

namespace longreach {

inline constexpr std::size_t kTrackedBodies = 8;

struct BodyPoses {
  /// By the number of the body: the order of the free bodies in the file of the scene. None: the pose is unknown.
  std::array<std::optional<BodyPose>, kTrackedBodies> body{};

  [[nodiscard]] bool empty() const {
    return std::ranges::none_of(body, [](const auto& one) { return one.has_value(); });
  }
};

template <class Visitor, Is<BodyPoses> S>
void visit_fields(Visitor& visit, S& s) {
  constexpr std::array<const char*, kTrackedBodies> kNames = {"body1", "body2", "body3", "body4",
                                                              "body5", "body6", "body7", "body8"};
  for (std::size_t i = 0; i < kTrackedBodies; ++i) visit(kNames[i], s.body[i]);
}

}  // namespace longreach
