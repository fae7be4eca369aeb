#pragma once
// Bodies of an MJCF file and the contacts between their geoms. MuJoCo reads the file, computes mass and
// inertia, and finds contacts. Its solver and integrator are not used; bodies.hpp computes forces and motion.
// The MuJoCo library is loaded when the first model is created.
//   bodies with a free joint     float freely; the one named `tool` moves with the tool instead
//   other bodies                 are fixed in the world; joints of other kinds are refused
//   a geom's MJCF `material`     names a material of the scene; geoms without contact need none
// If a pair of geoms has several contacts, only the deepest counts. A mesh collides as its convex hull.

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "schema/config_scene.hpp"
#include "slave/simulation/scene/interaction.hpp"

namespace longreach {

/// A pair of geoms. Bodies are numbered: free bodies from 0, then the tool, then the world.
struct GeomPair {
  int geom_a = 0, geom_b = 0;  // geom_a < geom_b
  int body_a = 0, body_b = 0;
  SurfacePair surface_pair{};  // its normal points from A to B
};

struct FreeBody {
  std::string name;
  RigidMass mass{};
  Pose X_start{};  // pose of the inertial frame at the start
  Pose X_BI{};     // pose of the inertial frame in the frame of the body in the file
};

class CollisionModel {
 public:
  /// Distance within which pairs of geoms are found.
  static constexpr double kNearM = 0.01;
  static constexpr int kBodiesMax = 4;
  /// Maximum number of pairs of geoms that may touch; each needs 20 kB.
  static constexpr int kPairsMax = 10000;

  /// Throws std::invalid_argument "FILE:LINE: reason" if the file is unsuitable or MuJoCo is not installed.
  explicit CollisionModel(const SceneConfig& scene);
  ~CollisionModel();
  CollisionModel(CollisionModel&&) noexcept;

  [[nodiscard]] const std::vector<FreeBody>& bodies() const { return bodies_; }
  [[nodiscard]] int tool() const { return static_cast<int>(bodies_.size()); }
  [[nodiscard]] int world() const { return tool() + 1; }

  /// Returns the pairs of geoms that are near each other when the bodies are at X (inertial frames) and the
  /// tool is at X_tool. The pairs are ordered by their geoms and remain valid until the next call.
  std::span<const GeomPair> near(std::span<const Pose> X, const Pose& X_tool);

  /// Returns the contact law of a pair of geoms: that of the softer material.
  [[nodiscard]] const HuntCrossley& law(const GeomPair& pair) const;

  struct Site {
    int body;
    Pose X_B;  // pose in the inertial frame of the body
  };
  /// These functions find a site or a geom by name. They throw std::invalid_argument if the name is unknown.
  [[nodiscard]] Site site(const std::string& name) const;
  [[nodiscard]] int geom(const std::string& name) const;
  [[nodiscard]] int body_of(int geom) const { return body_of_geom_[static_cast<std::size_t>(geom)]; }
  [[nodiscard]] Pose geom_pose(int geom) const;  // pose at the last call of near()
  /// Radius of a free body or of the tool, about the frame that is passed to near().
  [[nodiscard]] double reach_m(int body) const { return reach_m_[static_cast<std::size_t>(body)]; }

  /// Returns whether the MuJoCo library is loaded in this process.
  static bool loaded();

 private:
  struct Engine;
  void take_bodies();
  void take_laws(const SceneConfig& scene);

  std::string file_;
  std::unique_ptr<Engine> engine_;
  std::vector<FreeBody> bodies_;
  std::vector<int> body_of_geom_;
  std::vector<HuntCrossley> laws_;  // contact law of each geom
  std::vector<double> stiffness_;   // stiffness of each geom at the reference depth
  std::vector<double> reach_m_;
  std::vector<GeomPair> pairs_;
};

}  // namespace longreach
