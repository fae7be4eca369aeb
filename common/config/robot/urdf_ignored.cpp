// What a URDF says about the motion of an arm and what is not supported.

#include <algorithm>
#include <array>
#include <string_view>

#include "common/config/robot/urdf_tree.hpp"
#include "common/text/utf8.hpp"

namespace longreach {
namespace {

using tinyxml2::XMLElement;

/// An attribute ("limit.effort") or an element ("dynamics") of a joint; with a reason, if it is known.
struct Kind {
  std::string_view name, reason;
};

constexpr std::array<std::string_view, 17> kRead{"joint.name",
                                                 "joint.type",
                                                 "origin.xyz",
                                                 "origin.rpy",
                                                 "origin.quat_xyzw",
                                                 "parent.link",
                                                 "child.link",
                                                 "axis.xyz",
                                                 "limit.velocity",
                                                 "limit.acceleration",
                                                 "limit.deceleration",
                                                 "limit.jerk",
                                                 "safety_controller.soft_lower_limit",
                                                 "safety_controller.soft_upper_limit",
                                                 "limit.lower",
                                                 "limit.upper",
                                                 "mimic"};

constexpr std::array kKnown{
    Kind{"limit.effort", "longreach limits motion, not the torque of joints"},
    Kind{"dynamics", "use damping_nm_s_per_rad and friction_nm of the joints in robot"},
    Kind{"calibration", "the robot's controller finds its reference positions"},
    Kind{"safety_controller.k_position", "the soft limits are hard limits here"},
    Kind{"safety_controller.k_velocity", "the soft limits are hard limits here"},
    Kind{"transmission", "joint positions are those of the joints, not of the motors"},
    Kind{"gazebo", "it is for another simulator"},
    Kind{"mujoco", "it is for another simulator"},
    Kind{"ros2_control", "its limits are not used; set them in robot"},
};

/// Counts each kind and keeps its first line.
class Counts {
 public:
  void add(const std::string& name, int line) {
    const auto found = std::ranges::find(counts_, name, &Count::name);
    if (found == counts_.end()) {
      counts_.push_back({name, 1, line});
    } else {
      ++found->number;
    }
  }
  [[nodiscard]] std::vector<std::string> sentences(const std::string& file) const {
    std::vector<std::string> out;
    for (const Count& count : counts_) {
      const auto known = std::ranges::find(kKnown, count.name, &Kind::name);
      const auto point = count.name.find('.');
      const std::string what = point == std::string::npos ? "<" + count.name + ">"
                                                          : count.name.substr(point + 1) + " of <" +
                                                                count.name.substr(0, point) + ">";
      const std::string times = count.number == 1 ? "" : " (" + std::to_string(count.number) + " times)";
      const std::string reason =
          known == kKnown.end() ? "it is not part of URDF 1.0 to 1.2" : std::string(known->reason);
      out.push_back(
          printable(file + ":" + std::to_string(count.line) + ": ignored: " + what + times + "; " + reason));
    }
    return out;
  }

 private:
  struct Count {
    std::string name;
    int number = 0, line = 0;
  };
  std::vector<Count> counts_;
};

bool is_read(const std::string& name) { return std::ranges::find(kRead, name) != kRead.end(); }

bool is_known_element(const std::string& name) {
  return std::ranges::any_of(kRead, [&](std::string_view read) { return read.starts_with(name + "."); });
}

void add_attributes(const XMLElement& element, Counts& counts) {
  for (const tinyxml2::XMLAttribute* a = element.FirstAttribute(); a != nullptr; a = a->Next()) {
    const std::string name = std::string(element.Name()) + "." + a->Name();
    if (!is_read(name)) counts.add(name, a->GetLineNum());
  }
}

void add_joint(const XMLElement& joint, Counts& counts) {
  add_attributes(joint, counts);
  for (const XMLElement* e = joint.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
    const std::string name = e->Name();
    if (is_known_element(name)) {
      add_attributes(*e, counts);
    } else if (!is_read(name)) {
      counts.add(name, e->GetLineNum());
    }
  }
  // A continuous joint has no range.
  const XMLElement* limit = joint.FirstChildElement("limit");
  if (limit == nullptr || std::string_view(joint.Attribute("type")) != "continuous") return;
  for (const char* bound : {"lower", "upper"})
    if (limit->DoubleAttribute(bound) != 0.0)
      counts.add("limit of a continuous joint." + std::string(bound), limit->GetLineNum());
}

}  // namespace

std::vector<std::string> UrdfTree::ignored(const std::vector<const Edge*>& chain) const {
  Counts counts;
  for (const Edge* edge : chain) add_joint(*edge->element, counts);
  const XMLElement& robot = *document_.RootElement();
  for (const XMLElement* e = robot.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
    const std::string name = e->Name();
    if (name != "link" && name != "joint" && name != "material") counts.add(name, e->GetLineNum());
  }
  return counts.sentences(name_);
}

}  // namespace longreach
