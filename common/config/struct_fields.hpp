#pragma once
// Maps struct members to fields of the schema. Each struct has one field list, used in both directions. The
// visitor is called with the name of each field and the member, which is a number, flag, string, enum,
// vector, struct or list of structs.

#include "common/config/scene_fields.hpp"
#include "master/config/master_config.hpp"
#include "slave/config/slave_config.hpp"

namespace longreach {

template <class Visitor, Is<ImpairmentConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("delay_s", s.delay_s);
  visit("jitter_s", s.jitter_s);
  visit("loss", s.loss);
  visit("loss_burst", s.loss_burst);
  visit("duplicate", s.duplicate);
  visit("reorder", s.reorder);
  visit("corrupt", s.corrupt);
  visit("rate_bit_per_s", s.rate_bit_per_s);
  visit("queue_s", s.queue_s);
  visit("step_delay_s", s.step_delay_s);
  visit("step_start_s", s.step_start_s);
  visit("step_duration_s", s.step_duration_s);
  visit("drift_s_per_s", s.drift_s_per_s);
  visit("blackout_start_s", s.blackout_start_s);
  visit("blackout_duration_s", s.blackout_duration_s);
  visit("blackout_period_s", s.blackout_period_s);
  visit("rpc_delay_s", s.rpc_delay_s);
}

template <class Visitor, Is<RpcServerConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("listen", s.listen);
}

template <class Visitor, Is<LoopConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("rate_hz", s.rate_hz);
  visit("priority", s.priority);
  visit("lock_memory", s.lock_memory);
}

template <class Visitor, Is<AdapterConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("address", s.address);
  visit("silence_s", s.silence_s);
}

template <class Visitor, Is<MasterLinkConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("slave", s.slave);
  visit("listen", s.listen);
  visit("send_hz", s.send_hz);
  visit("impairment", s.impairment);
  visit("slave_rpc", s.slave_rpc);
  visit("budget_kbit_per_s", s.budget_kbit_per_s);
}

template <class Visitor, Is<DriveConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("inertia_kg_m2", s.inertia_kg_m2);
  visit("viscous_nm_s_per_rad", s.viscous_nm_s_per_rad);
  visit("coulomb_nm", s.coulomb_nm);
  visit("resolution_rad", s.resolution_rad);
  visit("torque_max_nm", s.torque_max_nm);
  visit("bandwidth_hz", s.bandwidth_hz);
}

template <class Visitor, Is<DeltaConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("arm_m", s.arm_m);
  visit("rod_m", s.rod_m);
  visit("radius_m", s.radius_m);
  visit("offset_m", s.offset_m);
  visit("side_m", s.side_m);
  visit("upwards", s.upwards);
  visit("azimuth_rad", s.azimuth_rad);
  visit("home_height_m", s.home_height_m);
  visit("platform_kg", s.platform_kg);
  visit("arm_kg", s.arm_kg);
  visit("arm_com_fraction", s.arm_com_fraction);
  visit("forearm_kg", s.forearm_kg);
  visit("drive", s.drive);
  visit("workspace_m", s.workspace_m);
}

template <class Visitor, Is<SphericalConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("alpha1_rad", s.alpha1_rad);
  visit("alpha2_rad", s.alpha2_rad);
  visit("beta1_rad", s.beta1_rad);
  visit("beta2_rad", s.beta2_rad);
  visit("inertia_kg_m2", s.inertia_kg_m2);
  visit("drive", s.drive);
  visit("workspace_rad", s.workspace_rad);
}

template <class Visitor, Is<BehaviourConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("idle", s.idle);
  visit("motion", s.motion);
  visit("home_n_per_m", s.home_n_per_m);
  visit("home_n_s_per_m", s.home_n_s_per_m);
  visit("home_speed_m_per_s", s.home_speed_m_per_s);
  visit("home_nm_per_rad", s.home_nm_per_rad);
  visit("home_nm_s_per_rad", s.home_nm_s_per_rad);
  visit("home_speed_rad_per_s", s.home_speed_rad_per_s);
  visit("guide_n_per_m", s.guide_n_per_m);
  visit("guide_nm_per_rad", s.guide_nm_per_rad);
  visit("free_m", s.free_m);
  visit("free_rad", s.free_rad);
  visit("stop_share", s.stop_share);
  visit("stop_n_per_m", s.stop_n_per_m);
  visit("stop_nm_per_rad", s.stop_nm_per_rad);
}

template <class Visitor, Is<DeviceConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("name", s.name);
  visit("basis", s.basis);
  visit("delta", s.delta);
  visit("spherical", s.spherical);
  visit("gravity_m_per_s2", s.gravity_m_per_s2);
  visit("gravity_compensation", s.gravity_compensation);
  visit("delay_samples", s.delay_samples);
  visit("velocity_filter_s", s.velocity_filter_s);
  visit("behaviour", s.behaviour);
  visit("turns", s.turns);
}

template <class Visitor, Is<HandConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("grip", s.grip);
}

