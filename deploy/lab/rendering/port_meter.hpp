#pragma once
// Measures the energy and the ripple at one port between hand and device from the commanded force and the
// true motion. The equations are in idle_draw.hpp.

#include <algorithm>
#include <array>
#include <cstddef>

#include "common/spatial/spatial.hpp"
#include "deploy/lab/rendering/idle_draw.hpp"

namespace longreach {

/// Measures one port (translation or rotation) from outside the device.
class PortMeter {
 public:
  static constexpr std::size_t kBlock = 1000;  // ticks per block; a block is one second

  /// Adds the energy exchanged when the handle moves by `moved` under the previously commanded force `f`.
  void moved(const Vector3& f, const Vector3& moved) { energy_j_ -= f.dot(moved); }
  void engaged() { energy_j_ = lowest_j_ = 0.0; }
  /// Sets the maximum motion of the handle, at its current pose, if every encoder changes by one count.
  void rests(double count) { count_ = count; }
  /// Updates the minimum of the energy. After the engagement, call this in each tick in which the hand holds
  /// the handle. All springs are unloaded when the engagement begins.
  void hold() { lowest_j_ = std::min(lowest_j_, energy_j_); }

  /// Adds a tick to the current block of one second. Call this while the hand is at rest. Motion and ripple
  /// are evaluated only for blocks that end with `stable` set, i.e. after the transients.
  void watch(const Vector3& f, const Vector3& x, bool stable) {
    f_[ticks_] = f;
    x_[ticks_] = x;
    sum_j_ += energy_j_;
    if (++ticks_ == kBlock) close_block(stable);
  }

  [[nodiscard]] IdlePort result() const {
    return {.out_j = std::max(-lowest_j_, fallen_j_),
            .ripple = ripple_,
            .motion = motion_,
            .count = count_,
            .force = before_.f.norm(),
            .quiet_s = static_cast<double>(quiet_s_)};
  }

 private:
  using Second = std::array<Vector3, kBlock>;
  struct Mean {
    Vector3 f, x;
    double e_j;
  };

  void close_block(bool stable) {
    Mean now{Vector3::Zero(), Vector3::Zero(), sum_j_ / kBlock};
    for (std::size_t i = 0; i < kBlock; ++i) {
      now.f += f_[i] / kBlock;
      now.x += x_[i] / kBlock;
    }
    if (blocks_++ > 0) {
      unspent_j_ += now.e_j - before_.e_j + 0.5 * (now.f + before_.f).dot(now.x - before_.x);
      highest_j_ = std::max(highest_j_, unspent_j_);
      fallen_j_ = std::max(fallen_j_, highest_j_ - unspent_j_);
    }
    if (stable) motion_ = std::max(motion_, to_and_fro(x_));
    // A drifting handle is not at rest, because the force of its spring follows the drift.
    if (stable && drift(x_, now.x) < 0.1 * count_) {
      ripple_ = std::max(ripple_, ripple(f_, now.f));
      ++quiet_s_;
    }
    before_ = now;
    sum_j_ = 0.0;
    ticks_ = 0;
  }

  static constexpr double kMiddle = 0.5 * (kBlock - 1), kSpread = kBlock * (kBlock * kBlock - 1.0) / 12.0;

  /// Slope of the regression line, per tick.
  static Vector3 slope(const Second& y, const Vector3& mean) {
    Vector3 sum = Vector3::Zero();
    for (std::size_t i = 0; i < kBlock; ++i)
      sum += (static_cast<double>(i) - kMiddle) / kSpread * (y[i] - mean);
    return sum;
  }
  static double drift(const Second& y, const Vector3& mean) { return kBlock * slope(y, mean).norm(); }

  /// Peak-to-peak deviation from the regression line.
  static double ripple(const Second& y, const Vector3& mean) {
    const Vector3 rise = slope(y, mean);
    Vector3 low = Vector3::Constant(1e9), high = -low;
    for (std::size_t i = 0; i < kBlock; ++i) {
      const Vector3 off = y[i] - mean - (static_cast<double>(i) - kMiddle) * rise;
      low = low.cwiseMin(off);
      high = high.cwiseMax(off);
    }
    return (high - low).norm();
  }

  /// Amplitude of the back-and-forth motion, in whichever direction it starts; zero for a monotonic motion.
  static double to_and_fro(const Second& y) {
    Vector3 low = y[0], high = y[0], rise = Vector3::Zero(), fall = rise;
    for (const Vector3& at : y) {
      low = low.cwiseMin(at);
      high = high.cwiseMax(at);
      rise = rise.cwiseMax(at - low);
      fall = fall.cwiseMax(high - at);
    }
    return rise.cwiseMin(fall).norm();
  }

  double energy_j_ = 0.0, lowest_j_ = 0.0;
  double unspent_j_ = 0.0, highest_j_ = 0.0, fallen_j_ = 0.0;
  double ripple_ = 0.0, motion_ = 0.0, sum_j_ = 0.0;
  Second f_{}, x_{};
  Mean before_{Vector3::Zero(), Vector3::Zero(), 0.0};
  double count_ = 0.0;
  std::size_t ticks_ = 0, blocks_ = 0, quiet_s_ = 0;
};

}  // namespace longreach
