#pragma once
// Velocity of a handle from quantized positions, and detection of a handle at rest. Encoders determine a
// position only to within a cell; the reading of a handle at rest may jump by one cell from one sample to the
// next, and back again. The position is tracked with a play (backlash) r of half a cell:
//
//   z' = z + Δx,   c = z' max(0, 1 - r/|z'|),   z = z' - c,   v += dt/(dt + filter) (a c/dt - v)
//
// c is the certain motion: it must have taken place, wherever the true positions are within their cells. It
// never points against the motion and is zero while the handle stays within a cell, so that damping -B v can
// only extract energy. When the handle reverses, the velocity is zero over the width of a cell; while the
// handle keeps moving, the velocity is that of the encoders. A single count at time t after the previous one
// is treated as a speed of at most c/t instead of an impulse: a = min(1, 20 ms/t).
//
// Within a cell, a spring on quantized positions acts as a relay. With a delay of one sample, the relay
// sustains a limit cycle, on which damping has no effect. A handle whose measured path is longer than ten
// cells without any certain motion is therefore considered at rest: its position is x - z, which is constant,
// until there is certain motion. A handle at rest supplies no energy. Both handles are processed in the same
// way; Δx is the displacement, m, or the rotation vector, rad.

#include <algorithm>

#include "common/spatial/spatial.hpp"
#include "schema/state_master.hpp"

namespace longreach {

/// Half of the maximum distance between two corners of an encoder cell, at the handle, over the whole
/// workspace.
struct EncoderCell {
  double m = 0.0;
  double rad = 0.0;
};

class QuantizedVelocityFilter {
 public:
  explicit QuantizedVelocityFilter(double cell) : cell_(cell) {}

  /// Advances by the measured displacement `moved` in `dt_s` > 0. Returns the velocity.
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

  /// Returns whether the reading only jumps back and forth without any certain motion.
  [[nodiscard]] bool rests() const { return wandered_ > kNowhere * cell_; }
  /// Measured position relative to the tracked position.
  [[nodiscard]] const Vector3& play() const { return play_; }

 private:
  static constexpr double kNothing2 = 1e-18;
  static constexpr double kAlone_s = 0.02;
  static constexpr double kNowhere = 20.0;  // in half cells
  double cell_;
  double wandered_ = 0.0;  // length of the measured path since the last certain motion
  double alone_s_ = 0.0;   // time since the last certain motion
  Vector3 play_ = Vector3::Zero();
  Vector3 rate_ = Vector3::Zero();
};

/// Filters for both handles of a device.
class QuantizedMotionFilter {
 public:
  QuantizedMotionFilter(const EncoderCell& cell, double filter_s)
      : linear_(cell.m), angular_(cell.rad), filter_s_(filter_s) {}

  /// Returns the measured state with the filtered velocities; a handle without certain motion keeps its pose.
  /// The input must be finite. Call this once per tick of `dt_s` > 0.
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
