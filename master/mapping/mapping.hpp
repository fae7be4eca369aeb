#pragma once
// Maps the motion of the handle to the goal of the robot. The goal is a displacement g (m) and a rotation R_g
// from the engagement's anchor, both in W (Liu et al. 2019, hybrid control). x and R_H are the pose of the
// handle in M; R_WM is the orientation of the device's base in W:
//
//   rate      g' = kv R_WM ρ(x - x_ref)              R_g' = [ω]ˣ R_g,  ω = kv R_WM ρ(log(R_H R_refᵀ))
//             in a surface, along its normal: as deep as the force at the hand requires
//   position  g  = g_ref + k_scale R_WM (x - x_ref)  R_g  = exp(k_scale R_WM log(R_H R_refᵀ)) R_gref
//
// ρ has a dead zone and a maximum effective radius (rate_law); rotations are composed exactly. Every change of
// mode, clutch, freeze or (in position mode) scale sets new references at the current handle pose and goal, so
// that the goal never steps. If the scale falls while the hand presses on surfaces, the reference of the goal moves out
// of them along their normals until its depth is k_scale times that of the hand. The force on the hand then stays,
// and the robot presses as the hand does. The same is done slowly, in position mode, for the depth that the spring of a
// pressed surface lacks because its energy is used up: what the spring cannot carry, the robot does not press.
//
// The centre x_ref, R_ref of rate mode is home, the origin of the handle. A handle that is outside its dead zone when rate
// mode begins commands nothing until it has been inside; the other handle is not affected. With `rate_centre:
// WHERE_MODE_BEGAN`, the centre is the pose of the handle when the mode began, and moves home together with the handle. In
// both cases, a released handle commands no motion. A change of kv, and the end of a wait for home, take effect by a ramp,
// so that the velocity of the goal does not step. The literal law is discontinuous at the edge of the dead zone. With this
// law, the commanded motion ends only when the deflection is a tenth further inside, so that noise at the edge causes a
// single jump instead of chatter.
//
// With `simultaneous: TRANSLATION`, a rotation of the handle has no effect while the handle translates (Liu et al. 2019):
// in position mode, the references of the rotation then move with the handle, so that the goal does not turn afterwards.
//
// The lead of the goal is bounded. If a limit holds the robot back at `place`, in the direction d, the goal
// is pulled back along d to `place` + lead, no faster than its maximum speed, and advances no further in
// this direction (lead_bound.hpp), even while it is frozen. In position mode the reference shifts by the same
// amount. Rotations of the handle by more than π from its reference are not supported.

#include <array>
#include <limits>

#include "common/spatial/spatial.hpp"
#include "schema/config_master.hpp"
#include "schema/state_master.hpp"

namespace longreach {

/// Bound on how far the goal may lead the robot: at most `lead` from `place` along `direction`. All are in W;
/// `place` is a displacement (m) or rotation vector (rad) from the anchor.
struct GoalBound {
  Vector3 place = Vector3::Zero();
  Vector3 direction = Vector3::Zero();  // unit vector; zero: no bound
  double lead = 0.0;                    // m or rad
};

/// A surface on which the goal may press. `place`, where its force is zero, is a displacement (m) or a rotation vector
/// (rad) from the anchor, in W.
struct PressedSurface {
  Vector3 place = Vector3::Zero();
  Vector3 inward = Vector3::Zero();  // unit vector into the surface, W; zero: no surface
  // Rate mode: speed at which the goal may move into the surface, m/s or rad/s. If the force at the hand commands the
  // depth of the goal, the range of depths that it permits; the goal moves into this range.
  double speed_max = 0.0;
  bool by_force = false;
  double shallow = 0.0, deep = 0.0;
  double depth = 0.0;   // of the spring that the hand presses, at the handle, m or rad
  double unpaid = 0.0;  // depth at the handle that this spring lacks (ContactSpring::unpaid_m)
  double least = 0.0;   // depth of the goal below which the contact could be lost, m or rad
};
using PressedSurfaces = std::array<PressedSurface, 3>;

struct MappingInput {
  HandleState handle{};
  MotionMode mode = MotionMode::kPosition;
  double scale = 1.0;   // k_scale, > 0
  bool frozen = false;  // the handle moves without the robot (clutch, hold or release)
  GoalBound translation_bound{}, rotation_bound{};
  PressedSurfaces surfaces{}, stops{};  // surfaces in translation and in rotation
  // Speed limit of the goal in rate mode in addition to the configured one, m/s.
  double speed_max_m_per_s = std::numeric_limits<double>::infinity();
};

struct Goal {
  Vector3 position_m = Vector3::Zero();          // displacement relative to the anchor, W
  Quaternion rotation = Quaternion::Identity();  // rotation relative to the anchor, W
  Vector3 rotation_rad = Vector3::Zero();        // the same rotation as a rotation vector
};

class Mapping {
 public:
  /// Maximum leads of a goal bound.
  static constexpr double kLead_m = 3e-3, kLead_rad = 0.04;

