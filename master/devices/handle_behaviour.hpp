#pragma once
// Behaviour of the handles that does not depend on the robot. A released handle returns to its home position
// or stays in place. On request, the handle can move only along one axis at a time. A soft stop keeps it away
// from the edge of the workspace.
//
//   idle     F = -k (x - a) - b v          anchor a: where the handle was released; with HOME it glides home
//   guide    F = -k (x - (x . e) e - o)    decoupled: e is the axis that was moved first, o the offset from e then
//   stop     F = -k (|x| - r) x/|x|        beyond the radius r, a fraction of the workspace
//
// Each spring starts with zero force, so that the force never steps. Only the gliding anchor supplies energy;
// supplied_j() reports how much. The same equations apply to rotations, with x the rotation vector from home.

#include "schema/config_master.hpp"
#include "schema/state_master.hpp"

namespace longreach {

/// The springs of one handle, in three coordinates.
class HandleSprings {
 public:
  struct Gains {
    double home = 0.0, damping = 0.0, speed = 0.0;  // N/m, N s/m, m/s; or N m/rad, ... ...
    double guide = 0.0, free = 0.0;                 // N/m, m
    double stop = 0.0, stop_radius = 0.0;           // N/m, m
  };
  struct Coordinates {
    Vector3 x, rate;
  };

  /// Advances by `dt_s` > 0. Returns the force (N) or moment (N m) on the hand.
  Vector3 step(const Coordinates& at, bool held, const Gains& gains, const BehaviourConfig& config,
               double dt_s);

  /// Energy stored in the springs.
  [[nodiscard]] double energy_j() const { return energy_j_; }
  /// Energy supplied by the anchor in the last step.
  [[nodiscard]] double supplied_j() const { return supplied_j_; }
  [[nodiscard]] int guided_axis() const { return axis_; }  // 0 to 2; -1: none
  [[nodiscard]] bool at_stop() const { return at_stop_; }  // at the soft stop of the workspace

 private:
  Vector3 idle(const Coordinates& at, bool held, const Gains& gains, IdleRule rule, double dt_s);
  Vector3 guide(const Vector3& x, const Gains& gains, HandleMotion motion);

  bool left_ = false;
  Vector3 anchor_ = Vector3::Zero();
  int axis_ = -1;
  Vector3 off_ = Vector3::Zero();
  double energy_j_ = 0.0;
  double supplied_j_ = 0.0;
  bool at_stop_ = false;
};

class HandleBehaviour {
 public:
  explicit HandleBehaviour(const DeviceConfig& config);
  void configure(const DeviceConfig& config);

  /// Advances by `dt_s` > 0. Returns the wrench on the hand, in M; zero if a value of the handle is not
  /// finite.
  Wrench step(const HandleState& handle, double dt_s);

  [[nodiscard]] const HandleSprings& translation() const { return translation_; }
  [[nodiscard]] const HandleSprings& rotation() const { return rotation_; }

 private:
  BehaviourConfig config_;
  bool turns_ = true;
  HandleSprings::Gains linear_{}, angular_{};
  HandleSprings translation_, rotation_;
};

}  // namespace longreach
