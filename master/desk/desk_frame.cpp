#include "master/desk/desk_frame.hpp"

#include "common/rpc/status_fields.hpp"
#include "master/console/words.hpp"

namespace longreach {
namespace {

void add_states(proto::Frame& out, const ConsoleSnapshot& s) {
  const MasterView& view = s.view;
  out.set_state(std::string(to_string(view.state)));
  out.set_cause(cause_in_words(view));
  out.set_far_state(std::string(to_string(view.far_state)));
  out.set_engagement(view.engagement);
  out.set_situation(std::string(text_of(s.shown.situation).key));
  out.set_happening(s.shown.sentence);
  for (const std::string& words : s.shown.limits) out.add_clamped(words);
  out.set_mode(std::string(mode_in_words(view.mode)));
  out.set_scale(view.scale);
  out.set_clutched(view.clutched);
  out.set_gripping(view.gripper_closed);
  out.set_hand_missing(view.hand_missing);
  out.set_hand_outside(s.hand_outside);
}

void add_hand(proto::Frame& out, const ConsoleSnapshot& s, double workspace_m) {
  const MasterView& view = s.view;
  assign(view.p_MH, *out.mutable_hand_m());
  assign(view.F_H_M.force, *out.mutable_force_n());
  assign(view.F_H_M.moment, *out.mutable_moment_nm());
  assign(view.spring_force_n, *out.mutable_spring_n());
  out.set_force_max_n(s.force_max_n);
  out.set_workspace_m(workspace_m);
  assign(view.goal_m, *out.mutable_goal_m());
  assign(view.goal_rad, *out.mutable_goal_rad());
  assign(view.forecast.p, *out.mutable_forecast_m());
  assign(log_rotation(view.forecast.q), *out.mutable_forecast_rad());
  out.set_in_contact(view.in_contact);
  out.set_surface_known(view.surface_known);
  out.set_surface_m(view.surface_m);
  assign(view.inward, *out.mutable_inward());
  out.set_stiffness_n_per_m(view.stiffness_n_per_m);
  out.set_rotational_stiffness_nm_per_rad(view.rotational_stiffness_nm_per_rad);
  out.set_energy_j(view.port_energy_j);
  out.set_energy_min_j(view.port_energy_min_j);
  out.set_tank_j(view.tank_j);
}

void add_far(proto::FarFrame& out, const Telemetry& far) {
  out.set_engagement(far.engagement);
  for (const double joint : far.joint_rad) out.add_joint_rad(joint);
  assign(far.X_WE.p, *out.mutable_tool_m());
  assign(log_rotation(far.X_WE.q), *out.mutable_tool_rad());
  assign(far.X_WE_goal.p, *out.mutable_goal_m());
  assign(far.F_E_W.force, *out.mutable_force_n());
  assign(far.F_E_W.moment, *out.mutable_moment_nm());
  out.set_stiffness_n_per_m(far.estimate.valid ? far.estimate.stiffness_n_per_m : 0.0);
  out.set_penetration_m(far.penetration_m);
  add_clamps(*out.mutable_clamped(), far.clamps, far.X_WE, far.X_WE_goal);
  out.set_gripping(far.gripper.closed);
  out.set_holds(far.gripper.holds);
  if (far.gripper.load_sd_kg > 0.0) {
    out.set_load_kg(far.gripper.load_kg);
    out.set_load_sd_kg(far.gripper.load_sd_kg);
  }
  out.set_playout_delay_s(far.playout_delay_s);
}

}  // namespace

proto::Frame to_frame(const ConsoleSnapshot& s, double workspace_m) {
  proto::Frame out;
  out.set_seconds(s.seconds);
  add_states(out, s);
  add_hand(out, s, workspace_m);
  *out.mutable_link() = to_message(s.link);
  out.set_missed_ticks(s.missed_ticks);
  out.set_ticks_late_100ms(s.late_ticks);
  out.set_false_holds(s.view.false_holds);
  if (!s.view.far_known) return out;
  add_far(*out.mutable_far(), s.view.far);
  if (const auto age_s = age_of_news_s(s)) out.mutable_far()->set_age_s(*age_s);
  add_reduced(*out.mutable_far()->mutable_reduced_protection(), s.view.reduced | s.view.far.reduced);
  if (s.view.approach_m_per_s > 0.0) out.mutable_far()->set_approach_m_per_s(s.view.approach_m_per_s);
  out.set_up_loss(s.view.far.up_loss);
  out.set_limit_violations(s.view.far.limit_violations);
  return out;
}

}  // namespace longreach
