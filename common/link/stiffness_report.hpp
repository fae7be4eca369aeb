#pragma once
// Sent by the slave to the master: the estimated stiffness of each surface, which is the only haptic quantity
// that crosses the link, and the point in the operator's motion at which the surface was touched. The
// renderer receives this type and no other data from the slave.

#include <algorithm>
#include <array>
#include <cstdint>

#include "common/link/hold_cause.hpp"
#include "common/spatial/spatial.hpp"

namespace longreach {

/// States of the safety state machine on both sides.
enum class SafetyState : std::uint8_t { kIdle, kObserving, kEngaged, kHolding, kStopped, kFault };

/// Maximum stiffness in a report, N/m or N m/rad. Above this value the force changes without measurable
/// motion, so that no stiffness is identifiable.
inline constexpr double kStiffnessMaxNPerM = 1e12;

/// A surface that the tool is pressing on or has pressed on before, described by the tangent to its force law
/// at the working depth. Units are m and N in translation, rad and N m in rotation.
struct ReportedSurface {
  Vector3 normal = Vector3::Zero();  // unit vector, W: direction in which the surface pushes the tool
  double stiffness = 0.0;            // slope of the tangent, N/m or N m/rad; 0: not identified yet
  double foot = 0.0;                 // depth behind the surface at which the tangent has zero force, >= 0
  // Sequence number of the command whose goal is at the surface. It may be fractional and is refined during
  // the contact. 0: the command is no longer stored; the surface is then at `offset` along the normal from
  // the engagement's anchor.
  double touch_sequence = 0.0;
  double offset = 0.0;
  /// Number of the touch, counted from 1, in which the tool last pressed on this surface; 0: no surface.
  std::uint32_t touch = 0;
  bool pressed = false;
};

inline constexpr std::size_t kSurfaces = 3;

/// Contacts in translation or in rotation.
struct ContactReport {
  // All known surfaces. The normals of any two surfaces differ by at least 26 degrees. Unused entries are at the end.
  std::array<ReportedSurface, kSurfaces> surfaces{};
  // Position at which a limit holds the tool back, relative to the engagement's anchor, in W: a displacement
  // (m) or a rotation vector (rad).
  Vector3 place = Vector3::Zero();
  // Unit vector in W from the tool towards the goal that a limit keeps it from reaching; zero: no limit is
  // active.
  Vector3 held_back = Vector3::Zero();
  double threshold = 0.0;  // force (N) or moment (N m) above which a contact is detected
  double guard = 0.0;      // limit of the force or moment guard, N or N m; 0: not guarded

  [[nodiscard]] bool in_contact() const {
    return std::ranges::any_of(surfaces, [](const ReportedSurface& s) { return s.pressed; });
  }
};

struct StiffnessReport {
  std::uint32_t engagement = 0;  // number of the engagement that the slave follows or last followed
  SafetyState state = SafetyState::kIdle;
  Reason cause{};  // cause of the state
  ContactReport translation{};
  ContactReport rotation{};
  // Sequence number of the newest command whose goal the tool has reached.
  std::uint64_t reached_sequence = 0;
  // Number of the engagement that is requested but not granted (0: none), and the reason.
  std::uint32_t refused = 0;
  Reason refusal{};
  bool gripper_closed = false;
  bool load = false;  // the gripper holds a load
  // Speed limit of the tool because it is in unknown space, m/s; 0: the speed is not limited by this.
  double approach_m_per_s = 0.0;
};

}  // namespace longreach
