#pragma once
// From the motion of the handle to the goal of the robot, a displacement g (m) and a rotation R_g from the
// engagement's anchor (Liu et al. 2019, hybrid control):
//
//   rate      g' = kv (|x| - r_dz) x/|x|  outside the dead zone, x the deflection from the centre, |x| <=
//   r_max position  g  = g_ref + k_scale (x - x_ref),   R_g = exp(k_scale log(R_H R_ref^T)) R_gref
//
// Every change of mode, scale, clutch or freeze takes new references where handle and goal are, so the goal
// never steps. The centre of rate mode is where the handle was when the mode began; it goes home with it.
// Frames M and W are taken as parallel.

#include "common/spatial/spatial.hpp"
#include "master/devices/handle_state.hpp"
#include "master/mapping/mapping_config.hpp"

namespace longreach {

struct MappingInput {
  HandleState handle{};
  MotionMode mode = MotionMode::kPosition;
  double scale = 1.0;   // k_scale
  bool frozen = false;  // clutch or hold: the handle moves without the robot
};

struct Goal {
  Vector3 position_m = Vector3::Zero();  // from the anchor, W
  Quaternion rotation = Quaternion::Identity();
  bool translation_moved = false;  // in this step
  bool rotation_moved = false;
};

class Mapping {
 public:
  explicit Mapping(const MappingConfig& config) : config_(config) {}
  void configure(const MappingConfig& config) { config_ = config; }

  /// Begins an engagement: zero goal, references at the handle.
  void reset(const HandleState& handle);

  /// `dt_s` > 0. Non-finite handle values leave the goal unchanged.
  const Goal& step(const MappingInput& input, double dt_s);

  [[nodiscard]] const Goal& goal() const { return goal_; }
  /// Centre of rate mode, m, in M.
  [[nodiscard]] const Vector3& centre_m() const { return x_ref_; }

  /// Where along `n` (unit) the handle meets the plane n . g = `offset_m` of the goal's space. Position mode
  /// only.
  [[nodiscard]] double handle_offset_m(const Vector3& n, double offset_m) const;
  /// The handle's rotation vector, from home in M, at which position mode commands `goal_rotation`.
  [[nodiscard]] Vector3 handle_rotation_at(const Quaternion& goal_rotation) const;
  /// R_WM.
  [[nodiscard]] const Quaternion& base() const { return base_; }

 private:
  void take_references(const HandleState& handle);
  void step_rate(const HandleState& handle, double dt_s);
  void step_position(const HandleState& handle, double dt_s);

  MappingConfig config_;
  Quaternion base_ = Quaternion::Identity();
  Goal goal_{};
  MotionMode mode_ = MotionMode::kPosition;
  double scale_ = 1.0;
  bool frozen_ = true;
  Vector3 x_ref_ = Vector3::Zero();  // handle at the last change
  Vector3 g_ref_ = Vector3::Zero();  // goal at the last change
  Quaternion q_ref_ = Quaternion::Identity();
  Quaternion q_gref_ = Quaternion::Identity();
};

/// Speed that a deflection commands, per unit of kv: zero inside the dead zone, capped at `radius_max`.
Vector3 rate_law(const Vector3& deflection, double dead_zone, double radius_max, RateLaw law);

}  // namespace longreach
