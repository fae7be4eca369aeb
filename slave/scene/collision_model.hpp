#pragma once
// Bodies of an MJCF file and the contacts of their geoms: MuJoCo reads the file, computes mass and inertia,
// and finds contacts. Its solver and integrator are not used; forces and motion are computed in bodies.hpp.
// MuJoCo's library is loaded with the first model.
//   bodies with a free joint     float freely; that named `tool` moves with the tool instead
//   other bodies                 rest in the world; joints of other kinds are refused
//   a geom's MJCF `material`     names a material of the scene; geoms without contact need none
// Of several contacts of a pair of geoms only the deepest counts. A mesh collides as its convex hull.

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "slave/config/scene_config.hpp"
#include "slave/scene/interaction.hpp"

namespace longreach {

/// Bodies by number: free bodies from 0, then the tool, then the world.
struct GeomPair {
  int geom_a = 0, geom_b = 0;  // geom_a < geom_b
  int body_a = 0, body_b = 0;
  SurfacePair surface_pair{};  // its normal from A to B
};

struct FreeBody {
  std::string name;
  RigidMass mass{};
  Pose X_start{};  // of the inertial frame
};

class CollisionModel {
 public:
  /// Geoms within this distance are found.
  static constexpr double kNearM = 0.01;
  static constexpr int kBodiesMax = 4;
  static constexpr int kPairsMax = 10000;  // of geoms that may touch; 20 kB each

  /// Throws std::invalid_argument "FILE:LINE: reason" for an unsuitable file, or if MuJoCo is not installed.
  explicit CollisionModel(const SceneConfig& scene);
  ~CollisionModel();
  CollisionModel(CollisionModel&&) noexcept;

  [[nodiscard]] const std::vector<FreeBody>& bodies() const { return bodies_; }
  [[nodiscard]] int tool() const { return static_cast<int>(bodies_.size()); }
  [[nodiscard]] int world() const { return tool() + 1; }

  /// Returns pairs of geoms that are near each other with the bodies at X (inertial frames) and the tool at
  /// X_tool, in the order of their geoms; valid until the next call.
  std::span<const GeomPair> near(std::span<const Pose> X, const Pose& X_tool);

  /// Contact law of two geoms: that of the softer material.
  [[nodiscard]] const HuntCrossley& law(const GeomPair& pair) const;

  struct Site {
    int body;
    Pose X_B;  // in the body's inertial frame
  };
  /// Both throw std::invalid_argument for an unknown name.
  [[nodiscard]] Site site(const std::string& name) const;
  [[nodiscard]] int geom(const std::string& name) const;
  [[nodiscard]] int body_of(int geom) const { return body_of_geom_[static_cast<std::size_t>(geom)]; }
  [[nodiscard]] Pose geom_pose(int geom) const;  // at the last near()
  /// Radius of a free body or the tool about the frame that is passed to near().
  [[nodiscard]] double reach_m(int body) const { return reach_m_[static_cast<std::size_t>(body)]; }

  /// Whether MuJoCo's library is loaded in this process.
  static bool loaded();

 private:
  struct Engine;
  void take_bodies();
  void take_laws(const SceneConfig& scene);

  std::string file_;
  std::unique_ptr<Engine> engine_;
  std::vector<FreeBody> bodies_;
  std::vector<int> body_of_geom_;
  std::vector<HuntCrossley> laws_;  // of each geom
  std::vector<double> stiffness_;   // likewise, at the reference depth
  std::vector<double> reach_m_;
  std::vector<GeomPair> pairs_;
};

}  // namespace longreach
