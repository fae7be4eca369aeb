#include "deploy/python/lab_state.hpp"

#include "common/rpc/status_fields.hpp"

namespace longreach {

LabState state_of(const Laboratory& lab) {
  const MasterView& m = lab.master();
  const SlaveView& s = lab.slave();
  LabState now;
  now.time_s = lab.now_s();
  now.state = to_string(m.state);
  now.slave_state = to_string(s.state);
  now.mode = m.mode == MotionMode::kRate ? "rate" : "position";
  now.scale = m.scale;
  now.handle_m = m.p_MH;
  now.handle_m_per_s = lab.devices().delta().velocity_m_per_s();
  now.force_n = m.F_H_M.force;
  now.moment_nm = m.F_H_M.moment;
  now.spring_n = m.spring_force_n;
  now.surface_known = m.surface_known;
  now.inward = m.inward;
  now.surface_m = m.surface_m;
  now.stiffness_n_per_m = m.stiffness_n_per_m;
  now.goal_m = m.goal_m;
  now.X_WE.topLeftCorner<3, 3>() = s.X_WE.q.toRotationMatrix();
  now.X_WE.topRightCorner<3, 1>() = s.X_WE.p;
  now.anchor_m = s.X_WE_anchor.p;
  now.tool_n = s.F_E_W.force;
  now.tool_nm = s.F_E_W.moment;
  now.in_contact = s.in_contact;
  now.estimate_n_per_m = s.estimate.stiffness_n_per_m;
  now.estimate_sd_n_per_m = s.estimate.stiffness_sd_n_per_m;
  now.reported_n_per_m = s.reported_stiffness_n_per_m;
  if (m.far_known) {
    now.far_m = m.far.X_WE.p;
    now.far_n = m.far.F_E_W.force;
    now.far_contact = m.in_contact;
  }
  now.true_n = lab.arm().true_wrench().force;
  now.true_n_per_m = lab.arm().material_stiffness(lab.rendered_at_m());
  now.penetration_m = lab.arm().true_penetration_m();
  now.port_energy_j = m.port_energy_j;
  now.round_trip_s = m.rtt_s;
  return now;
}

}  // namespace longreach