  explicit Mapping(const MappingConfig& config) { configure(config); }
  /// Takes effect in the next step. A new orientation of the base sets new references.
  void configure(const MappingConfig& config);

  /// Starts an engagement with a zero goal and with references at the pose of the handle.
  void reset(const HandleState& handle);

  /// Advances by `dt_s` > 0 and returns the goal. The goal is always finite: it does not change if the handle
  /// has non-finite values.
  const Goal& step(const MappingInput& input, double dt_s);

  [[nodiscard]] const Goal& goal() const { return goal_; }
  /// Returns the goal extrapolated by `ahead_s` >= 0, with the commanded velocity in rate mode, and with the
  /// velocity of the goal, low-pass filtered over 0.1 s, in position mode.
  [[nodiscard]] Pose forecast(double ahead_s) const;

  /// Deflections of the handle from the centre of rate mode beyond the dead zones, in M: m and rotation vector. Zero while
  /// the handle has to be brought home.
  [[nodiscard]] Vector3 deflection_m(const HandleState& handle) const;
  [[nodiscard]] Vector3 deflection_rad(const HandleState& handle) const;
  /// Centre of rate mode in M: position, m, and orientation.
  [[nodiscard]] const Vector3& centre_m() const { return x_ref_; }
  [[nodiscard]] const Quaternion& centre_rotation() const { return q_ref_; }
  [[nodiscard]] bool frozen() const { return frozen_; }
  /// Whether the handle has not been home since rate mode began, in translation and in rotation.
  [[nodiscard]] bool bring_home() const { return !frozen_ && !rate_m_.home; }
  [[nodiscard]] bool turn_home() const { return !frozen_ && !rate_rad_.home; }
  [[nodiscard]] double scale() const { return scale_; }  // k_scale
  /// Distance by which the last step moved the reference of the goal out of surfaces, m.
  [[nodiscard]] double carried_m() const { return carried_m_; }
  /// R_WM, the orientation of the handle's base in W.
  [[nodiscard]] const Quaternion& base() const { return base_; }

  /// Returns the coordinate of the handle along R_WMᵀ n, in M, from home, at which it commands a goal in the
  /// plane n . g = `offset_m`. n is a unit vector in W. Position mode only.
  [[nodiscard]] double handle_offset_m(const Vector3& n, double offset_m) const;

  /// Returns the rotation vector of the handle, in M, from home, at which it commands `goal_rotation`. It is
  /// limited to 2 rad from the reference of the handle, an angle that no device can reach. Position mode
  /// only.
  [[nodiscard]] Vector3 handle_rotation_at(const Quaternion& goal_rotation) const;

 private:
  /// What rate mode remembers of one device.
  struct RateMemory {
    double kv_per_s = 0.0;  // in effect
    bool outside = false;   // the deflection is outside the dead zone
    bool home = true;       // the handle has been home since the mode began
  };

  void take_references(const HandleState& handle);
  void centre_follows(const HandleState& handle);
  Vector3 translation_rate(const HandleState& handle, double dt_s);
  Vector3 rotation_rate(const HandleState& handle, double dt_s);
  [[nodiscard]] bool translates() const;
  void ease(const MappingInput& input);
  void carry(const MappingInput& input, double dt_s);
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
  double carried_m_ = 0.0;
  bool frozen_ = true;
  RateMemory rate_m_{}, rate_rad_{};
  // Position of the handle when the references were set, or centre of rate mode.
  Vector3 x_ref_ = Vector3::Zero();
  Vector3 g_ref_ = Vector3::Zero();  // goal when the references were set
  Quaternion q_ref_ = Quaternion::Identity();
  Quaternion q_gref_ = Quaternion::Identity();
  Vector3 speed_m_per_s_ = Vector3::Zero();  // velocity of the goal, W
  Vector3 speed_rad_per_s_ = Vector3::Zero();
};

/// Returns the velocity that a deflection x commands, divided by kv. It is zero inside the dead zone and does
/// not increase beyond `radius_max`. Its magnitude is |x| - dead_zone for the continuous law and |x| for the
/// literal law.
Vector3 rate_law(const Vector3& deflection, double dead_zone, double radius_max, RateLaw law);

}  // namespace longreach
