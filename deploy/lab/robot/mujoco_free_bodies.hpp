#pragma once
// The free bodies of a scene of longreach in a MuJoCo world (deploy/mujoco/bodies.hpp), with the gripper and the latch of
// the scene (proto/config_scene.proto). MuJoCo has neither: the gripper is a weld that closes within reach of the fixture, and
// the latch, after its travel, ends the contact of striker and keeper and holds by its bond, once in each step.

#include <vector>

#include "deploy/mujoco/world.hpp"
#include "slave/simulation/scene/free_bodies.hpp"
#include "slave/simulation/scene/interaction.hpp"

namespace longreach {

class MujocoFreeBodies final : public FreeBodies {
 public:
  /// `world` contains the bodies of `scene` and must outlive the object.
  MujocoFreeBodies(MujocoWorld& world, const SceneConfig& scene, const Pose& X_WE_start);

  /// Closes or opens the gripper. A closing gripper grasps the fixture if it is within reach.
  void grip(bool closed) { closed_ = closed; }
  /// Advances the world and the bodies by `dt` s. Throws like MujocoWorld::step.
  void step(double dt);
  /// Pose of the body's frame in the file, in W.
  [[nodiscard]] Pose pose(int i) const;

  [[nodiscard]] int count() const override { return static_cast<int>(body_.size()); }
  [[nodiscard]] const FreeBody& body(int i) const override { return body_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] const RigidState& state(int i) const override { return state_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] const BodiesContact& contact() const override { return contact_; }
  void push(int i, const Vector3& v_m_per_s, const Vector3& w_rad_per_s) override;
  void place(int i, const Pose& X_S) override;
  [[nodiscard]] Vector3 to_fixture_m() const override;

 private:
  void feel();
  void close_gripper();
  void close_latch();
  void hold_by_latch(double dt);
  [[nodiscard]] int numbered(mjtObj kind, const std::string& name) const;

  MujocoWorld& world_;
  BodiesConfig config_;
  Pose X_WE_start_;
  std::vector<int> number_;  // of each body in the model
  std::vector<FreeBody> body_;
  std::vector<RigidState> state_;
  BodiesContact contact_{};
  bool closed_ = false;
  int tool_ = -1, grasp_ = -1, fixture_ = -1;      // numbers in the model
  int striker_ = -1, keeper_ = -1, pair_ = -1;     // likewise
  Quaternion q_fixture_ = Quaternion::Identity();  // of the fixture in W at the start
  BondRest rest_{};                                // of the latch
  Pose striker_was_{};                             // pose of the striker's body in W before the last step
};

}  // namespace longreach
