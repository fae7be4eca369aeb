#pragma once
// How fast a handle certainly moves, and where it is while it does not. Encoders tell a place within a cell;
// what they show of a handle that keeps still is a jump of a cell in a sample, and back. The place is
// followed with a play r of half a cell:
//
//   z' = z + Δx,   c = z' max(0, 1 - r/|z'|),   z = z' - c,   v += dt/(dt + filter) (a c/dt - v)
//
// c is what must have happened, whatever lies in the cells. It never points against the motion and is zero
// while the handle stays within a cell, so that damping -B v, too, takes energy or does nothing. Where the
// handle turns round, the encoder reports nothing for the width of a cell; in motion it is that of the encoders. A count
// that comes alone, t after the last, is a speed of c/t at most and no blow: a = min(1, 20 ms/t).
//
// A spring on the cells of the encoders is a relay, which with the delay of a sample feeds a cycle within a
// cell, and nothing within a cell can damp it. A handle that was measured to go ten cells to and fro without
// having moved for certain gets nowhere: its place is x - z, which rests, until it has moved for certain.
// What rests gives no energy. Alike for both handles, Δx the displacement, m, or the rotation vector of the
// turn, rad.

#include <algorithm>

#include "common/spatial/spatial.hpp"
#include "master/devices/handle_state.hpp"

namespace longreach {

/// Half the longest way between two corners of a cell, at the handle: everywhere in the workspace.
struct EncoderCell {
  double m = 0.0;
  double rad = 0.0;
};

class QuantizedVelocityFilter {
 public:
  explicit QuantizedVelocityFilter(double cell) : cell_(cell) {}

  /// The handle was measured to have `moved` in `dt_s` > 0.
  const Vector3& step(const Vector3& moved, double dt_s, double filter_s) {
    play_ += moved;
    wandered_ += norm(moved);
    alone_s_ += dt_s;
    const double length = norm(play_);
    const Vector3 carried =
        length > cell_ ? Vector3((1.0 - cell_ / length) * play_) : Vector3(Vector3::Zero());
    play_ -= carried;
    rate_ += dt_s / (dt_s + filter_s) * (std::min(1.0, kAlone_s / alone_s_) * carried / dt_s - rate_);
    if (length > cell_) wandered_ = alone_s_ = 0.0;
    if (rate_.squaredNorm() < kNothing2) rate_.setZero();
    return rate_;
  }

  /// What is measured goes to and fro and gets nowhere.
  [[nodiscard]] bool rests() const { return wandered_ > kNowhere * cell_; }
  /// Measured place, from the one that is followed.
  [[nodiscard]] const Vector3& play() const { return play_; }

 private:
  static constexpr double kNothing2 = 1e-18;
  static constexpr double kAlone_s = 0.02;
  static constexpr double kNowhere = 20.0;  // half cells
  double cell_;
  double wandered_ = 0.0;  // way that was measured since the last certain motion
  double alone_s_ = 0.0;   // since then
  Vector3 play_ = Vector3::Zero();
  Vector3 rate_ = Vector3::Zero();
};

/// Both handles of a device.
class QuantizedMotionFilter {
 public:
  QuantizedMotionFilter(const EncoderCell& cell, double filter_s)
      : linear_(cell.m), angular_(cell.rad), filter_s_(filter_s) {}

  /// The handle as measured, finite, at rest where it gets nowhere, with the velocities that are certain.
  /// Once a tick of `dt_s` > 0.
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
    if (linear_.rests()) handle.p_MH -= linear_.play();
    if (angular_.rests()) handle.q_MH = exp_rotation(-angular_.play()) * handle.q_MH;
    return handle;
  }

 private:
  QuantizedVelocityFilter linear_, angular_;
  double filter_s_;
  bool started_ = false;
  Vector3 x_ = Vector3::Zero();
  Quaternion q_ = Quaternion::Identity();
};

}  // namespace longreach
