#pragma once
// Detects whether a limit keeps the tool from its goal (held_back.hpp), in position and in rotation, and the
// direction of the limit if only one is active.

#include "slave/command/held_back.hpp"
#include "slave/estimation/contact.hpp"

namespace longreach {

struct ToolHeldBackInput {
  Clamps clamps{};
  Pose X_WE{};  // measured
  Pose X_WE_goal{};
  Pose X_WE_anchor{};
  Vector3 centre_m = Vector3::Zero();  // of the workspace
  double dt = 0.0;
};

class ToolHeldBack {
 public:
  void reset() {
    place_.reset();
    turn_.reset();
  }
  void step(const ToolHeldBackInput& in, const SlaveContact& contact, const SlaveContact& turn_contact) {
    const Clamps& clamps = in.clamps;
    const Vector3 missing_m = in.X_WE_goal.p - in.X_WE.p;
    const bool arm = clamps.joint_position || clamps.singularity || clamps.unreachable;
    // Several simultaneous limits have no single direction.
    Vector3 along = Vector3::Zero(), about = Vector3::Zero();
    if (!arm && clamps.workspace && !clamps.force_guard) along = (in.X_WE.p - in.centre_m).stableNormalized();
    if (!arm && !clamps.workspace && contact.in_contact()) along = -contact.normal();
    // The guard may also limit a motion beside the contact.
    if (clamps.force_guard && along.dot(missing_m) <= kFar_m) along.setZero();
    if (!arm && clamps.moment_guard && turn_contact.in_contact()) about = -turn_contact.normal();
    place_.step(in.X_WE.p - in.X_WE_anchor.p, missing_m, arm || clamps.workspace || clamps.force_guard, along,
                in.dt);
    turn_.step(log_rotation(in.X_WE.q * in.X_WE_anchor.q.conjugate()),
               log_rotation(in.X_WE_goal.q * in.X_WE.q.conjugate()), arm || clamps.moment_guard, about,
               in.dt);
  }
  /// Directions for position and rotation: unit vectors in W towards the goal, or zero if no limit holds the
  /// tool back.
  [[nodiscard]] const Vector3& place() const { return place_.direction(); }
  [[nodiscard]] const Vector3& turn() const { return turn_.direction(); }

 private:
  /// Distance from the goal, in m and in rad, above which the tool is considered held back.
  static constexpr double kFar_m = 2e-3, kFar_rad = 0.02;
  HeldBack place_{kFar_m}, turn_{kFar_rad};
};

}  // namespace longreach
