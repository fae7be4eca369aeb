// Fields that must agree with each other: all such rules of the configuration live here, one function a
// message.

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <vector>

#include "common/config/adapter_address.hpp"
#include "common/config/guarded.hpp"
#include "common/config/host_and_port.hpp"
#include "common/config/robot_rules.hpp"
#include "common/config/rule.hpp"
#include "common/text/number_text.hpp"
#include "proto/config.pb.h"

namespace longreach {
namespace {

using google::protobuf::FieldDescriptor;

// A text that is an address by its form. Empty is what the default says: none, or one that is known.
Finding is_address(const Message& message, const char* field, const std::string& text) {
  if (host_and_port(text)) return std::nullopt;
  const auto* descriptor = message.GetDescriptor()->FindFieldByName(field);
  if (text.empty() && descriptor->default_value_string().empty()) return std::nullopt;
  return at(message, field, " = \"" + text + "\"" + kNoAddress);
}

Finding check_adapter(const proto::Adapter& adapter) {
  const std::string why = adapter.address().empty() ? "" : adapter_address_trouble(adapter.address());
  return why.empty() ? Finding{} : at(adapter, "address", " = " + adapter.address() + why);
}

// Three numbers that say where to: long enough to be divided by their length, short enough to be squared.
Finding is_direction(const Message& message, const char* field,
                     const google::protobuf::RepeatedField<double>& numbers) {
  if (numbers.size() != 3) return std::nullopt;  // absent, or the count is at fault
  const double length = std::hypot(numbers.Get(0), numbers.Get(1), numbers.Get(2));
  if (length >= 1e-9 && length <= 1e9) return std::nullopt;
  return at(message, field,
            " has length " + format_number(length) +
                ", which is outside the range 1e-9 to 1e9, so it does not define a direction");
}

// A rotation vector; one of more than a whole turn is meant in degrees.
Finding is_rotation(const Message& message, const google::protobuf::RepeatedField<double>& numbers) {
  const double square = std::inner_product(numbers.begin(), numbers.end(), numbers.begin(), 0.0);
  if (square <= 6.3 * 6.3) return std::nullopt;
  return at(message, "rotation_rad",
            " has length " + format_number(std::sqrt(square)) +
                ", which is more than one turn; the unit is rad, but this value seems to be in degrees");
}

// Names that a path can address: "material.wall.exponent".
template <class List>
Finding check_names(const Message& parent, const char* list, const List& elements) {
  std::set<std::string> seen;
  for (int i = 0; i < elements.size(); ++i) {
    const std::string& name = elements.Get(i).name();
    if (name.empty())
      return at_element(parent, list, i, "name", " is empty; every " + std::string(list) + " needs a name");
    if (name.find_first_of(".=") != std::string::npos ||
        name.find_first_not_of("0123456789") == std::string::npos) {
      return at_element(
          parent, list, i, "name",
          " = \"" + name +
              "\" cannot be used in a path; a name needs at least one letter and must not contain "
              "\".\" or \"=\"");
    }
    if (!seen.insert(name).second) {
      return at_element(parent, list, i, "name",
                        " = \"" + name + "\" is already the name of another " + list);
    }
  }
  return std::nullopt;
}

// Exactly one shape, or a violation at the surface or at the second one.
Finding check_shape(const proto::Surface& surface) {
  const FieldDescriptor* first = nullptr;
  std::vector<const FieldDescriptor*> fields;
  surface.GetReflection()->ListFields(surface, &fields);
  for (const FieldDescriptor* field : fields) {
    if (!holds_messages(*field) || field->message_type() == proto::Movement::descriptor()) continue;
    if (first) {
      return Violation{
          {{field, -1}},
          " cannot be combined with " + std::string(first->name()) + "; a surface has only one shape"};
    }
    first = field;
  }
  if (first) return std::nullopt;
  return Violation{{}, " has no shape; give it a plane, sphere, box, cylinder or hinge"};
}

Finding check_surfaces(const proto::Scene& scene) {
  Names known;
  std::map<std::string, std::string> material_of_body;
  for (const proto::Material& material : scene.material()) known.push_back(material.name());
  for (int i = 0; i < scene.surface_size(); ++i) {
    const proto::Surface& surface = scene.surface(i);
    const std::string& wanted = surface.material();
    if (std::ranges::find(known, wanted) == known.end()) {
      return at_element(
          scene, "surface", i, "material",
          " = \"" + wanted + "\" is not a material of the scene" + instead_of(wanted, known, "it has"));
    }
    if (surface.body().empty()) continue;
    const auto [body, first] = material_of_body.try_emplace(surface.body(), wanted);
    if (!first && body->second != wanted) {
      return at_element(scene, "surface", i, "material",
                        " = \"" + wanted + "\" differs from the material \"" + body->second +
                            "\" of the body \"" + surface.body() + "\"; a body has only one material");
    }
  }
  return std::nullopt;
}

Finding check_path(const proto::Path& path) {
  if (path.waypoint_size() >= 2) return std::nullopt;
  return at(path, "waypoint",
            " has " + std::to_string(path.waypoint_size()) + " elements; a path needs at least two");
}

Finding check_scene(const proto::Scene& scene) {
  if (auto finding = check_names(scene, "material", scene.material())) return finding;
  if (auto finding = check_names(scene, "surface", scene.surface())) return finding;
  return check_surfaces(scene);
}

Finding check_mapping(const proto::Mapping& mapping) {
  if (auto finding = in_order(mapping, {"dead_zone_m", mapping.dead_zone_m()},
                              {"radius_max_m", mapping.radius_max_m()})) {
    return finding;
  }
  return in_order(mapping, {"dead_zone_rad", mapping.dead_zone_rad()},
                  {"radius_max_rad", mapping.radius_max_rad()});
}

Finding check_touch(const proto::Sensing& sensing) {
  if (sensing.touch_n() > 0.0)
    return in_order(sensing, {"release_n", sensing.release_n()}, {"touch_n", sensing.touch_n()});
  if (sensing.release_n() == proto::Sensing::default_instance().release_n()) return std::nullopt;
  return at(
      sensing, "release_n",
      " = " + format_number(sensing.release_n()) +
          " has no effect while touch_n is 0, because both thresholds are then derived from the sensor; "
          "set touch_n, too");
}

Finding check_safety(const proto::SlaveSafety& safety) {
  constexpr double kLeast_s = 0.02;
  if (safety.gap_s() == 0.0 || safety.gap_s() >= kLeast_s) return std::nullopt;
  return at(safety, "gap_s",
            " = " + format_number(safety.gap_s()) +
                " is neither 0 (derived from the master's send rate) nor between 0.02 and 2");
}

// Fewer than 50 commands a second are too few for any gap timer.
template <class Link>
Finding check_budget(const Link& link) {
  constexpr double kLeast_kbit_per_s = 52.0;
  const double budget = link.budget_kbit_per_s();
  if (budget == 0.0 || budget >= kLeast_kbit_per_s) return std::nullopt;
  return at(link, "budget_kbit_per_s",
            " = " + format_number(budget) + " is neither 0 (no limit) nor at least " +
                format_number(kLeast_kbit_per_s));
}

Finding check_link(const proto::MasterLink& link) {
  if (auto wrong = is_address(link, "slave", link.slave())) return wrong;
  if (auto wrong = is_address(link, "listen", link.listen())) return wrong;
  if (auto wrong = is_address(link, "slave_rpc", link.slave_rpc())) return wrong;
  return check_budget(link);
}

Finding check_link(const proto::SlaveLink& link) {
  if (auto wrong = is_address(link, "listen", link.listen())) return wrong;
  return check_budget(link);
}

Finding within(const PathStep& step, Finding finding) {
  if (finding) finding->path.insert(finding->path.begin(), step);
  return finding;
}

// A force that the sensor cannot measure, or that is passed before it is noticed, is not guarded.
Finding check_guarded(const proto::SlaveConfig& config) {
  const PathStep sensing{config.GetDescriptor()->FindFieldByName("sensing"), -1};
  if (const std::string why = unmeasured_force(config); !why.empty())
    return within(sensing, at(config.sensing(), "force_range_n", why));
  if (const std::string why = unmeasured_moment(config); !why.empty())
    return within(sensing, at(config.sensing(), "moment_range_nm", why));
  const PathStep section{config.GetDescriptor()->FindFieldByName("command"), -1};
  const double hold_n = config.command().hold_force_n();
  if (hold_n > 0.0 && hold_n <= guarded_touch_n(config.sensing())) {
    return within(section, at(config.command(), "hold_force_n",
                              " = " + format_number(hold_n) + " is not above " +
                                  touch_text(config.sensing()) + ": a hold would lose the contact"));
  }
  if (const std::string why = too_soft(config); !why.empty())
    return within(section, at(config.command(), "guard_stiffness_n_per_m", why));
  if (const std::string why = unguarded(config); !why.empty())
    return within(section, at(config.command(), "force_guard_n", why));
  if (const std::string why = unguarded_moment(config); !why.empty())
    return within(section, at(config.command(), "moment_guard_nm", why));
  return std::nullopt;
}

// The laboratory is virtual time, which nothing real keeps.
Finding check_laboratory(const proto::LabConfig& lab) {
  const char* const why =
      " applies only to longreach-master and longreach-slave; the laboratory simulates devices and robots";
  const auto adapted = [&](const char* side, const Message& config, const char* field,
                           const proto::Adapter& adapter) -> Finding {
    if (adapter.address().empty()) return std::nullopt;
    const PathStep section{config.GetDescriptor()->FindFieldByName(field), -1};
    return within({lab.GetDescriptor()->FindFieldByName(side), -1},
                  within(section, at(adapter, "address", " = " + adapter.address() + why)));
  };
  if (auto finding = adapted("master", lab.master(), "device_adapter", lab.master().device_adapter()))
    return finding;
  return adapted("slave", lab.slave(), "robot_adapter", lab.slave().robot_adapter());
}

// The rules of one message, without those of its parts.
Finding check_message(const Message& message) {
  if (const auto* joint = dynamic_cast<const proto::Joint*>(&message)) return check_joint(*joint);
  if (const auto* robot = dynamic_cast<const proto::Robot*>(&message)) return check_robot(*robot);
  if (const auto* placement = dynamic_cast<const proto::Placement*>(&message))
    return is_rotation(*placement, placement->rotation_rad());
  if (const auto* box = dynamic_cast<const proto::Box*>(&message))
    return is_rotation(*box, box->rotation_rad());
  if (const auto* scene = dynamic_cast<const proto::Scene*>(&message)) return check_scene(*scene);
  if (const auto* mapping = dynamic_cast<const proto::Mapping*>(&message)) return check_mapping(*mapping);
  if (const auto* surface = dynamic_cast<const proto::Surface*>(&message)) return check_shape(*surface);
  if (const auto* path = dynamic_cast<const proto::Path*>(&message)) return check_path(*path);
  if (const auto* plane = dynamic_cast<const proto::Plane*>(&message)) {
    return is_direction(*plane, "normal", plane->normal());
  }
  if (const auto* cylinder = dynamic_cast<const proto::Cylinder*>(&message)) {
    return is_direction(*cylinder, "axis", cylinder->axis());
  }
  if (const auto* hinge = dynamic_cast<const proto::Hinge*>(&message)) {
    return is_direction(*hinge, "axis", hinge->axis());
  }
  if (const auto* script = dynamic_cast<const proto::Operator*>(&message)) {
    return is_direction(*script, "direction", script->direction());
  }
  if (const auto* link = dynamic_cast<const proto::MasterLink*>(&message)) return check_link(*link);
  if (const auto* link = dynamic_cast<const proto::SlaveLink*>(&message)) return check_link(*link);
  if (const auto* rpc = dynamic_cast<const proto::RpcServer*>(&message))
    return is_address(*rpc, "listen", rpc->listen());
  if (const auto* adapter = dynamic_cast<const proto::Adapter*>(&message)) return check_adapter(*adapter);
  if (const auto* safety = dynamic_cast<const proto::SlaveSafety*>(&message)) return check_safety(*safety);
  if (const auto* slave = dynamic_cast<const proto::SlaveConfig*>(&message)) return check_guarded(*slave);
  if (const auto* lab = dynamic_cast<const proto::LabConfig*>(&message)) return check_laboratory(*lab);
  if (const auto* sensing = dynamic_cast<const proto::Sensing*>(&message)) {
    if (auto finding = check_touch(*sensing)) return finding;
    return in_order(*sensing, {"release_nm", sensing->release_nm()}, {"touch_nm", sensing->touch_nm()});
  }
  return std::nullopt;
}

// What the laboratory can do and a program cannot: the configuration of a program is a message of its own,
// not part of the laboratory's.
Finding check_program(const Message& message) {
  const auto* master = dynamic_cast<const proto::MasterConfig*>(&message);
  if (!master || master->rendering().law() == proto::Rendering::STIFFNESS) return std::nullopt;
  const PathStep section{master->GetDescriptor()->FindFieldByName("rendering"), -1};
  return within(section, at(master->rendering(), "law",
                            " = " + proto::Rendering::Law_Name(master->rendering().law()) +
                                " is for comparison and available only in longreach-lab; leave it out or "
                                "set STIFFNESS"));
}

Finding find_in_parts(const Message& message) {
  if (auto finding = check_message(message)) return finding;
  std::vector<const FieldDescriptor*> fields;
  message.GetReflection()->ListFields(message, &fields);
  for (const FieldDescriptor* field : fields) {
    if (!holds_messages(*field)) continue;
    const int size = field->is_repeated() ? message.GetReflection()->FieldSize(message, field) : 1;
    for (int i = 0; i < size; ++i) {
      const PathStep step{field, field->is_repeated() ? i : -1};
      if (auto finding = within(step, find_in_parts(message_at(message, step)))) return finding;
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<Violation> find_inconsistency(const Message& message) {
  if (auto finding = check_program(message)) return finding;
  return find_in_parts(message);
}

}  // namespace longreach
