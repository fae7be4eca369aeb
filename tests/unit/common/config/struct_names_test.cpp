#include "tests/unit/common/config/struct_names.hpp"

namespace longreach::struct_names_test {
namespace {

using longreach::expect_same;

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
  EXPECT_EQ(s.turns, m.turns());
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
  EXPECT_EQ(s.dead_zone, m.dead_zone());
  EXPECT_EQ(s.reach_m, m.reach_m());
  EXPECT_EQ(s.reach_rad, m.reach_rad());
  EXPECT_EQ(s.speed_m_per_s, m.speed_m_per_s());
  EXPECT_EQ(s.speed_rad_per_s, m.speed_rad_per_s());
  EXPECT_EQ(s.pad, m.pad());
  EXPECT_EQ(s.rumble, m.rumble());
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
  EXPECT_EQ(s.store_j, m.store_j());
  EXPECT_EQ(s.rate_stiffness_n_per_m, m.rate_stiffness_n_per_m());
  EXPECT_EQ(s.rate_damping_n_s_per_m, m.rate_damping_n_s_per_m());
  EXPECT_EQ(s.friction_n, m.friction_n());
  EXPECT_EQ(s.friction_stiffness_n_per_m, m.friction_stiffness_n_per_m());
  EXPECT_EQ(s.rotational_stiffness_nm_per_rad, m.rotational_stiffness_nm_per_rad());
  EXPECT_EQ(s.rotational_damping_nm_s_per_rad, m.rotational_damping_nm_s_per_rad());
  EXPECT_EQ(s.force_max_n, m.force_max_n());
  EXPECT_EQ(s.moment_max_nm, m.moment_max_nm());
  EXPECT_EQ(s.ramp_s, m.ramp_s());
  EXPECT_EQ(s.ke_rotation, m.ke_rotation());
  EXPECT_EQ(s.contact_damping_nm_s_per_rad, m.contact_damping_nm_s_per_rad());
  EXPECT_EQ(s.stiffness_max_nm_per_rad, m.stiffness_max_nm_per_rad());
  EXPECT_EQ(static_cast<int>(s.registration), static_cast<int>(m.registration()));
  EXPECT_EQ(s.slew_n_per_s, m.slew_n_per_s());
  EXPECT_EQ(s.slew_nm_per_s, m.slew_nm_per_s());
  EXPECT_EQ(s.load_factor, m.load_factor());
  EXPECT_EQ(s.friction_nm, m.friction_nm());
  EXPECT_EQ(s.friction_stiffness_nm_per_rad, m.friction_stiffness_nm_per_rad());
  EXPECT_EQ(s.home_spring, m.home_spring());
  EXPECT_EQ(s.ke_by_scale, m.ke_by_scale());
  EXPECT_EQ(s.rate_force_ratio, m.rate_force_ratio());
}

void expect_same(const MasterSafetyConfig& s, const proto::MasterSafety& m) {
  EXPECT_EQ(s.silence_s, m.silence_s());
  EXPECT_EQ(s.resume_s, m.resume_s());
  EXPECT_EQ(s.engage_at_start, m.engage_at_start());
  EXPECT_EQ(static_cast<int>(s.presence), static_cast<int>(m.presence()));
  EXPECT_EQ(s.presence_s, m.presence_s());
}

void expect_same(const MasterLinkConfig& s, const proto::MasterLink& m) {
  EXPECT_EQ(s.slave, m.slave());
  EXPECT_EQ(s.listen, m.listen());
  EXPECT_EQ(s.send_hz, m.send_hz());
  expect_same(s.impairment, m.impairment());
  EXPECT_EQ(s.slave_rpc, m.slave_rpc());
  EXPECT_EQ(s.budget_kbit_per_s, m.budget_kbit_per_s());
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
  EXPECT_EQ(static_cast<int>(s.accuracy), m.accuracy());
  expect_same(s.device_adapter, m.device_adapter());
}

}  // namespace
}  // namespace longreach::struct_names_test
