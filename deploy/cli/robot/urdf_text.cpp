#include "deploy/cli/robot/urdf_text.hpp"

#include <algorithm>
#include <cmath>

#include "common/text/number_text.hpp"
#include "slave/kinematics/kinematics.hpp"

namespace longreach {
namespace {

std::string xml_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

std::string three(double x, double y, double z) {
  return format_number(x) + " " + format_number(y) + " " + format_number(z);
}

// Roll, pitch and yaw about fixed axes. If the pitch is ±90 degrees, the yaw is set to 0.
std::string origin(const Rigid& X) {
  const Matrix3& R = X.R;
  const double flat = std::hypot(R(0, 0), R(1, 0));
  const double pitch = std::atan2(-R(2, 0), flat);
  const bool upright = flat < 1e-12;
  const double roll = upright ? std::atan2(-R(1, 2), R(1, 1)) : std::atan2(R(2, 1), R(2, 2));
  const double yaw = upright ? 0.0 : std::atan2(R(1, 0), R(0, 0));
  return "<origin xyz=\"" + three(X.p.x(), X.p.y(), X.p.z()) + "\" rpy=\"" + three(roll, pitch, yaw) + "\"/>";
}

std::string type_of(JointKind kind) {
  return kind == JointKind::kFixed ? "fixed" : kind == JointKind::kPrismatic ? "prismatic" : "revolute";
}

Rigid turned(double angle_rad) {
  return {exp_rotation({0.0, 0.0, angle_rad}).toRotationMatrix(), Vector3::Zero()};
}

std::string joint_text(const std::string& name, const std::string& type, const std::string& parent,
                       const std::string& child, const Rigid& X, const std::string& more) {
  return "  <joint name=\"" + xml_text(name) + "\" type=\"" + type + "\">\n    <parent link=\"" + parent +
         "\"/>\n    <child link=\"" + child + "\"/>\n    " + origin(X) + "\n" + more + "  </joint>\n";
}

}  // namespace

std::string urdf_text(const RobotConfig& robot) {
  const Kinematics kinematics(robot);
  std::string text =
      "<?xml version=\"1.0\"?>\n<robot name=\"" + xml_text(robot.name) + "\">\n  <link name=\"base\"/>\n";
  Rigid X = kinematics.base();  // from the frame of the parent link to the frame of the row
  std::string parent = "base";
  for (std::size_t i = 0; i < kMaxJoints; ++i) {
    const JointConfig& joint = robot.joint[i];
    const JointRow& row = kinematics.links()[i];
    const std::string number = std::to_string(i + 1), child = "link_" + number;
    std::string more = "    <axis xyz=\"0 0 1\"/>\n";
    if (joint.kind != JointKind::kFixed)
      more += "    <limit lower=\"" + format_number(joint.min_rad) + "\" upper=\"" +
              format_number(joint.max_rad) + "\" velocity=\"" + format_number(joint.speed_max_rad_per_s) +
              "\" effort=\"0\"/>\n";
    text += "  <link name=\"" + child + "\"/>\n" +
            joint_text(joint.name.empty() ? "joint_" + number : joint.name, type_of(joint.kind), parent,
                       child, X * turned(row.theta_rad), more);
    X = {rotation_behind(row), Vector3(row.a_m, 0.0, row.d_m)};
    parent = child;
  }
  text += "  <link name=\"tool\"/>\n" +
          joint_text("tool_joint", "fixed", parent, "tool", X * kinematics.tool(), "");
  return text + "</robot>\n";
}

}  // namespace longreach
