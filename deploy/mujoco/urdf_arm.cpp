#include "deploy/mujoco/urdf_arm.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <stdexcept>
#include <string_view>

#include "common/config/config.hpp"
#include "common/config/robot/robot_file.hpp"
#include "common/text/utf8.hpp"
#include "deploy/mujoco/mjcf_text.hpp"

namespace longreach {
namespace {

namespace fs = std::filesystem;
using tinyxml2::XMLElement;

constexpr double kTimeStep_s = 5e-4;  // divides 1 ms

/// A file in memory that MuJoCo can write.
class MemoryFile {
 public:
  MemoryFile() : fd_(::memfd_create("mjcf", MFD_CLOEXEC)) {}
  ~MemoryFile() { ::close(fd_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(fd_); }
  [[nodiscard]] std::string text() const {
    std::ifstream file(path());
    return {std::istreambuf_iterator<char>(file), {}};
  }

 private:
  int fd_;
};

XMLElement& child(XMLElement& parent, const char* name) {
  if (auto* found = parent.FirstChildElement(name)) return *found;
  return *parent.InsertNewChildElement(name);
}

/// Calls `use` for each element named `name` below `parent`. `use` may remove the element.
template <class Use>
void for_each(XMLElement& parent, const char* name, const Use& use) {
  for (auto* one = parent.FirstChildElement(name); one != nullptr;) {
    auto* const next = one->NextSiblingElement(name);
    use(*one);
    one = next;
  }
}

/// The file of a mesh; empty if there is none that MuJoCo reads. The folder of a package is looked for in the folders
/// above the URDF.
fs::path mesh_file(const fs::path& urdf, const std::string& named) {
  const auto readable = [](const fs::path& path) {
    const std::string extension = lower_case(path.extension().string());
    return (extension == ".stl" || extension == ".obj") && fs::is_regular_file(path);
  };
  constexpr std::string_view kPackage = "package://", kFile = "file://";
  const fs::path folder = fs::absolute(urdf).parent_path();
  if (!named.starts_with(kPackage)) {
    const fs::path path = folder / (named.starts_with(kFile) ? named.substr(kFile.size()) : named);
    return readable(path) ? path : fs::path();
  }
  const std::string in_package = named.substr(kPackage.size());
  for (fs::path above = folder; above != above.root_path(); above = above.parent_path())
    if (readable(above.parent_path() / in_package)) return above.parent_path() / in_package;
  return {};
}

/// Removes the shapes that are not simulated. Returns the number of meshes among those of <collision>.
int keep_readable_shapes(const fs::path& file, XMLElement& link) {
  int left_out = 0;
  for_each(link, "visual", [&](XMLElement& visual) { link.DeleteChild(&visual); });
  for_each(link, "collision", [&](XMLElement& collision) {
    auto* geometry = collision.FirstChildElement("geometry");
    auto* mesh = geometry != nullptr ? geometry->FirstChildElement("mesh") : nullptr;
    if (mesh == nullptr) return;
    const char* named = mesh->Attribute("filename");
    const fs::path path = mesh_file(file, named != nullptr ? named : "");
    if (path.empty()) {
      link.DeleteChild(&collision);
      ++left_out;
    } else {
      mesh->SetAttribute("filename", path.c_str());
    }
  });
  return left_out;
}

/// Fixes the joints that are not those of the arm. Returns their names.
std::string fix_other_joints(XMLElement& robot, const proto::Robot& arm) {
  std::string names;
  for_each(robot, "joint", [&](XMLElement& joint) {
    const std::string name = joint.Attribute("name");
    const bool moves = std::ranges::any_of(arm.joint(), [&](const auto& one) { return one.name() == name; });
    if (moves || joint.Attribute("type", "fixed") != nullptr) return;
    joint.SetAttribute("type", "fixed");
    names += (names.empty() ? "" : ", ") + name;
  });
  return names;
}

void set_compiler(XMLElement& robot) {
  XMLElement& compiler = child(child(robot, "mujoco"), "compiler");
  compiler.SetAttribute("fusestatic", "false");
  compiler.SetAttribute("strippath", "false");
  compiler.DeleteAttribute("meshdir");
  // The inertias of many files are estimates that no body can have.
  compiler.SetAttribute("balanceinertia", "true");
}

XMLElement* body_named(XMLElement& parent, const std::string& name) {
  for (auto* body = parent.FirstChildElement("body"); body != nullptr;
       body = body->NextSiblingElement("body")) {
    if (body->Attribute("name", name.c_str()) != nullptr) return body;
    if (auto* below = body_named(*body, name)) return below;
  }
  return nullptr;
}

/// Writes poses and axes with all their digits.
void make_exact(XMLElement& parent, const mjModel& exact) {
  for_each(parent, "body", [&](XMLElement& body) {
    const int b = mj_name2id(&exact, mjOBJ_BODY, body.Attribute("name"));
    body.SetAttribute("pos", list_of(std::span(exact.body_pos + 3 * b, 3)).c_str());
    body.SetAttribute("quat", list_of(std::span(exact.body_quat + 4 * b, 4)).c_str());
    for_each(body, "joint", [&](XMLElement& joint) {
      const int j = mj_name2id(&exact, mjOBJ_JOINT, joint.Attribute("name"));
      joint.SetAttribute("pos", list_of(std::span(exact.jnt_pos + 3 * j, 3)).c_str());
      joint.SetAttribute("axis", list_of(std::span(exact.jnt_axis + 3 * j, 3)).c_str());
    });
    make_exact(body, exact);
  });
}

void set_ranges(XMLElement& parent, const proto::Robot& robot) {
  for_each(parent, "body", [&](XMLElement& body) {
    for_each(body, "joint", [&](XMLElement& joint) {
      const auto of_arm = std::ranges::find_if(robot.joint(), [&](const auto& one) {
        return joint.Attribute("name", one.name().c_str()) != nullptr;
      });
      joint.SetAttribute("limited", "true");
      joint.SetAttribute("range",
                         (format_number(of_arm->min_rad()) + " " + format_number(of_arm->max_rad())).c_str());
    });
    set_ranges(body, robot);
  });
}

/// The body of the tool link, or a new body in it with all that it carries, if a joint moves it.
XMLElement& body_for_sensors(XMLElement& tool) {
  if (tool.FirstChildElement("joint") == nullptr) return tool;
  XMLElement& carried = *tool.InsertNewChildElement("body");
  for (const char* kind : {"inertial", "geom", "body"})
    for_each(tool, kind, [&](XMLElement& one) {
      if (&one != &carried) carried.InsertEndChild(&one);
    });
  return carried;
}

bool has_shape(const XMLElement& body) {
  if (body.FirstChildElement("geom") != nullptr) return true;
  for (auto* one = body.FirstChildElement("body"); one != nullptr; one = one->NextSiblingElement("body"))
    if (has_shape(*one)) return true;
  return false;
}

/// The first key frame: the joints are in the order in which the bodies carry each other, as in the description.
void set_start(XMLElement& root, const proto::Robot& robot) {
  std::string start;
  for (const proto::Joint& joint : robot.joint())
    start += (start.empty() ? "" : " ") + format_number(joint.start_rad());
  XMLElement& key = *root.InsertNewChildElement("keyframe")->InsertNewChildElement("key");
  key.SetAttribute("name", "start");
  key.SetAttribute("qpos", start.c_str());
}

}  // namespace

bool holds_urdf(const std::string& file) {
  tinyxml2::XMLDocument document;
  document.LoadFile(file.c_str());
  return document.RootElement() != nullptr && std::string_view(document.RootElement()->Name()) == "robot";
}

UrdfArm urdf_arm(const std::string& file, const std::string& tool_link) {
  UrdfArm arm;
  proto::Robot wanted;
  if (!tool_link.empty()) wanted.set_tip_link(tool_link);
  try {
    arm.robot = read_robot_file(file, wanted).robot;
  } catch (const ConfigError& problem) {
    throw std::invalid_argument(problem.what());
  }
  tinyxml2::XMLDocument document;
  document.LoadFile(file.c_str());
  XMLElement& robot = *document.RootElement();  // read_robot_file() has read it
  int meshes = 0;
  for_each(robot, "link", [&](XMLElement& link) { meshes += keep_readable_shapes(file, link); });
  if (meshes > 0)
    arm.notes.push_back(file + ": meshes of collisions that are not simulated: " + std::to_string(meshes) +
                        "; MuJoCo reads STL and OBJ files, and these are of another kind or not found");
  if (const std::string names = fix_other_joints(robot, arm.robot); !names.empty())
    arm.notes.push_back(file + ": joints that are not between the root and " + arm.robot.tip_link() +
                        " are fixed at zero: " + names);
  set_compiler(robot);
  arm.text = text_of(document);
  return arm;
}

std::string last_mjcf(const std::string& file, const mjModel& model) {
  const MemoryFile written;
  std::array<char, 1000> error{};
  if (mj_saveLastXML(written.path().c_str(), &model, error.data(), static_cast<int>(error.size())) == 0)
    throw std::invalid_argument(file + ": MuJoCo cannot write it as MJCF: " + error.data());
  return written.text();
}

std::string with_sensors(const std::string& mjcf, const mjModel& exact, const UrdfArm& arm,
                         const std::string& site, std::vector<std::string>& notes) {
  tinyxml2::XMLDocument document;
  document.Parse(mjcf.c_str());
  XMLElement& root = *document.RootElement();
  XMLElement& option = child(root, "option");
  if (option.Attribute("timestep") == nullptr)
    option.SetAttribute("timestep", format_number(kTimeStep_s).c_str());
  XMLElement& world = child(root, "worldbody");
  make_exact(world, exact);
  set_ranges(world, arm.robot);
  XMLElement& tool = body_for_sensors(*body_named(world, arm.robot.tip_link()));
  if (!has_shape(tool))
    notes.push_back("the tool link " + arm.robot.tip_link() +
                    " carries no shape for collisions, so the sensors there measure no contact");
  tool.InsertNewChildElement("site")->SetAttribute("name", site.c_str());
  XMLElement& sensor = child(root, "sensor");
  for (const char* kind : {"force", "torque"})
    sensor.InsertNewChildElement(kind)->SetAttribute("site", site.c_str());
  set_start(root, arm.robot);
  return text_of(document);
}

}  // namespace longreach
