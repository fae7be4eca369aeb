#pragma once
// Behaviours of the handles that are independent of the robot: return home or stay in place when released,
// keep to one axis at a time on request, stop softly before the edge of the workspace.
//
//   idle     F = -k (x - a) - b v     anchor a: where the handle was left; HOME lets it glide home
//   guide    F = -k (x - (x . e) e - o)    decoupled: e the axis that was moved first, o what was off it then
//   stop     F = -k (|x| - r) x/|x|   beyond r, a share of the workspace
//
// All springs start without force, so that nothing steps; only the gliding anchor supplies energy, which it
// reports. The same applies to rotations, with x the rotation vector from home.

#include "master/config/device_config.hpp"
#include "master/devices/handle_state.hpp"

namespace longreach {

/// One handle: three coordinates and the forces on them.
class HandleSprings {
 public:
  struct Gains {
    double home = 0.0, damping = 0.0, speed = 0.0;  // N/m, N s/m, m/s; or N m/rad ...
    double guide = 0.0, free = 0.0;                 // N/m, m
    double stop = 0.0, stop_radius = 0.0;           // N/m, m
  };
  struct Coordinates {
    Vector3 x, rate;
  };

  /// Force on the hand. `dt_s` > 0.
  Vector3 step(const Coordinates& at, bool held, const Gains& gains, const BehaviourConfig& config,
               double dt_s);

  [[nodiscard]] double energy_j() const { return energy_j_; }
  [[nodiscard]] double supplied_j() const { return supplied_j_; }  // by the anchor, in the last step
  [[nodiscard]] int guided_axis() const { return axis_; }          // -1: none
  [[nodiscard]] bool at_stop() const { return at_stop_; }          // the soft stop of the workspace

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

  /// Wrench on the hand, in M. Values of the handle that are not finite give zero.
  Wrench step(const HandleState& handle, double dt_s);

  [[nodiscard]] const HandleSprings& translation() const { return translation_; }
  [[nodiscard]] const HandleSprings& rotation() const { return rotation_; }

 private:
  BehaviourConfig config_;
  HandleSprings::Gains linear_{}, angular_{};
  HandleSprings translation_, rotation_;
};

}  // namespace longreach
