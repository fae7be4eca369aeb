#pragma once
// A hand that nobody moves: one draw of the campaign `idle`. The master's node with the simulated devices, in
// virtual time; the slave is played by the reports that it would send. The hand is placed, engages, presses
// on a surface or not, and then keeps still, or lets go of the handles.
//
// What is judged is what an outsider could have measured: the force that was commanded and the true motion of
// the handle (not its encoders), E[k] = E[k-1] - f[k-1] . (x[k] - x[k-1]). Of two averages of a second each
// the energy of any linear spring differs by -(f1 + f2)/2 . (x2 - x1), exactly; what E falls by beyond that
// has come out.

#include <cstdint>

#include "master/config/master_config.hpp"

namespace longreach {

struct IdleDraw {
  MasterConfig master{};                         // device and hand resolved
  Pose place{};                                  // of the handle, where it engages
  Vector3 inward = Vector3::UnitX();             // of the surface that it presses on, or turns against
  double wall_n_per_m = 0.0, press_n = 0.0;      // 0: free
  double wall_nm_per_rad = 0.0, press_nm = 0.0;  // likewise
  bool lets_go = false;
  double duration_s = 20.0;
  // Control: damping on the filtered velocity of the encoders besides, as a share of m/T; 0: none.
  double raw_damping = 0.0;
};

/// Of one port: N and m, or N m and rad.
struct IdlePort {
  double out_j = 0.0;    // energy that came out
  double ripple = 0.0;   // of the force, peak to peak in a second
  double allowed = 0.0;  // one count at the handle times the stiffness rendered
  double motion = 0.0;   // of the handle, truly, to and fro within a second
  double count = 0.0;    // longest way of the handle within one count of every encoder
  double force = 0.0;    // mean at the end
  double quiet_s = 0.0;  // judged for ripple: the handle did not go on by a tenth of a count
};

struct IdleResult {
  IdlePort translation{}, rotation{};
  bool engaged = false;   // at the end
  bool touched = false;   // a contact was felt
  bool at_cap = false;    // with the stiffest spring that the device can render
  bool injected = false;  // damping, while the hand was still
};

IdleResult run_idle_draw(const IdleDraw& draw);

}  // namespace longreach
