#pragma once
// Field lists, as in struct_fields.hpp, for the structs of a scene file.

#include "common/config/field_visit.hpp"
#include "slave/config/scene_config.hpp"

namespace longreach {

template <class Visitor, Is<MaterialConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("name", s.name);
  visit("stiffness_n_per_m", s.stiffness_n_per_m);
  visit("reference_depth_m", s.reference_depth_m);
  visit("exponent", s.exponent);
  visit("damping_s_per_m", s.damping_s_per_m);
}

template <class Visitor, Is<PlaneConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("point_m", s.point_m);
  visit("normal", s.normal);
  visit("from_tool_start", s.from_tool_start);
}

template <class Visitor, Is<SphereConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("centre_m", s.centre_m);
  visit("radius_m", s.radius_m);
  visit("from_tool_start", s.from_tool_start);
}

template <class Visitor, Is<BoxConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("centre_m", s.centre_m);
  visit("size_m", s.size_m);
  visit("rotation_rad", s.rotation_rad);
  visit("from_tool_start", s.from_tool_start);
}

template <class Visitor, Is<CylinderConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("centre_m", s.centre_m);
  visit("axis", s.axis);
  visit("radius_m", s.radius_m);
  visit("length_m", s.length_m);
  visit("from_tool_start", s.from_tool_start);
}

template <class Visitor, Is<HingeConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("axis", s.axis);
  visit("angle_rad", s.angle_rad);
  visit("arm_m", s.arm_m);
}

template <class Visitor, Is<MovementConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("velocity_m_per_s", s.velocity_m_per_s);
  visit("amplitude_m", s.amplitude_m);
  visit("frequency_hz", s.frequency_hz);
}

template <class Visitor, Is<SurfaceConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("name", s.name);
  visit("material", s.material);
  visit("plane", s.plane);
  visit("sphere", s.sphere);
  visit("box", s.box);
  visit("cylinder", s.cylinder);
  visit("hinge", s.hinge);
  visit("body", s.body);
  visit("movement", s.movement);
}

template <class Visitor, Is<WaypointConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("point_m", s.point_m);
}

template <class Visitor, Is<PathConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("waypoint", s.waypoint);
  visit("turn_radius_m", s.turn_radius_m);
  visit("from_tool_start", s.from_tool_start);
}

template <class Visitor, Is<SceneFileConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("name", s.name);
  visit("text", s.text);
}

template <class Visitor, Is<BondConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("stiffness_n_per_m", s.stiffness_n_per_m);
  visit("damping_n_s_per_m", s.damping_n_s_per_m);
  visit("stiffness_nm_per_rad", s.stiffness_nm_per_rad);
  visit("damping_nm_s_per_rad", s.damping_nm_s_per_rad);
  visit("play_m", s.play_m);
  visit("play_rad", s.play_rad);
}

template <class Visitor, Is<GripperConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("fixture", s.fixture);
  visit("reach_m", s.reach_m);
  visit("reach_rad", s.reach_rad);
  visit("bond", s.bond);
}

template <class Visitor, Is<LatchConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("striker", s.striker);
  visit("keeper", s.keeper);
  visit("travel_m", s.travel_m);
  visit("angle_rad", s.angle_rad);
  visit("bond", s.bond);
}

template <class Visitor, Is<BodiesConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("mjcf_file", s.mjcf_file);
  visit("file", s.file);
  visit("gripper", s.gripper);
  visit("latch", s.latch);
}

template <class Visitor, Is<SceneConfig> S>
void visit_fields(Visitor& visit, S& s) {
  visit("name", s.name);
  visit("material", s.material);
  visit("surface", s.surface);
  visit("basis", s.basis);
  visit("robot_file", s.robot_file);
  visit("tool_radius_m", s.tool_radius_m);
  visit("path", s.path);
  visit("bodies", s.bodies);
}

}  // namespace longreach
