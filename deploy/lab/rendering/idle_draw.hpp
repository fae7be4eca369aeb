#pragma once
// One random case of the campaign `idle`, which tests a hand at rest. The master node runs in virtual time
// with the simulated devices, and generated reports replace the slave. The hand moves to a pose, engages, may
// press on a surface, and then stays at rest or releases the handles.
//
// The evaluation uses only quantities that can be measured from outside: the commanded force and the true
// motion of the handle, not its encoders. The port energy is E[k] = E[k-1] - f[k-1] . (x[k] - x[k-1]).
// Between consecutive one-second averages, the energy of any linear spring changes by exactly -(f1 + f2)/2 .
// (x2 - x1); any further decrease of E is energy returned to the operator.

#include <cstdint>

#include "master/config/master_config.hpp"

namespace longreach {

struct IdleDraw {
  MasterConfig master{};  // with the device and hand configurations resolved
  Pose place{};           // pose of the handle when it engages
  /// Inward normal of the surface against which the hand presses or turns.
  Vector3 inward = Vector3::UnitX();
  double wall_n_per_m = 0.0, press_n = 0.0;      // 0: no contact
  double wall_nm_per_rad = 0.0, press_nm = 0.0;  // the same for rotation
  bool lets_go = false;
  double duration_s = 20.0;
  // Control: additional damping on the filtered encoder velocity, as a fraction of m/T; 0: none.
  double raw_damping = 0.0;
};

/// Results for one port, in N and m or in N m and rad.
struct IdlePort {
  double out_j = 0.0;   // energy returned to the operator
  double ripple = 0.0;  // peak-to-peak ripple of the force within one second
  /// Permitted ripple: the motion of the handle for one encoder count times the rendered stiffness.
  double allowed = 0.0;
  double motion = 0.0;  // true back-and-forth motion of the handle within one second
  double count = 0.0;   // maximum motion of the handle if every encoder changes by one count
  double force = 0.0;   // mean force at the end
  /// Time over which the ripple was evaluated, i.e. in which the handle drifted by less than a tenth of
  /// `count` per second.
  double quiet_s = 0.0;
};

struct IdleResult {
  IdlePort translation{}, rotation{};
  bool engaged = false;   // engaged at the end
  bool touched = false;   // a contact force was displayed
  bool at_cap = false;    // the rendered stiffness was the maximum that the device can render
  bool injected = false;  // damping was injected while the hand was at rest
};

IdleResult run_idle_draw(const IdleDraw& draw);

}  // namespace longreach
