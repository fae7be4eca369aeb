#pragma once
// Velocity of a handle from quantized positions, and detection of a handle at rest. Encoders report a
// position only within a cell; a handle at rest may show jumps of one cell in a sample, and back. The
// position is followed with a play r of half a cell:
//
//   z' = z + Δx,   c = z' max(0, 1 - r/|z'|),   z = z' - c,   v += dt/(dt + filter) (a c/dt - v)
//
// c is the motion that is certain, for any position within the cells. It never points against the motion and
// is zero while the handle stays within a cell, so that damping -B v also only takes energy. When the handle
// reverses, the velocity is zero for the width of a cell; in motion it is that of the encoders. A single
// count, t after the last one, is taken as a speed of at most c/t instead of an impulse: a = min(1, 20 ms/t).
//
// A spring on the cells of the encoders acts as a relay, which with the delay of a sample sustains a limit
// cycle within a cell, and nothing within a cell can damp it. A handle that was measured to move ten cells
// back and forth without certain motion is considered at rest: its position is x - z, which is constant,
// until there is certain motion. A handle at rest supplies no energy. Both handles are processed in the same
// way, with Δx the displacement, m, or the rotation vector, rad.

#include <algorithm>

#include "common/spatial/spatial.hpp"
#include "master/devices/handle_state.hpp"

namespace longreach {

/// Half of the maximum distance between two corners of a cell, at the handle, over the whole workspace.
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

  /// The measurement moves back and forth without certain motion.
  [[nodiscard]] bool rests() const { return wandered_ > kNowhere * cell_; }
  /// Measured position relative to the followed one.
  [[nodiscard]] const Vector3& play() const { return play_; }

 private:
  static constexpr double kNothing2 = 1e-18;
  static constexpr double kAlone_s = 0.02;
  static constexpr double kNowhere = 20.0;  // half cells
  double cell_;
  double wandered_ = 0.0;  // measured distance since the last certain motion
  double alone_s_ = 0.0;   // time since then
  Vector3 play_ = Vector3::Zero();
  Vector3 rate_ = Vector3::Zero();
};

/// Both handles of a device.
class QuantizedMotionFilter {
 public:
  QuantizedMotionFilter(const EncoderCell& cell, double filter_s)
      : linear_(cell.m), angular_(cell.rad), filter_s_(filter_s) {}

  /// Returns the measured, finite handle, held at rest if it has no certain motion, with the certain
  /// velocities. Call it once per tick of `dt_s` > 0.
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