template <class Visitor, Is<OperatorConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("kind", s.kind);
  visit("rate_distance_m", s.rate_distance_m);
  visit("approach_speed_m_per_s", s.approach_speed_m_per_s);
  visit("press_n", s.press_n);
  visit("probe_n", s.probe_n);
  visit("probe_hz", s.probe_hz);
  visit("probe_cycles", s.probe_cycles);
  visit("direction", s.direction);
  visit("reaction_s", s.reaction_s);
  visit("dead_zone", s.dead_zone);
  visit("reach_m", s.reach_m);
  visit("reach_rad", s.reach_rad);
  visit("speed_m_per_s", s.speed_m_per_s);
  visit("speed_rad_per_s", s.speed_rad_per_s);
  visit("pad", s.pad);
  visit("rumble", s.rumble);
}

template <class Visitor, Is<MappingConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("mode", s.mode);
  visit("scale", s.scale);
  visit("rate_law", s.rate_law);
  visit("kv_per_s", s.kv_per_s);
  visit("kv_rotation_per_s", s.kv_rotation_per_s);
  visit("dead_zone_m", s.dead_zone_m);
  visit("dead_zone_rad", s.dead_zone_rad);
  visit("radius_max_m", s.radius_max_m);
  visit("radius_max_rad", s.radius_max_rad);
  visit("speed_max_m_per_s", s.speed_max_m_per_s);
  visit("speed_max_rad_per_s", s.speed_max_rad_per_s);
  visit("base_rotation_rad", s.base_rotation_rad);
  visit("goal_follows_force", s.goal_follows_force);
}

template <class Visitor, Is<RenderingConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("law", s.law);
  visit("ke", s.ke);
  visit("contact_damping_n_s_per_m", s.contact_damping_n_s_per_m);
  visit("stiffness_max_n_per_m", s.stiffness_max_n_per_m);
  visit("fade_s", s.fade_s);
  visit("tank_max_j", s.tank_max_j);
  visit("store_j", s.store_j);
  visit("rate_stiffness_n_per_m", s.rate_stiffness_n_per_m);
  visit("rate_damping_n_s_per_m", s.rate_damping_n_s_per_m);
  visit("friction_n", s.friction_n);
  visit("friction_stiffness_n_per_m", s.friction_stiffness_n_per_m);
  visit("rotational_stiffness_nm_per_rad", s.rotational_stiffness_nm_per_rad);
  visit("rotational_damping_nm_s_per_rad", s.rotational_damping_nm_s_per_rad);
  visit("force_max_n", s.force_max_n);
  visit("moment_max_nm", s.moment_max_nm);
  visit("ramp_s", s.ramp_s);
  visit("ke_rotation", s.ke_rotation);
  visit("contact_damping_nm_s_per_rad", s.contact_damping_nm_s_per_rad);
  visit("stiffness_max_nm_per_rad", s.stiffness_max_nm_per_rad);
  visit("registration", s.registration);
  visit("slew_n_per_s", s.slew_n_per_s);
  visit("slew_nm_per_s", s.slew_nm_per_s);
  visit("load_factor", s.load_factor);
  visit("friction_nm", s.friction_nm);
  visit("friction_stiffness_nm_per_rad", s.friction_stiffness_nm_per_rad);
  visit("home_spring", s.home_spring);
  visit("ke_by_scale", s.ke_by_scale);
  visit("rate_force_ratio", s.rate_force_ratio);
}

template <class Visitor, Is<MasterSafetyConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("silence_s", s.silence_s);
  visit("resume_s", s.resume_s);
  visit("engage_at_start", s.engage_at_start);
  visit("presence", s.presence);
  visit("presence_s", s.presence_s);
  visit("gap_s", s.gap_s);
  visit("delay_rise_max_s", s.delay_rise_max_s);
}

template <class Visitor, Is<MasterConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("link", s.link);
  visit("loop", s.loop);
  visit("device_file", s.device_file);
  visit("device", s.device);
  visit("hand", s.hand);
  visit("operator", s.operator_);
  visit("mapping", s.mapping);
  visit("rendering", s.rendering);
  visit("safety", s.safety);
  visit("rpc", s.rpc);
  visit("accuracy", s.accuracy);
  visit("device_adapter", s.device_adapter);
}

template <class Visitor, Is<SlaveLinkConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("listen", s.listen);
  visit("telemetry_hz", s.telemetry_hz);
  visit("heartbeat_contact_hz", s.heartbeat_contact_hz);
  visit("heartbeat_free_hz", s.heartbeat_free_hz);
  visit("impairment", s.impairment);
  visit("budget_kbit_per_s", s.budget_kbit_per_s);
}

template <class Visitor, Is<PlayoutConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("adaptive", s.adaptive);
  visit("fixed_delay_s", s.fixed_delay_s);
  visit("quantile", s.quantile);
  visit("delay_max_s", s.delay_max_s);
}

