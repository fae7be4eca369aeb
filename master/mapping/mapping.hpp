#pragma once
// Maps the motion of the handle to the goal of the robot, a displacement g (m) and a rotation R_g from the
// engagement's anchor, both in W (Liu et al. 2019, hybrid control). x, R_H are the handle in M, R_WM the
// base:
//
//   rate      g' = kv R_WM ρ(x - x_ref)              R_g' = [ω]ˣ R_g,  ω = kv R_WM ρ(log(R_H R_refᵀ))
//   position  g  = g_ref + k_scale R_WM (x - x_ref)  R_g  = exp(k_scale R_WM log(R_H R_refᵀ)) R_gref
//
// ρ has a dead zone and an effective radius (rate_law); rotations are composed exactly. Every change of mode,
// clutch, freeze or (in position mode) scale sets new references at the present handle and goal, so the goal
// never steps. The centre x_ref, R_ref of rate mode is the position of the handle when the mode began; it
// moves home with the handle, so that a released handle commands nothing. The literal law, which jumps at the
// edge of the dead zone, re-enters it a tenth further in, so that noise at the edge causes one jump and no
// chatter.
// The lead of the goal is bounded: where a limit holds the robot back at `place`, in the direction d, the
// goal is drawn back along d, at most at its maximum speed, to `place` + kLead and goes no further in this
// direction (lead_bound.hpp), frozen or not. In position mode the reference shifts by the same amount. Not
// handled: rotations of the handle by more than π from its reference.

#include <array>

#include "common/spatial/spatial.hpp"
#include "master/config/mapping_config.hpp"
#include "master/devices/handle_state.hpp"

namespace longreach {

/// Bound on the lead of the goal over the robot: no further than kLead from `place` along `direction`. Goals
/// are displacements (m) or rotation vectors (rad) from the anchor, in W.
struct GoalBound {
  Vector3 place = Vector3::Zero();
  Vector3 direction = Vector3::Zero();  // unit; zero: no bound
};

/// A surface into which the goal moves no faster than this, in rate mode, because hand, goal and force form
/// an integrator. Its position is a displacement (m) or a rotation vector (rad) from the anchor, in W.
struct PressedSurface {
  Vector3 place = Vector3::Zero();
  Vector3 inward = Vector3::Zero();  // unit; zero: none
  double speed_max = 0.0;            // m/s or rad/s
};
using PressedSurfaces = std::array<PressedSurface, 3>;

struct MappingInput {
  HandleState handle{};
  MotionMode mode = MotionMode::kPosition;
  double scale = 1.0;   // k_scale, > 0
  bool frozen = false;  // clutch, hold or released: the handle moves without the robot
  GoalBound translation_bound{}, rotation_bound{};
  PressedSurfaces surfaces{}, stops{};  // in translation, in rotation
};

struct Goal {
  Vector3 position_m = Vector3::Zero();          // from the anchor, W
  Quaternion rotation = Quaternion::Identity();  // from the anchor, W
  Vector3 rotation_rad = Vector3::Zero();        // the same as a rotation vector
};

class Mapping {
 public:
  static constexpr double kLead_m = 3e-3, kLead_rad = 0.04;

  explicit Mapping(const MappingConfig& config) { configure(config); }
  /// A new base sets new references at the next step.
  void configure(const MappingConfig& config);

  /// Starts an engagement: zero goal, references at the handle.
  void reset(const HandleState& handle);

  /// `dt_s` > 0. The goal is always finite: invalid values of the handle leave it unchanged.
  const Goal& step(const MappingInput& input, double dt_s);

  [[nodiscard]] const Goal& goal() const { return goal_; }
  /// Returns the goal `ahead_s` (>= 0) from now, extrapolated by the present motion: in rate mode by the
  /// commanded speed, in position mode by the mean speed of the last tenth of a second.
  [[nodiscard]] Pose forecast(double ahead_s) const;

  /// Centre of rate mode in M: m, and orientation.
  [[nodiscard]] const Vector3& centre_m() const { return x_ref_; }
  [[nodiscard]] const Quaternion& centre_rotation() const { return q_ref_; }
  [[nodiscard]] bool frozen() const { return frozen_; }
  [[nodiscard]] double scale() const { return scale_; }  // k_scale
  /// R_WM.
  [[nodiscard]] const Quaternion& base() const { return base_; }

  /// Coordinate along R_WMᵀ n, in M from home, at which the handle is in the plane n . g = `offset_m` of the
  /// goal space; n unit, in W. Position mode only.
  [[nodiscard]] double handle_offset_m(const Vector3& n, double offset_m) const;

  /// Rotation vector of the handle, in M from home, at which it commands `goal_rotation`. Position mode only.
  /// Limited to 2 rad from the reference of the handle, which is beyond every device.
  [[nodiscard]] Vector3 handle_rotation_at(const Quaternion& goal_rotation) const;

 private:
  void take_references(const HandleState& handle);
  void step_rate(const MappingInput& input, double dt_s);
  void step_position(const HandleState& handle, double dt_s);
  void advance(const Vector3& move_m, const Vector3& turn_rad);
  void draw_back(const GoalBound& bound, const Vector3& before_m, double dt_s);
  void turn_back(const GoalBound& bound, const Quaternion& before, double dt_s);

  MappingConfig config_;
  Quaternion base_ = Quaternion::Identity();
  Goal goal_{};
  MotionMode mode_ = MotionMode::kPosition;
  double scale_ = 1.0;
  bool frozen_ = true;
  bool outside_m_ = false, outside_rad_ = false;  // outside of the dead zones
  Vector3 x_ref_ = Vector3::Zero();               // handle at the last change
  Vector3 g_ref_ = Vector3::Zero();               // goal at the last change
  Quaternion q_ref_ = Quaternion::Identity();
  Quaternion q_gref_ = Quaternion::Identity();
  Vector3 speed_m_per_s_ = Vector3::Zero();  // of the goal, W
  Vector3 speed_rad_per_s_ = Vector3::Zero();
};

/// Speed commanded by a deflection, per unit of kv: zero inside the dead zone, limited at `radius_max`.
/// Continuous: |x| - dead_zone; literal: |x|.
Vector3 rate_law(const Vector3& deflection, double dead_zone, double radius_max, RateLaw law);

}  // namespace longreach
