#pragma once
// Slave to master: the only haptic quantity that crosses the link, the estimated stiffness of each surface,
// and where in the operator's own motion it was met. The renderer sees this type and nothing else from afar.

#include <algorithm>
#include <array>
#include <cstdint>

#include "common/link/hold_cause.hpp"
#include "common/spatial/spatial.hpp"

namespace longreach {

/// States of the safety machine; both sides show them.
enum class SafetyState : std::uint8_t { kIdle, kObserving, kEngaged, kHolding, kStopped, kFault };

/// A surface that the tool presses on, or has pressed on: the tangent of its law at the depth where the hand
/// works. Lengths in m and forces in N, or in rad and N m.
struct ReportedSurface {
  Vector3 normal = Vector3::Zero();  // unit, in W: the way it pushes the tool
  double stiffness = 0.0;            // of the tangent, N/m or N m/rad; 0: not identified yet
  double foot = 0.0;                 // of the tangent: how deep behind the surface it begins, >= 0
  // Which command's goal lies at the surface, between sequences; refined while it is pressed. 0: none that is
  // remembered, as it is older; it lies at `offset` along the normal from the engagement's anchor.
  double touch_sequence = 0.0;
  double offset = 0.0;
  std::uint32_t touch =
      0;  // counts touches from 1: the one that it is, or was last, pressed in; 0: no surface
  bool pressed = false;
};

inline constexpr std::size_t kSurfaces = 3;

/// What is touched, in translation or in rotation.
struct ContactReport {
  // All that the slave knows of, no two of them facing within 26 degrees of each other; those that are not
  // there come last.
  std::array<ReportedSurface, kSurfaces> surfaces{};
  // The tool where a limit holds it back, from the engagement's anchor, in W: a displacement (m) or a
  // rotation vector (rad).
  Vector3 place = Vector3::Zero();
  // Unit, in W: from the tool towards a goal from which a limit holds it back; zero: nothing does.
  Vector3 held_back = Vector3::Zero();

  [[nodiscard]] bool in_contact() const {
    return std::ranges::any_of(surfaces, [](const ReportedSurface& s) { return s.pressed; });
  }
};

struct StiffnessReport {
  std::uint32_t engagement = 0;  // engagement that the slave follows or last followed
  SafetyState state = SafetyState::kIdle;
  Reason cause{};  // of the state
  ContactReport translation{};
  ContactReport rotation{};
  // Newest command whose goal the tool has reached.
  std::uint64_t reached_sequence = 0;
  // The engagement that is asked for and not granted, and why; 0: none.
  std::uint32_t refused = 0;
  Reason refusal{};
};

}  // namespace longreach
