#pragma once
// Slave to master: the estimated stiffness of each surface, the only haptic quantity that crosses the link,
// and the point of the operator's motion at which it was touched. The renderer receives this type and no
// other data of the slave.

#include <algorithm>
#include <array>
#include <cstdint>

#include "common/link/hold_cause.hpp"
#include "common/spatial/spatial.hpp"

namespace longreach {

/// States of the safety state machine of either side.
enum class SafetyState : std::uint8_t { kIdle, kObserving, kEngaged, kHolding, kStopped, kFault };

/// Stiffness of a report at most, N/m or N m/rad: beyond it the force changes without a motion, and a
/// stiffness is not identifiable.
inline constexpr double kStiffnessMaxNPerM = 1e12;

/// A surface that the tool presses on or has pressed on: the tangent of its force law at the working depth.
/// Lengths in m and forces in N, or rad and N m.
struct ReportedSurface {
  Vector3 normal = Vector3::Zero();  // unit, in W: direction in which it pushes the tool
  double stiffness = 0.0;            // of the tangent, N/m or N m/rad; 0: not identified yet
  double foot = 0.0;                 // of the tangent: its depth behind the surface, >= 0
  // Sequence number of the command whose goal is at the surface, may be fractional; refined while pressed. 0:
  // no longer stored because it is too old; the surface is then at `offset` along the normal from the
  // engagement's anchor.
  double touch_sequence = 0.0;
  double offset = 0.0;
  std::uint32_t touch = 0;  // number of the touch, from 1, in which it is or was last pressed; 0: no surface
  bool pressed = false;
};

inline constexpr std::size_t kSurfaces = 3;

/// Contact in translation or in rotation.
struct ContactReport {
  // All known surfaces; their normals differ by at least 26 degrees. Unused entries are last.
  std::array<ReportedSurface, kSurfaces> surfaces{};
  // Position of the tool where a limit holds it back, from the engagement's anchor, in W: a displacement (m)
  // or a rotation vector (rad).
  Vector3 place = Vector3::Zero();
  // Unit, in W: from the tool towards a goal from which a limit holds it back; zero: no limit is active.
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
  // Sequence number of the newest command whose goal the tool has reached.
  std::uint64_t reached_sequence = 0;
  // The engagement that is requested but not granted, and the reason; 0: none.
  std::uint32_t refused = 0;
  Reason refusal{};
};

}  // namespace longreach
