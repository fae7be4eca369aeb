#pragma once
// Random URDF files with six moving joints of all types in rotated and offset frames, fixed joints between
// them, a side branch, inertias, and an element for another program (MuJoCo).

#include <cmath>
#include <string>
#include <vector>

#include "common/core/random.hpp"
#include "common/spatial/spatial.hpp"
#include "common/text/number_text.hpp"

namespace longreach::test {

class RandomUrdf {
 public:
  explicit RandomUrdf(std::uint64_t seed) : random_(seed) {}

  /// Returns the text of a file. The arm extends from the link "base" to the link "tip". If `right_angles` is
  /// true, all frames are rotated by multiples of 90 degrees, as in most real files.
  std::string text(bool right_angles) {
    text_ =
        "<?xml version=\"1.0\"?>\n<robot name=\"drawn\">\n"
        "  <mujoco><compiler fusestatic=\"false\" balanceinertia=\"true\"/></mujoco>\n";
    link("base");
    std::string parent = "base";
    int moving = 0;
    for (int i = 0; moving < 6; ++i) {
      const std::string child = "link_" + std::to_string(i);
      link(child);
      const bool fixed = random_.uniform() < 0.25;
      joint("joint_" + std::to_string(i), fixed ? "fixed" : kind(moving), parent, child, right_angles);
      if (!fixed) ++moving;
      parent = child;
    }
    link("tip");
    joint("mount", "fixed", parent, "tip", right_angles);
    // A side branch on the last moving link.
    link("finger");
    joint("finger_joint", "fixed", parent, "finger", right_angles);
    return text_ + "</robot>\n";
  }

 private:
  double number(double most) { return most * (2.0 * random_.uniform() - 1.0); }
  std::string three(const Vector3& v) {
    return format_number(v.x()) + " " + format_number(v.y()) + " " + format_number(v.z());
  }
  std::string kind(int moving) {
    const double draw = random_.uniform();
    if (slides_ < 2 && draw < 0.25) {
      ++slides_;
      return "prismatic";
    }
    return moving % 2 == 0 || draw < 0.6 ? "revolute" : "continuous";
  }
  void link(const std::string& name) {
    text_ += "  <link name=\"" + name +
             "\"><inertial><mass value=\"1\"/><inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" "
             "izz=\"1\"/></inertial></link>\n";
  }
  Vector3 turn(bool right_angles) {
    if (!right_angles) return {number(3.1), number(1.5), number(3.1)};
    const auto quarter = [&] {
      return std::floor(4.0 * random_.uniform()) * 1.5707963267948966 - 3.141592653589793;
    };
    return {quarter(), 0.0, quarter()};
  }
  void joint(const std::string& name, const std::string& type, const std::string& parent,
             const std::string& child, bool right_angles) {
    const Vector3 p(number(0.5), right_angles ? 0.0 : number(0.5), number(0.5));
    Vector3 axis(number(1.0), number(1.0), number(1.0));
    if (right_angles || !(axis.norm() > 0.1)) axis = Vector3::UnitZ();
    text_ += "  <joint name=\"" + name + "\" type=\"" + type + "\"><parent link=\"" + parent +
             "\"/><child link=\"" + child + "\"/><origin xyz=\"" + three(p) + "\" rpy=\"" +
             three(turn(right_angles)) + "\"/>";
    if (type != "fixed") text_ += "<axis xyz=\"" + three(axis) + "\"/>";
    if (type == "revolute" || type == "prismatic")
      text_ += "<limit lower=\"-2\" upper=\"2\" velocity=\"1\" effort=\"1\"/>";
    if (type == "continuous") text_ += "<limit velocity=\"1\" effort=\"1\"/>";
    text_ += "</joint>\n";
  }

  Random random_;
  std::string text_;
  int slides_ = 0;
};

}  // namespace longreach::test
