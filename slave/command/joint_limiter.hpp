#pragma once
// Converts the joint goals of the inverse kinematics to joints that respect every limit, between setpoints:
//   path      q' = q + v dt,  |v| <= V,  |v - v_before| <= A dt,  v <= u(q_max - q)     u: braking_speed
//   setpoint  mean of the path over N ticks,  N = ⌈2 A/(J dt)⌉
// From v <= u(r) one tick of braking always keeps v <= u(r), so the path can stop at every position limit. A
// mean keeps each convex bound of the path; the jerk of the setpoint is (a - a_N)/(N dt), at most 2 A/(N dt)
// <= J. The setpoint lags the path by (N - 1)/2 ticks. Where N would exceed kTicksMax, A is lowered instead.
// All joints are slowed down by the same factor between their present and their target speeds, so that the
// motion of the tool is between the two; and never such that they could not brake together in time for every
// position limit and for the tool speed, which the changing shape of the arm raises by J̇ q̇ meanwhile.

#include <algorithm>
#include <array>

#include "slave/config/robot_config.hpp"

namespace longreach {

/// Limits that kept the path from the joint goals.
struct JointsLimited {
  bool speed = false;
  bool position = false;
  bool acceleration = false;
  [[nodiscard]] bool any() const { return speed || position || acceleration; }
};

/// Limits of the tool, with the Jacobian J of the arm. Default: no limit.
struct ToolBound {
  Eigen::Matrix<double, 6, kMaxJoints> J = decltype(J)::Zero();  // [angular; linear]
  double rad_per_s = 1.0, m_per_s = 1.0;                         // > 0

  /// The share of the speed limits used by [angular; linear].
  [[nodiscard]] double share(const Vector6& V) const {
    return std::max(V.head<3>().norm() / rad_per_s, V.tail<3>().norm() / m_per_s);
  }
  /// J̇ q̇: acceleration of the tool at constant joint speeds.
  [[nodiscard]] Vector6 turn(const JointVector& joint_rad_per_s) const;
};

class JointLimiter {
 public:
  static constexpr int kTicksMax = 128;

  explicit JointLimiter(const RobotConfig& robot);

  /// At rest at these joints, moved into their limits.
  void reset(const JointVector& joint_rad);

  /// Returns true if one step reaches the goal and the arm changes its shape slowly.
  [[nodiscard]] bool reaches(const JointVector& wanted_rad, double dt) const;
  /// Moves towards `wanted_rad` (finite). dt > 0, s, equal in every step (a different one starts at rest).
  JointsLimited step(const JointVector& wanted_rad, const ToolBound& tool, double dt);

  [[nodiscard]] const JointVector& path_rad() const { return path_rad_; }
  [[nodiscard]] const JointVector& setpoint_rad() const { return setpoint_rad_; }
  [[nodiscard]] bool at_rest() const { return rad_per_s_.isZero(0.0); }
  /// Lag of the setpoint behind the path, s.
  [[nodiscard]] double lag_s() const { return 0.5 * (ticks_ - 1) * dt_; }
  /// The setpoint has reached the path and stays there.
  [[nodiscard]] bool settled() const { return still_ticks_ >= ticks_; }

 private:
  struct Joint {
    double min, max, speed, acceleration, jerk;
  };
  struct JointsShare {
    /// scale of the joint speeds that the limits of speed and position permit
    double speed = 1.0, position = 1.0;
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
  /// the last N points of the path
  Eigen::Matrix<double, kMaxJoints, kTicksMax> before_ = decltype(before_)::Zero();
  int newest_ = 0;
  int still_ticks_ = 0;
};

}  // namespace longreach