template <class Visitor, Is<CommandConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("speed_max_m_per_s", s.speed_max_m_per_s);
  visit("acceleration_max_m_per_s2", s.acceleration_max_m_per_s2);
  visit("speed_max_rad_per_s", s.speed_max_rad_per_s);
  visit("acceleration_max_rad_per_s2", s.acceleration_max_rad_per_s2);
  visit("force_guard_n", s.force_guard_n);
  visit("guard_stiffness_n_per_m", s.guard_stiffness_n_per_m);
  visit("workspace_m", s.workspace_m);
  visit("tolerance_m", s.tolerance_m);
  visit("iterations_max", s.iterations_max);
  visit("hold_force_n", s.hold_force_n);
  visit("moment_guard_nm", s.moment_guard_nm);
  visit("give_way_m", s.give_way_m);
  visit("braking_max_m_per_s2", s.braking_max_m_per_s2);
}

template <class Visitor, Is<JointConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("a_m", s.a_m);
  visit("alpha_rad", s.alpha_rad);
  visit("d_m", s.d_m);
  visit("theta_rad", s.theta_rad);
  visit("min_rad", s.min_rad);
  visit("max_rad", s.max_rad);
  visit("speed_max_rad_per_s", s.speed_max_rad_per_s);
  visit("acceleration_max_rad_per_s2", s.acceleration_max_rad_per_s2);
  visit("start_rad", s.start_rad);
  visit("kind", s.kind);
  visit("draw_radius_m", s.draw_radius_m);
  visit("jerk_max_rad_per_s3", s.jerk_max_rad_per_s3);
  visit("stiffness_nm_per_rad", s.stiffness_nm_per_rad);
  visit("damping_nm_s_per_rad", s.damping_nm_s_per_rad);
  visit("friction_nm", s.friction_nm);
  visit("inertia_kg_m2", s.inertia_kg_m2);
  visit("beta_rad", s.beta_rad);
  visit("name", s.name);
}

template <class Visitor, Is<PlacementConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("position_m", s.position_m);
  visit("rotation_rad", s.rotation_rad);
}

template <class Visitor, Is<RobotConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("name", s.name);
  visit("basis", s.basis);
  visit("joint", s.joint);
  visit("servo_hz", s.servo_hz);
  visit("load_max_kg", s.load_max_kg);
  visit("convention", s.convention);
  visit("base", s.base);
  visit("tool", s.tool);
  visit("prefer", s.prefer);
  visit("start_rad", s.start_rad);
  visit("base_link", s.base_link);
  visit("tip_link", s.tip_link);
  visit("acceleration_max_rad_per_s2", s.acceleration_max_rad_per_s2);
  visit("jerk_max_rad_per_s3", s.jerk_max_rad_per_s3);
}

template <class Visitor, Is<ToolLoadConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("mass_kg", s.mass_kg);
  visit("com_m", s.com_m);
  visit("inertia_kg_m2", s.inertia_kg_m2);
}

template <class Visitor, Is<SensingConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("force_noise_n", s.force_noise_n);
  visit("moment_noise_nm", s.moment_noise_nm);
  visit("touch_n", s.touch_n);
  visit("release_n", s.release_n);
  visit("filter_s", s.filter_s);
  visit("force_bias_n", s.force_bias_n);
  visit("moment_bias_nm", s.moment_bias_nm);
  visit("force_drift_n", s.force_drift_n);
  visit("moment_drift_nm", s.moment_drift_nm);
  visit("force_resolution_n", s.force_resolution_n);
  visit("moment_resolution_nm", s.moment_resolution_nm);
  visit("force_range_n", s.force_range_n);
  visit("moment_range_nm", s.moment_range_nm);
  visit("bandwidth_hz", s.bandwidth_hz);
  visit("tool", s.tool);
  visit("gravity_m_per_s2", s.gravity_m_per_s2);
  visit("zero_s", s.zero_s);
  visit("touch_nm", s.touch_nm);
  visit("release_nm", s.release_nm);
  visit("force", s.force);
  visit("moment", s.moment);
}

template <class Visitor, Is<EstimatorConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("kind", s.kind);
  visit("exponent", s.exponent);
  visit("forgetting", s.forgetting);
  visit("depth_memory_s", s.depth_memory_s);
  visit("first_sd", s.first_sd);
  visit("deadband", s.deadband);
}

template <class Visitor, Is<SlaveSafetyConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("gap_s", s.gap_s);
  visit("age_max_s", s.age_max_s);
  visit("resume_s", s.resume_s);
  visit("delay_rise_max_s", s.delay_rise_max_s);
}

template <class Visitor, Is<SlaveConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("link", s.link);
  visit("loop", s.loop);
  visit("playout", s.playout);
  visit("command", s.command);
  visit("robot_file", s.robot_file);
  visit("robot", s.robot);
  visit("scene_file", s.scene_file);
  visit("scene", s.scene);
  visit("sensing", s.sensing);
  visit("estimator", s.estimator);
  visit("safety", s.safety);
  visit("rpc", s.rpc);
  visit("accuracy", s.accuracy);
  visit("robot_adapter", s.robot_adapter);
}

}  // namespace longreach
