#pragma once
// How fast a handle certainly moves. Encoders tell a place within a cell; what they show of a handle that
// keeps still is a jump of a cell in a sample, and back. The place is followed with a play r of half a cell:
//
//   z' = z + Δx,   c = z' max(0, 1 - r/|z'|),   z = z' - c,   v += dt/(dt + filter) (c/dt - v)
//
// c is what must have happened, whatever lies in the cells. It never points against the motion and is zero
// while the handle stays within a cell, so that damping -B v, too, takes energy or does nothing. Where the
// handle turns round it says nothing for the width of a cell; in motion it is that of the encoders. Alike for
// both handles, Δx the displacement, m, or the rotation vector of the turn, rad.

#include "common/spatial/spatial.hpp"
#include "master/devices/handle_state.hpp"

namespace longreach {

/// Half the longest way between two corners of a cell, at the handle: everywhere in the workspace.
struct EncoderCell {
  double m = 0.0;
  double rad = 0.0;
};

class CertainVelocity {
 public:
  explicit CertainVelocity(double cell) : cell_(cell) {}

  /// The handle was measured to have `moved` in `dt_s` > 0.
  const Vector3& step(const Vector3& moved, double dt_s, double filter_s) {
    play_ += moved;
    const double length = norm(play_);
    const Vector3 carried =
        length > cell_ ? Vector3((1.0 - cell_ / length) * play_) : Vector3(Vector3::Zero());
    play_ -= carried;
    rate_ += dt_s / (dt_s + filter_s) * (carried / dt_s - rate_);
    if (rate_.squaredNorm() < kNothing2) rate_.setZero();
    return rate_;
  }

 private:
  static constexpr double kNothing2 = 1e-18;
  double cell_;
  Vector3 play_ = Vector3::Zero();  // measured place, from the one that is followed
  Vector3 rate_ = Vector3::Zero();
};

/// Both handles of a device.
class CertainMotion {
 public:
  CertainMotion(const EncoderCell& cell, double filter_s)
      : linear_(cell.m), angular_(cell.rad), filter_s_(filter_s) {}

  /// The handle as measured, finite, with the velocities that are certain. Once a tick of `dt_s` > 0.
  HandleState step(HandleState handle, double dt_s) {
    if (!started_) {
      x_ = handle.p_MH;
      q_ = handle.q_MH;
    }
    started_ = true;
    handle.velocity_m_per_s = linear_.step(handle.p_MH - x_, dt_s, filter_s_);
    handle.angular_rad_per_s = angular_.step(log_rotation(handle.q_MH * q_.conjugate()), dt_s, filter_s_);
    x_ = handle.p_MH;
    q_ = handle.q_MH;
    return handle;
  }

 private:
  CertainVelocity linear_, angular_;
  double filter_s_;
  bool started_ = false;
  Vector3 x_ = Vector3::Zero();
  Quaternion q_ = Quaternion::Identity();
};

}  // namespace longreach
