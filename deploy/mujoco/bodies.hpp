#pragma once
// Free bodies of a scene of longreach (`bodies` in a scene file) in a MuJoCo world: the laboratory puts them in front of a
// robot that MuJoCo simulates (robot.mjcf). MuJoCo computes their motion and their contacts.
//
// The geoms of the body `tool` are carried by the tool of the robot without mass, and what collides of the tool otherwise
// does not collide any more. A point of contact has the static stiffness of the softer of the two materials, and a tenth of
// the critical damping; a face on a face has up to four points. The friction is 0, or the numeric "surface_friction" of the
// robot's file. What the gripper holds is welded to the tool with the stiffness of its bond. Names in MuJoCo begin with
// "scene ".

#include <mujoco/mujoco.h>

#include <memory>
#include <string>
#include <vector>

#include "common/spatial/spatial.hpp"
#include "schema/config_scene.hpp"

namespace tinyxml2 {
class XMLElement;
}

namespace longreach {

/// Bodies of a scene, to be added to the world of an MJCF file.
class MujocoBodies {
 public:
  /// `X_WE_start`: pose of the tool, which is the origin of the file of the bodies; its axes are those of W. Throws
  /// std::invalid_argument "FILE: reason", UnsuitableScene for a mesh or a plane.
  MujocoBodies(const SceneConfig& scene, const Pose& X_WE_start);

  /// Adds them at the end of an MJCF file without <include>. `X_TE`: pose of the site in its body. `sliding`: friction.
  void add(tinyxml2::XMLElement& root, const std::string& site, const Pose& X_TE, double sliding) const;
  /// Sets stiffness and damping of the contacts and of the grasp in the model of that file.
  void set_laws(mjModel& model) const;

 private:
  struct Geom {
    int number = 0, body = 0;  // in the file; body 0: at rest in the world
    int material = 0;          // in the scene
  };
  void take_bodies();
  void take_geoms();
  void add_geoms(tinyxml2::XMLElement& to, int body) const;
  void add_pairs(tinyxml2::XMLElement& root, double sliding) const;
  [[nodiscard]] bool meet(const Geom& a, const Geom& b) const;
  [[nodiscard]] std::string name(mjtObj kind, int number) const;

  SceneConfig scene_;
  Pose X_WE_start_;
  std::unique_ptr<mjModel, void (*)(mjModel*)> model_;
  std::vector<Geom> geom_;  // those that collide
  std::vector<int> free_;   // without the tool
  int tool_ = -1;
};

/// Name in the world of a body, geom or site of the scene.
inline std::string scene_name(const std::string& name) { return "scene " + name; }

}  // namespace longreach
