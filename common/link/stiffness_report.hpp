#pragma once
// Sent by the slave to the master: the estimated stiffness of each surface, which is the only haptic quantity
// that crosses the link, and the point in the operator's motion at which the surface was touched. The
// renderer receives this type and no other data from the slave.

#include <algorithm>
#include <array>
#include <cstdint>

#include "common/link/hold_cause.hpp"
#include "common/spatial/spatial.hpp"
#include "schema/state_link.hpp"

namespace longreach {

/// Maximum stiffness in a report, N/m or N m/rad. Above this value the force changes without measurable
/// motion, so that no stiffness is identifiable.
inline constexpr double kStiffnessMaxNPerM = 1e12;

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

template <class Visitor, Is<ContactReport> S>
void visit_fields(Visitor& visit, S& s) {
  visit("first", s.surfaces[0]);
  visit("second", s.surfaces[1]);
  visit("third", s.surfaces[2]);
  visit("place", s.place);
  visit("held_back", s.held_back);
  visit("threshold", s.threshold);
  visit("guard", s.guard);
}

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

template <class Visitor, Is<StiffnessReport> S>
void visit_fields(Visitor& visit, S& s) {
  visit("engagement", s.engagement);
  visit("state", s.state);
  visit("cause", s.cause);
  visit("translation", s.translation);
  visit("rotation", s.rotation);
  visit("reached_sequence", s.reached_sequence);
  visit("cause_place", s.cause);
  visit("refused", s.refused);
  visit("refusal", s.refusal);
  visit("refusal_place", s.refusal);
  visit("gripper_closed", s.gripper_closed);
  visit("load", s.load);
  visit("approach_m_per_s", s.approach_m_per_s);
}

}  // namespace longreach
