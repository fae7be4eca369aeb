#pragma once
// What the laboratory asks and does to the free bodies of a simulation: those of longreach (bodies.hpp) or of MuJoCo.
// Frame S has its origin at the start position of the tool and the axes of W.

#include <cstdint>
#include <optional>

#include "slave/simulation/scene/collision_model.hpp"

namespace longreach {

struct BodiesContact {
  /// Mean wrench that the contacts and the held body exert on the tool at E during the step.
  Wrench F_E_W{};
  /// Depth of the deepest contact of the tool or of the held body.
  double depth_m = 0.0;
  int contacts = 0;    // number of pairs of geoms in contact
  bool holds = false;  // the gripper holds a body
  bool latched = false;
};

struct BodiesEnergy {
  double stored_j = 0.0;     // kinetic and gravitational energy plus that in contacts and bonds
  double tool_work_j = 0.0;  // work done by the tool so far
  double spent_j = 0.0;      // released by gripper and latch so far
};

class FreeBodies {
 public:
  virtual ~FreeBodies() = default;
  [[nodiscard]] virtual int count() const = 0;
  [[nodiscard]] virtual const FreeBody& body(int i) const = 0;
  /// State of a body, in S.
  [[nodiscard]] virtual const RigidState& state(int i) const = 0;
  [[nodiscard]] virtual const BodiesContact& contact() const = 0;
  virtual void push(int i, const Vector3& v_m_per_s,
                    const Vector3& w_rad_per_s) = 0;  // sets the velocities of a body, in W
  virtual void place(int i, const Pose& X_S) = 0;     // sets the pose of the body's inertial frame in S
  /// Vector from E to the fixture of the gripper, in W; zero if there is no gripper.
  [[nodiscard]] virtual Vector3 to_fixture_m() const = 0;
  /// None: the simulation does not account for energy.
  [[nodiscard]] virtual std::optional<BodiesEnergy> energy() const { return {}; }
  /// Number of steps that were subdivided as far as allowed without converging.
  [[nodiscard]] virtual std::uint64_t unconverged() const { return 0; }

  /// Displacement of a body from its start, in W.
  [[nodiscard]] Pose displaced(int i) const {
    const Pose &X = state(i).X, &start = body(i).X_start;
    return {X.p - start.p, (X.q * start.q.conjugate()).normalized()};
  }
};

}  // namespace longreach
