// The joints of a URDF: their place, axis and limits.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "common/config/robot/urdf_tree.hpp"
#include "common/text/number_text.hpp"

namespace longreach {
namespace {

using tinyxml2::XMLElement;

std::optional<UrdfJoint::Kind> kind_of(std::string_view type) {
  if (type == "fixed") return UrdfJoint::Kind::kFixed;
  if (type == "revolute") return UrdfJoint::Kind::kRevolute;
  if (type == "continuous") return UrdfJoint::Kind::kContinuous;
  if (type == "prismatic") return UrdfJoint::Kind::kPrismatic;
  return std::nullopt;
}

// Roll, pitch and yaw about fixed axes.
Quaternion from_rpy(const Vector3& rpy) {
  return Quaternion(Eigen::AngleAxisd(rpy.z(), Vector3::UnitZ()) *
                    Eigen::AngleAxisd(rpy.y(), Vector3::UnitY()) *
                    Eigen::AngleAxisd(rpy.x(), Vector3::UnitX()));
}

}  // namespace

// URDF 1.1 has quat_xyzw as an alternative to rpy.
Quaternion UrdfTree::rotation_of(const XMLElement& origin) const {
  constexpr double kRounded = 0.01;  // how far the length of a quaternion may be from 1
  const char* text = origin.Attribute("quat_xyzw");
  if (text == nullptr) return from_rpy(vector_of(origin, "rpy", Vector3::Zero()));
  if (origin.Attribute("rpy") != nullptr)
    fail(origin.GetLineNum(), "<origin> has rpy and quat_xyzw; remove one of them");
  const std::vector<double> q = numbers_of(origin, "quat_xyzw");
  if (q.size() != 4)
    fail(origin.GetLineNum(), "<origin> has quat_xyzw=\"" + std::string(text) + "\" with " +
                                  std::to_string(q.size()) + " numbers; four are required");
  const Quaternion rotation(q[3], q[0], q[1], q[2]);
  const double length = rotation.coeffs().stableNorm();
  if (!(std::abs(length - 1.0) <= kRounded))
    fail(origin.GetLineNum(), "<origin> has quat_xyzw=\"" + std::string(text) + "\" with the length " +
                                  format_number(length) + "; a rotation has the length 1");
  return rotation.normalized();
}

// Other readers use the first one and ignore the others.
void UrdfTree::refuse_twice(const Edge& edge) const {
  for (const char* name : {"origin", "axis", "limit", "parent", "child", "mimic", "safety_controller"}) {
    const XMLElement* first = edge.element->FirstChildElement(name);
    if (first == nullptr) continue;
    if (const XMLElement* second = first->NextSiblingElement(name))
      fail(second->GetLineNum(), "joint \"" + edge.name + "\" has more than one <" + name + ">");
  }
}

UrdfJoint UrdfTree::joint_of(const Edge& edge) const {
  const XMLElement& element = *edge.element;
  const std::string type = text_of(element, "type"), called = "joint \"" + edge.name + "\"";
  const auto kind = kind_of(type);
  if (!kind)
    fail(element.GetLineNum(),
         called + " has the type \"" + type +
             "\"; between base and tip, a joint must be revolute, continuous, prismatic or fixed");
  UrdfJoint joint{edge.name, *kind, element.GetLineNum()};
  refuse_twice(edge);
  if (const XMLElement* origin = element.FirstChildElement("origin"))
    joint.X_PJ = {vector_of(*origin, "xyz", Vector3::Zero()), rotation_of(*origin)};
  if (joint.kind == UrdfJoint::Kind::kFixed) return joint;
  if (const XMLElement* mimic = element.FirstChildElement("mimic"))
    fail(mimic->GetLineNum(), called +
                                  " follows another joint (<mimic>), but each joint between base and "
                                  "tip needs its own motor");
  if (const XMLElement* axis = element.FirstChildElement("axis")) {
    joint.axis = vector_of(*axis, "xyz", Vector3::UnitX());
    const double length = joint.axis.stableNorm();
    if (!(length > 1e-9))
      fail(axis->GetLineNum(),
           called + " has the axis \"" + axis->Attribute("xyz") + "\", which has no direction");
    joint.axis /= length;
  }
  read_limits(element, joint);
  return joint;
}

void UrdfTree::read_limits(const XMLElement& element, UrdfJoint& joint) const {
  const std::string called = "joint \"" + joint.name + "\"";
  const XMLElement* limit = element.FirstChildElement("limit");
  const bool continuous = joint.kind == UrdfJoint::Kind::kContinuous;
  const std::string range = continuous ? "" : "lower=\"...\" upper=\"...\" ";
  if (limit == nullptr)
    fail(element.GetLineNum(),
         called + " has no <limit>; add <limit " + range + "velocity=\"...\" effort=\"...\"/>, in rad or m");
  joint.speed_max = number_of(*limit, "velocity", 0.0, Infinity::kAllowed);
  if (!(joint.speed_max > 0.0) || std::isinf(joint.speed_max))
    fail(limit->GetLineNum(), called + " has " +
                                  (limit->Attribute("velocity") == nullptr
                                       ? std::string("no velocity in its <limit>")
                                       : "velocity=\"" + std::string(limit->Attribute("velocity")) + "\"") +
                                  "; give its maximum speed, which must be above 0 rad/s or m/s");
  joint.acceleration_max = positive_of(*limit, "acceleration");
  const std::optional<double> deceleration = positive_of(*limit, "deceleration");
  if (deceleration)
    joint.acceleration_max = std::min(joint.acceleration_max.value_or(*deceleration), *deceleration);
  joint.jerk_max = positive_of(*limit, "jerk");
  if (!continuous) read_range(element, *limit, joint);
}

// URDF 1.2. Infinite: no limit is known.
std::optional<double> UrdfTree::positive_of(const XMLElement& limit, const char* attribute) const {
  if (limit.Attribute(attribute) == nullptr) return std::nullopt;
  const double value = number_of(limit, attribute, 0.0, Infinity::kAllowed);
  if (!(value > 0.0))
    fail(limit.GetLineNum(), "<limit> has " + std::string(attribute) + "=\"" + limit.Attribute(attribute) +
                                 "\"; it must be above 0");
  return std::isinf(value) ? std::nullopt : std::optional(value);
}

void UrdfTree::read_range(const XMLElement& element, const XMLElement& limit, UrdfJoint& joint) const {
  const std::string called = "joint \"" + joint.name + "\"";
  joint.min = number_of(limit, "lower", 0.0, Infinity::kAllowed);
  joint.max = number_of(limit, "upper", 0.0, Infinity::kAllowed);
  if (!(joint.min < joint.max))
    fail(limit.GetLineNum(), called + " has the limits " + format_number(joint.min) + " to " +
                                 format_number(joint.max) + "; lower must be below upper");
  if (const XMLElement* safety = element.FirstChildElement("safety_controller")) {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    joint.min = std::max(joint.min, number_of(*safety, "soft_lower_limit", -kNone, Infinity::kAllowed));
    joint.max = std::min(joint.max, number_of(*safety, "soft_upper_limit", kNone, Infinity::kAllowed));
    if (!(joint.min < joint.max))
      fail(safety->GetLineNum(),
           called + " can move from " + format_number(joint.min) + " to " + format_number(joint.max) +
               " with its soft limits; soft_lower_limit must be below soft_upper_limit");
  }
  if (joint.kind == UrdfJoint::Kind::kPrismatic && (std::isinf(joint.min) || std::isinf(joint.max)))
    fail(limit.GetLineNum(),
         called + " slides without a limit; give lower=\"...\" upper=\"...\" in its <limit>, in m");
}

}  // namespace longreach
