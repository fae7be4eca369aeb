#pragma once
// Parses the links and joints of a URDF and finds the joints of the arm between two links.

#include <tinyxml2.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/spatial/spatial.hpp"

namespace longreach {

struct UrdfJoint {
  enum class Kind { kFixed, kRevolute, kContinuous, kPrismatic };

  std::string name;
  Kind kind = Kind::kFixed;
  int line = 0;
  /// Pose of the joint in the frame of its parent link. With the joint at zero, this is also the pose of the
  /// child link.
  Pose X_PJ{};
  Vector3 axis = Vector3::UnitX();  // unit vector in the frame of the joint
  double min = 0.0, max = 0.0;      // rad or m; unbounded for a continuous joint
  double speed_max = 0.0;           // rad/s or m/s
  // Not in every file: rad/s^2 or m/s^2, the smaller one of acceleration and deceleration; rad/s^3 or m/s^3.
  std::optional<double> acceleration_max{}, jerk_max{};
};

class UrdfTree {
 public:
  /// Like the other functions of this class, throws ConfigError "NAME:LINE: ...".
  UrdfTree(std::string name, const std::string& text);

  struct Arm {
    std::string base_link, tip_link;
    std::vector<UrdfJoint> joints;  // from base to tip, including fixed joints
    /// What the file says about the motion of these joints and is not supported, one sentence for each kind.
    std::vector<std::string> ignored;
  };
  /// Returns the arm between two links. If base_link is empty, the arm starts at the root; if tip_link is
  /// empty, it ends at the only leaf of the tree that has `moving` movable joints above it.
  [[nodiscard]] Arm arm(const std::string& base_link, const std::string& tip_link, int moving) const;

  [[nodiscard]] const std::string& robot_name() const { return robot_name_; }

 private:
  enum class Infinity { kRefused, kAllowed };

  /// The properties of a joint that define the shape of the tree.
  struct Edge {
    const tinyxml2::XMLElement* element = nullptr;
    std::string name, parent, child;
    bool moves = false;
  };

  [[noreturn]] void fail(int line, const std::string& sentence) const;
  void refuse_xacro(const tinyxml2::XMLElement& element) const;
  void read_links(const tinyxml2::XMLElement& robot);
  void read_edges(const tinyxml2::XMLElement& robot);
  [[nodiscard]] std::string text_of(const tinyxml2::XMLElement& element, const char* attribute) const;
  [[nodiscard]] std::string link_of(const tinyxml2::XMLElement& joint, const char* which) const;
  [[nodiscard]] double number_of(const tinyxml2::XMLElement& element, const char* attribute, double absent,
                                 Infinity infinity = Infinity::kRefused) const;
  [[nodiscard]] Vector3 vector_of(const tinyxml2::XMLElement& element, const char* attribute,
                                  const Vector3& absent) const;
  [[nodiscard]] std::vector<double> numbers_of(const tinyxml2::XMLElement& element, const char* attribute,
                                               Infinity infinity = Infinity::kRefused) const;
  [[nodiscard]] Quaternion rotation_of(const tinyxml2::XMLElement& origin) const;
  [[nodiscard]] std::optional<double> positive_of(const tinyxml2::XMLElement& limit,
                                                  const char* attribute) const;
  [[nodiscard]] UrdfJoint joint_of(const Edge& edge) const;
  void refuse_twice(const Edge& edge) const;
  void read_limits(const tinyxml2::XMLElement& element, UrdfJoint& joint) const;
  void read_range(const tinyxml2::XMLElement& element, const tinyxml2::XMLElement& limit,
                  UrdfJoint& joint) const;
  [[nodiscard]] std::vector<std::string> ignored(const std::vector<const Edge*>& chain) const;
  [[nodiscard]] std::string root() const;
  [[nodiscard]] std::vector<const Edge*> chain(const std::string& base, const std::string& tip) const;
  [[nodiscard]] std::string only_end(const std::string& base, int moving) const;
  void require_link(const char* field, const std::string& link) const;

  std::string name_;
  tinyxml2::XMLDocument document_;
  std::string robot_name_;
  std::map<std::string, int> links_;     // name and line of each link
  std::map<std::string, Edge> edge_to_;  // joint above each link, by the link's name
};

}  // namespace longreach
