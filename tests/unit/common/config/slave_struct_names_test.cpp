#include "tests/unit/common/config/struct_names.hpp"

namespace longreach::slave_struct_names_test {
namespace {

using longreach::expect_same;

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
  EXPECT_EQ(s.hold_force_n, m.hold_force_n());
  EXPECT_EQ(s.moment_guard_nm, m.moment_guard_nm());
  EXPECT_EQ(s.give_way_m, m.give_way_m());
  EXPECT_EQ(s.braking_max_m_per_s2, m.braking_max_m_per_s2());
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
  EXPECT_EQ(s.beta_rad, m.beta_rad());
  EXPECT_EQ(s.name, m.name());
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

void expect_same(const ToolLoadConfig& s, const proto::ToolLoad& m) {
  EXPECT_EQ(s.mass_kg, m.mass_kg());
  expect_same(s.com_m, m.com_m());
  expect_same(s.inertia_kg_m2, m.inertia_kg_m2());
}

void expect_same(const SensingConfig& s, const proto::Sensing& m) {
  EXPECT_EQ(s.force_noise_n, m.force_noise_n());
  EXPECT_EQ(s.moment_noise_nm, m.moment_noise_nm());
  EXPECT_EQ(s.touch_n, m.touch_n());
  EXPECT_EQ(s.release_n, m.release_n());
  EXPECT_EQ(s.filter_s, m.filter_s());
  EXPECT_EQ(s.touch_nm, m.touch_nm());
  EXPECT_EQ(s.release_nm, m.release_nm());
  EXPECT_EQ(s.force, m.force());
  EXPECT_EQ(s.moment, m.moment());
  EXPECT_EQ(s.force_bias_n, m.force_bias_n());
  EXPECT_EQ(s.moment_bias_nm, m.moment_bias_nm());
  EXPECT_EQ(s.force_drift_n, m.force_drift_n());
  EXPECT_EQ(s.moment_drift_nm, m.moment_drift_nm());
  EXPECT_EQ(s.force_resolution_n, m.force_resolution_n());
  EXPECT_EQ(s.moment_resolution_nm, m.moment_resolution_nm());
  EXPECT_EQ(s.force_range_n, m.force_range_n());
  EXPECT_EQ(s.moment_range_nm, m.moment_range_nm());
  EXPECT_EQ(s.bandwidth_hz, m.bandwidth_hz());
  expect_same(s.tool, m.tool());
  expect_same(s.gravity_m_per_s2, m.gravity_m_per_s2());
  EXPECT_EQ(s.zero_s, m.zero_s());
}

void expect_same(const EstimatorConfig& s, const proto::Estimator& m) {
  EXPECT_EQ(static_cast<int>(s.kind), m.kind());
  EXPECT_EQ(s.exponent, m.exponent());
  EXPECT_EQ(s.forgetting, m.forgetting());
  EXPECT_EQ(s.depth_memory_s, m.depth_memory_s());
  EXPECT_EQ(s.first_sd, m.first_sd());
  EXPECT_EQ(s.deadband, m.deadband());
}

void expect_same(const SlaveSafetyConfig& s, const proto::SlaveSafety& m) {
  EXPECT_EQ(s.gap_s, m.gap_s());
  EXPECT_EQ(s.age_max_s, m.age_max_s());
  EXPECT_EQ(s.resume_s, m.resume_s());
}

void expect_same(const SlaveLinkConfig& s, const proto::SlaveLink& m) {
  EXPECT_EQ(s.listen, m.listen());
  EXPECT_EQ(s.telemetry_hz, m.telemetry_hz());
  EXPECT_EQ(s.heartbeat_contact_hz, m.heartbeat_contact_hz());
  EXPECT_EQ(s.heartbeat_free_hz, m.heartbeat_free_hz());
  expect_same(s.impairment, m.impairment());
  EXPECT_EQ(s.budget_kbit_per_s, m.budget_kbit_per_s());
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

void expect_same(const WaypointConfig& s, const proto::Waypoint& m) { expect_same(s.point_m, m.point_m()); }

void expect_same(const PlacementConfig& s, const proto::Placement& m) {
  expect_same(s.position_m, m.position_m());
  expect_same(s.rotation_rad, m.rotation_rad());
}

void expect_same(const RobotConfig& s, const proto::Robot& m) {
  EXPECT_EQ(s.name, m.name());
  EXPECT_EQ(s.basis, m.basis());
  EXPECT_EQ(s.servo_hz, m.servo_hz());
  EXPECT_EQ(static_cast<int>(s.convention), m.convention());
  EXPECT_EQ(static_cast<int>(s.prefer), m.prefer());
  expect_same(s.base, m.base());
  expect_same(s.tool, m.tool());
  EXPECT_EQ(s.start_rad, std::vector<double>(m.start_rad().begin(), m.start_rad().end()));
  EXPECT_EQ(s.base_link, m.base_link());
  EXPECT_EQ(s.tip_link, m.tip_link());
  EXPECT_EQ(s.acceleration_max_rad_per_s2, m.acceleration_max_rad_per_s2());
  EXPECT_EQ(s.jerk_max_rad_per_s3, m.jerk_max_rad_per_s3());
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
  EXPECT_EQ(s.scene.robot_file, m.scene().robot_file());
  EXPECT_EQ(s.scene.tool_radius_m, m.scene().tool_radius_m());
  expect_same(s.scene.path.value(), m.scene().path());
  expect_same(s.sensing, m.sensing());
  expect_same(s.estimator, m.estimator());
  expect_same(s.safety, m.safety());
  expect_same(s.rpc, m.rpc());
  EXPECT_EQ(static_cast<int>(s.accuracy), m.accuracy());
  expect_same(s.robot_adapter, m.robot_adapter());
}

}  // namespace
}  // namespace longreach::slave_struct_names_test
