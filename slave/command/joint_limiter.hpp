#pragma once
// From the joints that the inverse asks for to joints that keep every limit, from setpoint to setpoint:
//   path      q' = q + v dt,  |v| <= V,  |v - v_before| <= A dt,  v <= u(q_max - q)     u: braking_speed
//   setpoint  mean of the path over N ticks,  N = ⌈2 A/(J dt)⌉
// From v <= u(r) one tick of braking always keeps v <= u(r), so the path can stop at every position limit. A
// mean keeps each convex bound of the path; the jerk of the setpoint is (a - a_N)/(N dt), at most 2 A/(N dt)
// <= J. It comes (N - 1)/2 ticks later than the path. Where N would exceed kTicksMax, A is lowered instead.
// All joints are slowed alike, and go alike from the speeds they have towards those they should have, so that
// the tool's motion lies between the two; and never where they could not brake alike in time for every
// position limit and for the tool's speed, which the arm's changing shape raises by J̇ q̇ meanwhile.

#include <algorithm>
#include <array>

#include "slave/config/robot_config.hpp"

namespace longreach {

/// What kept the path from the joints asked for.
struct JointsLimited {
  bool speed = false;
  bool position = false;
  bool acceleration = false;
  [[nodiscard]] bool any() const { return speed || position || acceleration; }
};

/// What the tool may do, with the arm's Jacobian J. As it is made: anything.
struct ToolBound {
  Eigen::Matrix<double, 6, kMaxJoints> J = decltype(J)::Zero();  // [angular; linear]
  double rad_per_s = 1.0, m_per_s = 1.0;                         // > 0

  /// The share of the speed limits that [angular; linear] uses.
  [[nodiscard]] double share(const Vector6& V) const {
    return std::max(V.head<3>().norm() / rad_per_s, V.tail<3>().norm() / m_per_s);
  }
  /// J̇ q̇: the tool's acceleration while the joints keep their speeds.
  [[nodiscard]] Vector6 turn(const JointVector& joint_rad_per_s) const;
};

class JointLimiter {
 public:
  static constexpr int kTicksMax = 128;

  explicit JointLimiter(const RobotConfig& robot);

  /// At rest at these joints, moved into their limits.
  void reset(const JointVector& joint_rad);

  /// True if one step leads there, and the arm changes its shape slowly.
  [[nodiscard]] bool reaches(const JointVector& wanted_rad, double dt) const;
  /// Towards `wanted_rad` (finite). dt > 0, s, the same in every step (another one begins at rest).
  JointsLimited step(const JointVector& wanted_rad, const ToolBound& tool, double dt);

  [[nodiscard]] const JointVector& path_rad() const { return path_rad_; }
  [[nodiscard]] const JointVector& setpoint_rad() const { return setpoint_rad_; }
  [[nodiscard]] bool at_rest() const { return rad_per_s_.isZero(0.0); }
  /// By which the setpoint comes later than the path, s.
  [[nodiscard]] double lag_s() const { return 0.5 * (ticks_ - 1) * dt_; }
  /// The setpoint has come to the path and stays.
  [[nodiscard]] bool settled() const { return still_ticks_ >= ticks_; }

 private:
  struct Joint {
    double min, max, speed, acceleration, jerk;
  };
  struct JointsShare {
    double speed = 1.0, position = 1.0;  // of joint speeds: what limits of speed and of position leave
    [[nodiscard]] double least() const { return std::min(speed, position); }
  };
  void tune(double dt);
  [[nodiscard]] JointsShare share(const JointVector& rad_per_s, const ToolBound& tool) const;
  [[nodiscard]] double stop_s(const JointVector& rad_per_s) const;
  [[nodiscard]] JointVector go_towards(const JointVector& rad_per_s) const;
  [[nodiscard]] JointVector inside(const JointVector& rad_per_s) const;
  JointsLimited limit(JointVector& rad_per_s, const ToolBound& tool) const;
  void average();

  std::array<Joint, kMaxJoints> joint_{};
  double dt_ = 0.0;
  int ticks_ = 1;  // N
  JointVector path_rad_ = JointVector::Zero();
  JointVector rad_per_s_ = JointVector::Zero();  // of the path
  JointVector setpoint_rad_ = JointVector::Zero();
  Eigen::Matrix<double, kMaxJoints, kTicksMax> before_ = decltype(before_)::Zero();  // the path's last N
  int newest_ = 0;
  int still_ticks_ = 0;
};

}  // namespace longreach
