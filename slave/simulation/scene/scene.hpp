#pragma once
// Surfaces that the tool can touch: solids of Hunt-Crossley material (hunt_crossley.hpp). The tool is a
// sphere about E, or the point E.
//   depth p = radius - distance of E from the solid,   v = ṗ,   F = max(0, k pⁿ (1 + a v)) outwards,
//   k = stiffness / reference_depth^(n-1)
// The forces of separate bodies are added. Of the surfaces of one body only the deepest acts, so a union has
// no internal force. A hinge resists rotation: with the rotation θ of the tool about its axis since the
// start,
//   p = arm (θ - angle),   M = -F arm ∂θ
// There is no friction. The motion of the tool is given. A tree of bounds finds finite bodies at rest.

#include <vector>

#include "schema/config_scene.hpp"
#include "slave/simulation/scene/bounds_tree.hpp"
#include "slave/simulation/scene/hunt_crossley.hpp"
#include "slave/simulation/scene/shape.hpp"

namespace longreach {

struct ToolMotion {
  Vector3 p_WE = Vector3::Zero();            // m
  Vector3 v_WE = Vector3::Zero();            // m/s
  Quaternion q_WE = Quaternion::Identity();  // orientation of E in W
  Vector3 w_WE = Vector3::Zero();            // rad/s, in W
  double t_s = 0.0;                          // time since the start, for moving surfaces
};

struct SceneContact {
  Vector3 force_n = Vector3::Zero();    // force of the scene on the tool at E, in W
  Vector3 moment_nm = Vector3::Zero();  // moment of the scene on the tool about E, in W
  /// Unit vector pointing out of the deepest surface; zero for a hinge and if there is no contact.
  Vector3 normal = Vector3::Zero();
  double depth_m = 0.0;  // maximum penetration; 0 if there is no contact
  int surface = -1;      // index of the deepest surface; -1 if there is no contact
  int contacts = 0;      // number of bodies and hinges in contact
  int asked = 0;         // number of surfaces whose distance was computed
};

struct SceneMean {
  /// [moment; force] on the tool, as above.
  Vector6 wrench = Vector6::Zero();
  /// Approximately -∂wrench/∂move.
  Eigen::Matrix<double, 6, 6> stiffness = Eigen::Matrix<double, 6, 6>::Zero();
};

class Scene {
 public:
  /// Throws std::invalid_argument if a surface names an unknown material or has no shape, or if a direction
  /// or the path (path.hpp) is invalid.
  Scene(const SceneConfig& config, const Pose& X_WE_start);

  [[nodiscard]] bool empty() const { return bodies_.empty() && hinges_.empty(); }
  [[nodiscard]] SceneContact contact(const ToolMotion& tool) const;

  /// Returns the mean contact over the move from the pose of `from` to that of `to`; their velocities are not
  /// used. `dt` > 0, s. The work of the mean wrench equals the energy that the contacts store or dissipate:
  /// the mean elastic force (hunt_crossley.hpp) times (1 + a Δp/dt) acts along a direction for which
  /// F·move = -F Δp (discrete gradient, Gonzalez 1996). Therefore no move creates energy.
  [[nodiscard]] SceneMean mean_contact(const ToolMotion& from, const ToolMotion& to, double dt) const;

  /// Returns the static stiffness F/p of a surface at `depth_m` > 0, N/m; 0 for an invalid index.
  [[nodiscard]] double secant_n_per_m(int surface, double depth_m) const;

 private:
  struct Part {
    Shape shape;
    MovementConfig movement;
    bool moves;
    int surface;
  };
  struct Body {
    HuntCrossley law;
    std::vector<Part> parts;
  };
  struct Hinge {
    HuntCrossley law;
    Vector3 axis;
    double angle_rad, arm_m;
    int surface;
  };
  void plant_tree();
  // The nearest point of a body, or of the stop of a hinge.
  struct Nearest {
    double depth_m;  // negative: no contact
    /// Gradient of the depth with respect to position (body) or rotation (hinge).
    Vector3 gradient;
    Vector3 by_m;       // displacement of the surface
    Vector3 v_m_per_s;  // velocity of the surface
    int surface;
  };
  [[nodiscard]] Nearest nearest(const Body& body, const ToolMotion& tool) const;
  [[nodiscard]] Nearest nearest(const Hinge& hinge, const ToolMotion& tool) const;
  template <class Visit>
  void near(const Vector3& p, double reach_m, Visit&& visit) const;

  double tool_radius_m_;
  Quaternion q_start_;
  std::vector<Body> bodies_;
  std::vector<Hinge> hinges_;
  std::vector<HuntCrossley> laws_;      // contact law of each surface
  std::vector<std::uint32_t> always_;   // indices of infinite or moving bodies
  std::vector<std::uint32_t> in_tree_;  // indices of the other bodies, in the order of the tree
  BoundsTree tree_;
};

}  // namespace longreach
