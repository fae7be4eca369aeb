#pragma once
// The links and joints of a URDF, and the joints of the arm between two of its links.

#include <tinyxml2.h>

#include <map>
#include <string>
#include <vector>

#include "common/spatial/spatial.hpp"

namespace longreach {

struct UrdfJoint {
  enum class Kind { kFixed, kRevolute, kContinuous, kPrismatic };

  std::string name;
  Kind kind = Kind::kFixed;
  int line = 0;
  Pose X_PJ{};  // the joint in the frame of its parent link; with it at zero, that of its child link
  Vector3 axis = Vector3::UnitX();  // unit, in its own frame
  double min = 0.0, max = 0.0;      // rad or m; of a continuous joint unbounded
  double speed_max = 0.0;           // rad/s or m/s
};

class UrdfTree {
 public:
  /// Throws ConfigError "NAME:LINE: ...", as all here.
  UrdfTree(std::string name, const std::string& text);

  struct Arm {
    std::string base_link, tip_link;
    std::vector<UrdfJoint> joints;  // base to tip, fixed ones too
  };
  /// Between two links; an empty name: the root; the only end with `moving` joints before it that move.
  [[nodiscard]] Arm arm(const std::string& base_link, const std::string& tip_link, int moving) const;

  [[nodiscard]] const std::string& robot_name() const { return robot_name_; }

 private:
  /// Of a joint: what the shape of the tree takes.
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
  [[nodiscard]] double number_of(const tinyxml2::XMLElement& element, const char* attribute,
                                 double absent) const;
  [[nodiscard]] Vector3 vector_of(const tinyxml2::XMLElement& element, const char* attribute,
                                  const Vector3& absent) const;
  [[nodiscard]] std::vector<double> numbers_of(const tinyxml2::XMLElement& element,
                                               const char* attribute) const;
  [[nodiscard]] UrdfJoint joint_of(const Edge& edge) const;
  void read_limits(const tinyxml2::XMLElement& element, UrdfJoint& joint) const;
  [[nodiscard]] std::string root() const;
  [[nodiscard]] std::vector<const Edge*> chain(const std::string& base, const std::string& tip) const;
  [[nodiscard]] std::string only_end(const std::string& base, int moving) const;
  void require_link(const char* field, const std::string& link) const;

  std::string name_;
  tinyxml2::XMLDocument document_;
  std::string robot_name_;
  std::map<std::string, int> links_;     // and their lines
  std::map<std::string, Edge> edge_to_;  // by the child link
};

}  // namespace longreach
