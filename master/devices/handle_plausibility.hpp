#pragma once
// Checks whether a reported handle state is possible. Between two states, with T the time since the pose last
// changed (at most 0.1 s), T_a the same but at most 20 ms (or the time since the previous tick, if longer), and
// v the speed of the last changes,
//   |Δx| <= 2 mm + 2 v T + a T_a² / 2,   v <= 5 m/s,   a = 20 m/s²      (rotation: 0.05 rad, 100 rad/s, 400 rad/s²)
// Otherwise the handle has jumped: no hand, and no motor of such a device, moves it so. A handle that changes in
// each millisecond is thus detected to jump by more than 2 mm, and one that was at rest by more than 6 mm. After
// a pause of the adapter, a handle may be where its speed before, doubled, takes it. A jump is reported once;
// the state after it is the reference for the following ones.
//
// A handle is outside if its distance from home is more than 1.5 times the radius of its workspace (device
// file), or it is turned by more than 1.5 times its range. A device with a workspace of 75 mm that reports
// millimetres as metres is outside after 0.12 mm; one that reports a quaternion as x y z w is turned by 180
// degrees at home.

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/core/time.hpp"
#include "common/link/hold_cause.hpp"
#include "schema/config_master.hpp"
#include "schema/state_master.hpp"

namespace longreach {

/// Returns whether a device can be in this state. A state that is impossible or not finite counts as a device fault.
inline bool is_possible(const HandleState& h) {
  constexpr double kFar_m = 10.0, kFast = 1e4;
  return h.p_MH.allFinite() && h.velocity_m_per_s.allFinite() && h.angular_rad_per_s.allFinite() &&
         h.p_MH.cwiseAbs().maxCoeff() < kFar_m && h.velocity_m_per_s.cwiseAbs().maxCoeff() < kFast &&
         h.angular_rad_per_s.cwiseAbs().maxCoeff() < kFast && std::abs(h.q_MH.squaredNorm() - 1.0) < 1e-6;
}

class HandlePlausibility {
 public:
  static constexpr double kOutside = 1.5;  // of the workspace

  explicit HandlePlausibility(const DeviceConfig& device)
      : outside_m_(kOutside * device.delta.workspace_m),
        outside_rad_(kOutside * device.spherical.workspace_rad) {}

  /// Returns kHandleJumped or kHandleOutside, for a position with distance and limit, m; no reason for a
  /// possible state.
  /// `h` must be finite. Call this once per tick.
  Reason check(const HandleState& h, Time now) {
    const Vector3 turn = log_rotation(h.q_MH);
    const double passed_s = checked_at_ ? to_seconds(now - *checked_at_) : 0.0;
    const Reason jumped = pose_ ? step(h, now, passed_s) : Reason();
    if (!pose_) changed_at_ = now;
    pose_ = Pose{h.p_MH, h.q_MH};
    checked_at_ = now;
    if (h.p_MH.norm() > outside_m_) return {HoldCause::kHandleOutside, 0, h.p_MH.norm(), outside_m_};
    if (turn.norm() > outside_rad_) return HoldCause::kHandleOutside;
    return jumped;
  }
  /// Call this when the device has failed, because the handle may be moved before it works again.
  void forget() { pose_.reset(), speed_m_per_s_.setZero(), speed_rad_per_s_.setZero(); }

 private:
  static constexpr double kFastest_m_per_s = 5.0, kFastest_rad_per_s = 100.0;
  static constexpr double kMargin_m = 2e-3, kMargin_rad = 0.05;
  static constexpr double kHand_m_per_s2 = 20.0, kHand_rad_per_s2 = 400.0;
  static constexpr double kPause_s = 0.1, kWatchdog_s = 0.02, kMean_s = 0.01;
  static constexpr double kSpeedShare = 2.0;

  Reason step(const HandleState& h, Time now, double passed_s) {
    const Vector3 moved = h.p_MH - pose_->p;
    const Vector3 turned = log_rotation(h.q_MH * pose_->q.conjugate());
    if (moved.isZero(0.0) && turned.isZero(0.0)) return {};
    const double same_s = to_seconds(now - changed_at_);
    const double pause_s = std::min(same_s, kPause_s);
    const double start_s = std::min(same_s, std::max(passed_s, kWatchdog_s));
    const double most_m =
        kMargin_m + kSpeedShare * speed_m_per_s_.norm() * pause_s + 0.5 * kHand_m_per_s2 * start_s * start_s;
    const double most_rad = kMargin_rad + kSpeedShare * speed_rad_per_s_.norm() * pause_s +
                            0.5 * kHand_rad_per_s2 * start_s * start_s;
    const bool jumps = moved.norm() > most_m, spins = turned.norm() > most_rad;
    changed_at_ = now;
    if (jumps || spins || same_s <= 0.0) {
      speed_m_per_s_.setZero(), speed_rad_per_s_.setZero();
      if (jumps) return {HoldCause::kHandleJumped, 0, moved.norm(), most_m};
      return spins ? HoldCause::kHandleJumped : HoldCause::kNone;
    }
    const double share = same_s / (same_s + kMean_s);
    speed_m_per_s_ += share * (moved / same_s - speed_m_per_s_);
    speed_rad_per_s_ += share * (turned / same_s - speed_rad_per_s_);
    const bool races =
        speed_m_per_s_.norm() > kFastest_m_per_s || speed_rad_per_s_.norm() > kFastest_rad_per_s;
    if (!races) return {};
    speed_m_per_s_.setZero(), speed_rad_per_s_.setZero();
    return HoldCause::kHandleJumped;
  }

  double outside_m_, outside_rad_;
  std::optional<Pose> pose_{};
  std::optional<Time> checked_at_{};
  Time changed_at_{};  // time of the last change of the pose
  Vector3 speed_m_per_s_ = Vector3::Zero(), speed_rad_per_s_ = Vector3::Zero();
};

}  // namespace longreach
