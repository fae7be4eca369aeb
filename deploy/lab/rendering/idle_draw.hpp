#pragma once
// A hand at rest: one draw of the campaign `idle`. The master's node with the simulated devices, in virtual
// time; the slave is replaced by its reports. The hand is placed, engages, presses on a surface or not, and
// then stays at rest, or releases the handles.
//
// The evaluation uses only externally measurable values: the commanded force and the true motion of the
// handle (not its encoders), E[k] = E[k-1] - f[k-1] . (x[k] - x[k-1]). Between two averages over one second
// the energy of any linear spring differs by exactly -(f1 + f2)/2 . (x2 - x1); a further decrease of E is
// energy returned to the operator.

#include <cstdint>

#include "master/config/master_config.hpp"

namespace longreach {

struct IdleDraw {
  MasterConfig master{};                         // with resolved device and hand
  Pose place{};                                  // pose of the handle at the engagement
  Vector3 inward = Vector3::UnitX();             // of the surface that it presses on, or turns against
  double wall_n_per_m = 0.0, press_n = 0.0;      // 0: free
  double wall_nm_per_rad = 0.0, press_nm = 0.0;  // likewise
  bool lets_go = false;
  double duration_s = 20.0;
  // Control: additional damping on the filtered velocity of the encoders, as a share of m/T; 0: none.
  double raw_damping = 0.0;
};

/// Results of one port: N and m, or N m and rad.
struct IdlePort {
  double out_j = 0.0;    // energy returned to the operator
  double ripple = 0.0;   // of the force, peak to peak in a second
  double allowed = 0.0;  // one count at the handle times the rendered stiffness
  double motion = 0.0;   // true motion of the handle, back and forth within a second
  double count = 0.0;    // maximum motion of the handle within one count of every encoder
  double force = 0.0;    // mean at the end
  double quiet_s = 0.0;  // evaluated for ripple: the handle moved by less than a tenth of a count
};

struct IdleResult {
  IdlePort translation{}, rotation{};
  bool engaged = false;   // at the end
  bool touched = false;   // a contact was displayed
  bool at_cap = false;    // with the maximum stiffness of the device
  bool injected = false;  // damping, while the hand was at rest
};

IdleResult run_idle_draw(const IdleDraw& draw);

}  // namespace longreach
