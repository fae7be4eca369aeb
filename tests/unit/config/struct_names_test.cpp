#include <gtest/gtest.h>

#include "common/config/config.hpp"
#include "tests/unit/config/walk.hpp"

namespace longreach {
namespace {

// Field by field, by the names that the compiler knows: two members that are swapped pass the tests above.
void expect_same(const Vector3& v, const google::protobuf::RepeatedField<double>& numbers) {
  ASSERT_EQ(numbers.size(), 3);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(v[i], numbers.Get(i));
}

void expect_same(const ImpairmentConfig& s, const proto::Impairment& m) {
  EXPECT_EQ(s.delay_s, m.delay_s());
  EXPECT_EQ(s.jitter_s, m.jitter_s());
  EXPECT_EQ(s.loss, m.loss());
  EXPECT_EQ(s.loss_burst, m.loss_burst());
  EXPECT_EQ(s.duplicate, m.duplicate());
  EXPECT_EQ(s.reorder, m.reorder());
  EXPECT_EQ(s.corrupt, m.corrupt());
  EXPECT_EQ(s.rate_bit_per_s, m.rate_bit_per_s());
  EXPECT_EQ(s.queue_s, m.queue_s());
  EXPECT_EQ(s.step_delay_s, m.step_delay_s());
  EXPECT_EQ(s.step_start_s, m.step_start_s());
  EXPECT_EQ(s.step_duration_s, m.step_duration_s());
  EXPECT_EQ(s.drift_s_per_s, m.drift_s_per_s());
  EXPECT_EQ(s.blackout_start_s, m.blackout_start_s());
  EXPECT_EQ(s.blackout_duration_s, m.blackout_duration_s());
  EXPECT_EQ(s.blackout_period_s, m.blackout_period_s());
}

void expect_same(const RpcServerConfig& s, const proto::RpcServer& m) { EXPECT_EQ(s.listen, m.listen()); }

void expect_same(const LoopConfig& s, const proto::Loop& m) {
  EXPECT_EQ(s.rate_hz, m.rate_hz());
  EXPECT_EQ(s.priority, m.priority());
  EXPECT_EQ(s.lock_memory, m.lock_memory());
}

template <class Drive>
void expect_same(const DriveConfig& s, const Drive& m) {
  EXPECT_EQ(s.inertia_kg_m2, m.inertia_kg_m2());
  EXPECT_EQ(s.viscous_nm_s_per_rad, m.viscous_nm_s_per_rad());
  EXPECT_EQ(s.coulomb_nm, m.coulomb_nm());
  EXPECT_EQ(s.resolution_rad, m.resolution_rad());
  EXPECT_EQ(s.torque_max_nm, m.torque_max_nm());
  EXPECT_EQ(s.bandwidth_hz, m.bandwidth_hz());
}

void expect_same(const DeltaConfig& s, const proto::Delta& m) {
  EXPECT_EQ(s.arm_m, m.arm_m());
  EXPECT_EQ(s.rod_m, m.rod_m());
  EXPECT_EQ(s.radius_m, m.radius_m());
  EXPECT_EQ(s.offset_m, m.offset_m());
  EXPECT_EQ(s.side_m, m.side_m());
  EXPECT_EQ(s.upwards, m.upwards());
  expect_same(s.azimuth_rad, m.azimuth_rad());
  EXPECT_EQ(s.home_height_m, m.home_height_m());
  EXPECT_EQ(s.platform_kg, m.platform_kg());
  EXPECT_EQ(s.arm_kg, m.arm_kg());
  EXPECT_EQ(s.arm_com_fraction, m.arm_com_fraction());
  EXPECT_EQ(s.forearm_kg, m.forearm_kg());
  expect_same(s.drive, m.drive());
  EXPECT_EQ(s.workspace_m, m.workspace_m());
}

void expect_same(const SphericalConfig& s, const proto::Spherical& m) {
  EXPECT_EQ(s.alpha1_rad, m.alpha1_rad());
  EXPECT_EQ(s.alpha2_rad, m.alpha2_rad());
  EXPECT_EQ(s.beta1_rad, m.beta1_rad());
  EXPECT_EQ(s.beta2_rad, m.beta2_rad());
  EXPECT_EQ(s.inertia_kg_m2, m.inertia_kg_m2());
  expect_same(s.drive, m.drive());
  EXPECT_EQ(s.workspace_rad, m.workspace_rad());
}

void expect_same(const BehaviourConfig& s, const proto::Behaviour& m) {
  EXPECT_EQ(static_cast<int>(s.idle), static_cast<int>(m.idle()));
  EXPECT_EQ(static_cast<int>(s.motion), static_cast<int>(m.motion()));
  EXPECT_EQ(s.home_n_per_m, m.home_n_per_m());
  EXPECT_EQ(s.home_n_s_per_m, m.home_n_s_per_m());
  EXPECT_EQ(s.home_speed_m_per_s, m.home_speed_m_per_s());
  EXPECT_EQ(s.home_nm_per_rad, m.home_nm_per_rad());
  EXPECT_EQ(s.home_nm_s_per_rad, m.home_nm_s_per_rad());
  EXPECT_EQ(s.home_speed_rad_per_s, m.home_speed_rad_per_s());
  EXPECT_EQ(s.guide_n_per_m, m.guide_n_per_m());
  EXPECT_EQ(s.guide_nm_per_rad, m.guide_nm_per_rad());
  EXPECT_EQ(s.free_m, m.free_m());
  EXPECT_EQ(s.free_rad, m.free_rad());
  EXPECT_EQ(s.stop_share, m.stop_share());
  EXPECT_EQ(s.stop_n_per_m, m.stop_n_per_m());
  EXPECT_EQ(s.stop_nm_per_rad, m.stop_nm_per_rad());
}

void expect_same(const DeviceConfig& s, const proto::Device& m) {
  EXPECT_EQ(s.name, m.name());
  EXPECT_EQ(s.basis, m.basis());
  expect_same(s.delta, m.delta());
  expect_same(s.spherical, m.spherical());
  expect_same(s.gravity_m_per_s2, m.gravity_m_per_s2());
  EXPECT_EQ(s.gravity_compensation, m.gravity_compensation());
  EXPECT_EQ(s.delay_samples, m.delay_samples());
  EXPECT_EQ(s.velocity_filter_s, m.velocity_filter_s());
  expect_same(s.behaviour, m.behaviour());
}

void expect_same(const HandConfig& s, const proto::Hand& m) {
  EXPECT_EQ(static_cast<int>(s.grip), static_cast<int>(m.grip()));
}

void expect_same(const OperatorConfig& s, const proto::Operator& m) {
  EXPECT_EQ(static_cast<int>(s.kind), static_cast<int>(m.kind()));
  EXPECT_EQ(s.rate_distance_m, m.rate_distance_m());
  EXPECT_EQ(s.approach_speed_m_per_s, m.approach_speed_m_per_s());
  EXPECT_EQ(s.press_n, m.press_n());
  EXPECT_EQ(s.probe_n, m.probe_n());
  EXPECT_EQ(s.probe_hz, m.probe_hz());
  EXPECT_EQ(s.probe_cycles, m.probe_cycles());
  expect_same(s.direction, m.direction());
  EXPECT_EQ(s.reaction_s, m.reaction_s());
}

void expect_same(const MappingConfig& s, const proto::Mapping& m) {
  EXPECT_EQ(static_cast<int>(s.mode), static_cast<int>(m.mode()));
  EXPECT_EQ(s.scale, m.scale());
  EXPECT_EQ(static_cast<int>(s.rate_law), static_cast<int>(m.rate_law()));
  EXPECT_EQ(s.kv_per_s, m.kv_per_s());
  EXPECT_EQ(s.kv_rotation_per_s, m.kv_rotation_per_s());
  EXPECT_EQ(s.dead_zone_m, m.dead_zone_m());
  EXPECT_EQ(s.dead_zone_rad, m.dead_zone_rad());
  EXPECT_EQ(s.radius_max_m, m.radius_max_m());
  EXPECT_EQ(s.radius_max_rad, m.radius_max_rad());
  EXPECT_EQ(s.speed_max_m_per_s, m.speed_max_m_per_s());
  EXPECT_EQ(s.speed_max_rad_per_s, m.speed_max_rad_per_s());
  expect_same(s.base_rotation_rad, m.base_rotation_rad());
}

void expect_same(const RenderingConfig& s, const proto::Rendering& m) {
  EXPECT_EQ(static_cast<int>(s.law), static_cast<int>(m.law()));
  EXPECT_EQ(s.ke, m.ke());
  EXPECT_EQ(s.contact_damping_n_s_per_m, m.contact_damping_n_s_per_m());
  EXPECT_EQ(s.stiffness_max_n_per_m, m.stiffness_max_n_per_m());
  EXPECT_EQ(s.fade_s, m.fade_s());
  EXPECT_EQ(s.tank_max_j, m.tank_max_j());
  EXPECT_EQ(s.rate_stiffness_n_per_m, m.rate_stiffness_n_per_m());
  EXPECT_EQ(s.rate_damping_n_s_per_m, m.rate_damping_n_s_per_m());
  EXPECT_EQ(s.friction_n, m.friction_n());
  EXPECT_EQ(s.friction_stiffness_n_per_m, m.friction_stiffness_n_per_m());
  EXPECT_EQ(s.rotational_stiffness_nm_per_rad, m.rotational_stiffness_nm_per_rad());
  EXPECT_EQ(s.rotational_damping_nm_s_per_rad, m.rotational_damping_nm_s_per_rad());
  EXPECT_EQ(s.force_max_n, m.force_max_n());
  EXPECT_EQ(s.moment_max_nm, m.moment_max_nm());
  EXPECT_EQ(s.ramp_s, m.ramp_s());
  EXPECT_EQ(s.forget_depth_m, m.forget_depth_m());
  EXPECT_EQ(s.ke_rotation, m.ke_rotation());
  EXPECT_EQ(s.contact_damping_nm_s_per_rad, m.contact_damping_nm_s_per_rad());
  EXPECT_EQ(s.stiffness_max_nm_per_rad, m.stiffness_max_nm_per_rad());
  EXPECT_EQ(static_cast<int>(s.registration), static_cast<int>(m.registration()));
  EXPECT_EQ(s.slew_n_per_s, m.slew_n_per_s());
  EXPECT_EQ(s.slew_nm_per_s, m.slew_nm_per_s());
  EXPECT_EQ(s.forget_depth_rad, m.forget_depth_rad());
  EXPECT_EQ(s.load_factor, m.load_factor());
  EXPECT_EQ(s.friction_nm, m.friction_nm());
  EXPECT_EQ(s.friction_stiffness_nm_per_rad, m.friction_stiffness_nm_per_rad());
  EXPECT_EQ(s.home_spring, m.home_spring());
}

void expect_same(const MasterSafetyConfig& s, const proto::MasterSafety& m) {
  EXPECT_EQ(s.silence_s, m.silence_s());
  EXPECT_EQ(s.resume_s, m.resume_s());
  EXPECT_EQ(s.engage_at_start, m.engage_at_start());
}

void expect_same(const PlayoutConfig& s, const proto::Playout& m) {
  EXPECT_EQ(s.adaptive, m.adaptive());
  EXPECT_EQ(s.fixed_delay_s, m.fixed_delay_s());
  EXPECT_EQ(s.quantile, m.quantile());
  EXPECT_EQ(s.delay_max_s, m.delay_max_s());
}

void expect_same(const CommandConfig& s, const proto::Command& m) {
  EXPECT_EQ(s.speed_max_m_per_s, m.speed_max_m_per_s());
  EXPECT_EQ(s.acceleration_max_m_per_s2, m.acceleration_max_m_per_s2());
  EXPECT_EQ(s.speed_max_rad_per_s, m.speed_max_rad_per_s());
  EXPECT_EQ(s.acceleration_max_rad_per_s2, m.acceleration_max_rad_per_s2());
  EXPECT_EQ(s.force_guard_n, m.force_guard_n());
  EXPECT_EQ(s.guard_stiffness_n_per_m, m.guard_stiffness_n_per_m());
  EXPECT_EQ(s.workspace_m, m.workspace_m());
  EXPECT_EQ(s.tolerance_m, m.tolerance_m());
  EXPECT_EQ(s.iterations_max, m.iterations_max());
}

void expect_same(const JointConfig& s, const proto::Joint& m) {
  EXPECT_EQ(s.a_m, m.a_m());
  EXPECT_EQ(s.alpha_rad, m.alpha_rad());
  EXPECT_EQ(s.d_m, m.d_m());
  EXPECT_EQ(s.theta_rad, m.theta_rad());
  EXPECT_EQ(s.min_rad, m.min_rad());
  EXPECT_EQ(s.max_rad, m.max_rad());
  EXPECT_EQ(s.speed_max_rad_per_s, m.speed_max_rad_per_s());
  EXPECT_EQ(s.acceleration_max_rad_per_s2, m.acceleration_max_rad_per_s2());
  EXPECT_EQ(s.start_rad, m.start_rad());
  EXPECT_EQ(static_cast<int>(s.kind), m.kind());
  EXPECT_EQ(s.draw_radius_m, m.draw_radius_m());
  EXPECT_EQ(s.jerk_max_rad_per_s3, m.jerk_max_rad_per_s3());
  EXPECT_EQ(s.stiffness_nm_per_rad, m.stiffness_nm_per_rad());
  EXPECT_EQ(s.damping_nm_s_per_rad, m.damping_nm_s_per_rad());
  EXPECT_EQ(s.friction_nm, m.friction_nm());
  EXPECT_EQ(s.inertia_kg_m2, m.inertia_kg_m2());
}

void expect_same(const MaterialConfig& s, const proto::Material& m) {
  EXPECT_EQ(s.name, m.name());
  EXPECT_EQ(s.stiffness_n_per_m, m.stiffness_n_per_m());
  EXPECT_EQ(s.reference_depth_m, m.reference_depth_m());
  EXPECT_EQ(s.exponent, m.exponent());
  EXPECT_EQ(s.damping_s_per_m, m.damping_s_per_m());
}

void expect_same(const PlaneConfig& s, const proto::Plane& m) {
  expect_same(s.point_m, m.point_m());
  expect_same(s.normal, m.normal());
  EXPECT_EQ(s.from_tool_start, m.from_tool_start());
}

void expect_same(const SensingConfig& s, const proto::Sensing& m) {
  EXPECT_EQ(s.force_noise_n, m.force_noise_n());
  EXPECT_EQ(s.moment_noise_nm, m.moment_noise_nm());
  EXPECT_EQ(s.touch_n, m.touch_n());
  EXPECT_EQ(s.release_n, m.release_n());
  EXPECT_EQ(s.filter_s, m.filter_s());
}

void expect_same(const EstimatorConfig& s, const proto::Estimator& m) {
  EXPECT_EQ(s.exponent, m.exponent());
  EXPECT_EQ(s.forgetting, m.forgetting());
  EXPECT_EQ(s.depth_filter_s, m.depth_filter_s());
  EXPECT_EQ(s.first_sd, m.first_sd());
  EXPECT_EQ(s.deadband, m.deadband());
}

void expect_same(const SlaveSafetyConfig& s, const proto::SlaveSafety& m) {
  EXPECT_EQ(s.gap_s, m.gap_s());
  EXPECT_EQ(s.age_max_s, m.age_max_s());
  EXPECT_EQ(s.resume_s, m.resume_s());
}

void expect_same(const MasterLinkConfig& s, const proto::MasterLink& m) {
  EXPECT_EQ(s.slave, m.slave());
  EXPECT_EQ(s.listen, m.listen());
  EXPECT_EQ(s.send_hz, m.send_hz());
  expect_same(s.impairment, m.impairment());
}

void expect_same(const SlaveLinkConfig& s, const proto::SlaveLink& m) {
  EXPECT_EQ(s.listen, m.listen());
  EXPECT_EQ(s.telemetry_hz, m.telemetry_hz());
  EXPECT_EQ(s.heartbeat_contact_hz, m.heartbeat_contact_hz());
  EXPECT_EQ(s.heartbeat_free_hz, m.heartbeat_free_hz());
  expect_same(s.impairment, m.impairment());
}

void expect_same(const SphereConfig& s, const proto::Sphere& m) {
  expect_same(s.centre_m, m.centre_m());
  EXPECT_EQ(s.radius_m, m.radius_m());
  EXPECT_EQ(s.from_tool_start, m.from_tool_start());
}

void expect_same(const BoxConfig& s, const proto::Box& m) {
  expect_same(s.centre_m, m.centre_m());
  expect_same(s.size_m, m.size_m());
  expect_same(s.rotation_rad, m.rotation_rad());
  EXPECT_EQ(s.from_tool_start, m.from_tool_start());
}

void expect_same(const CylinderConfig& s, const proto::Cylinder& m) {
  expect_same(s.centre_m, m.centre_m());
  expect_same(s.axis, m.axis());
  EXPECT_EQ(s.radius_m, m.radius_m());
  EXPECT_EQ(s.length_m, m.length_m());
  EXPECT_EQ(s.from_tool_start, m.from_tool_start());
}

void expect_same(const HingeConfig& s, const proto::Hinge& m) {
  expect_same(s.axis, m.axis());
  EXPECT_EQ(s.angle_rad, m.angle_rad());
  EXPECT_EQ(s.arm_m, m.arm_m());
}

void expect_same(const MovementConfig& s, const proto::Movement& m) {
  expect_same(s.velocity_m_per_s, m.velocity_m_per_s());
  expect_same(s.amplitude_m, m.amplitude_m());
  EXPECT_EQ(s.frequency_hz, m.frequency_hz());
}

void expect_same(const SurfaceConfig& s, const proto::Surface& m) {
  EXPECT_EQ(s.name, m.name());
  EXPECT_EQ(s.material, m.material());
  expect_same(s.plane.value(), m.plane());
  expect_same(s.sphere.value(), m.sphere());
  expect_same(s.box.value(), m.box());
  expect_same(s.cylinder.value(), m.cylinder());
  expect_same(s.hinge.value(), m.hinge());
  EXPECT_EQ(s.body, m.body());
  expect_same(s.movement.value(), m.movement());
}

void expect_same(const NeedsConfig& s, const proto::Needs& m) {
  EXPECT_EQ(s.contact, m.contact());
  EXPECT_EQ(s.rotation, m.rotation());
}

void expect_same(const WaypointConfig& s, const proto::Waypoint& m) { expect_same(s.point_m, m.point_m()); }

void expect_same(const ToolConfig& s, const proto::Tool& m) {
  expect_same(s.position_m, m.position_m());
  expect_same(s.rotation_rad, m.rotation_rad());
}

void expect_same(const RobotConfig& s, const proto::Robot& m) {
  EXPECT_EQ(s.name, m.name());
  EXPECT_EQ(s.basis, m.basis());
  EXPECT_EQ(s.servo_hz, m.servo_hz());
  EXPECT_EQ(static_cast<int>(s.convention), m.convention());
  EXPECT_EQ(static_cast<int>(s.prefer), m.prefer());
  expect_same(s.tool, m.tool());
  ASSERT_EQ(m.joint_size(), 6);
  for (int i = 0; i < 6; ++i) expect_same(s.joint[static_cast<std::size_t>(i)], m.joint(i));
}

template <class Structs, class Messages>
void expect_same_list(const Structs& s, const Messages& m) {
  ASSERT_EQ(s.size(), static_cast<std::size_t>(m.size()));
  for (std::size_t i = 0; i < s.size(); ++i) expect_same(s[i], m.Get(static_cast<int>(i)));
}

void expect_same(const PathConfig& s, const proto::Path& m) {
  expect_same_list(s.waypoint, m.waypoint());
  EXPECT_EQ(s.turn_radius_m, m.turn_radius_m());
  EXPECT_EQ(s.from_tool_start, m.from_tool_start());
}

TEST(Structs, CarryEachFieldOfTheMasterUnderItsName) {
  const auto m = distinct<proto::MasterConfig>();
  const MasterConfig s = to_struct(m);
  expect_same(s.link, m.link());
  expect_same(s.loop, m.loop());
  EXPECT_EQ(s.device_file, m.device_file());
  expect_same(s.device, m.device());
  expect_same(s.hand, m.hand());
  expect_same(s.operator_, m.operator_());
  expect_same(s.mapping, m.mapping());
  expect_same(s.rendering, m.rendering());
  expect_same(s.safety, m.safety());
  expect_same(s.rpc, m.rpc());
}

TEST(Structs, CarryEachFieldOfTheSlaveUnderItsName) {
  const auto m = distinct<proto::SlaveConfig>();
  const SlaveConfig s = to_struct(m);
  expect_same(s.link, m.link());
  expect_same(s.loop, m.loop());
  expect_same(s.playout, m.playout());
  expect_same(s.command, m.command());
  EXPECT_EQ(s.robot_file, m.robot_file());
  expect_same(s.robot, m.robot());
  EXPECT_EQ(s.scene_file, m.scene_file());
  EXPECT_EQ(s.scene.name, m.scene().name());
  expect_same_list(s.scene.material, m.scene().material());
  expect_same_list(s.scene.surface, m.scene().surface());
  EXPECT_EQ(s.scene.basis, m.scene().basis());
  expect_same(s.scene.needs.value(), m.scene().needs());
  EXPECT_EQ(s.scene.robot_file, m.scene().robot_file());
  EXPECT_EQ(s.scene.tool_radius_m, m.scene().tool_radius_m());
  expect_same(s.scene.path.value(), m.scene().path());
  expect_same(s.sensing, m.sensing());
  expect_same(s.estimator, m.estimator());
  expect_same(s.safety, m.safety());
  expect_same(s.rpc, m.rpc());
}

}  // namespace
}  // namespace longreach
