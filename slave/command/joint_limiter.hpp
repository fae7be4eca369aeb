#pragma once
// Converts the joint goals of the inverse kinematics to joint setpoints that respect all limits. In each
// step:
//   path      q' = q + v dt,  |v| <= V,  |v - v_before| <= A dt,  v <= u(q_max - q)     u: braking_speed
//   setpoint  mean of the path over N ticks,  N = ⌈2 A/(J dt)⌉
// If v <= u(r) at the distance r from a limit, this still holds after a tick of braking, so the path can stop
// before every position limit. The mean satisfies every convex bound that the path satisfies. The jerk of the
// setpoint is (a - a_N)/(N dt), at most 2 A/(N dt) <= J. The setpoint lags the path by (N - 1)/2 ticks. If N
// would exceed kTicksMax, A is reduced instead. The speeds of all joints are scaled by the same factor between
// their current and their target values, so the velocity of the tool also lies between its current and its target
// value. The speeds are also low enough that all joints can brake together in time for every position limit and
// for the speed limit of the tool: while they brake, the changing Jacobian accelerates the tool by J̇ q̇.

#include <algorithm>
#include <array>

#include "schema/config_slave.hpp"
#include "slave/robot/robot.hpp"

namespace longreach {

/// Limits that kept the path from reaching the joint goals.
struct JointsLimited {
  bool speed = false;
  bool position = false;
  bool acceleration = false;
  [[nodiscard]] bool any() const { return speed || position || acceleration; }
};

/// Speed limits of the tool and the Jacobian J of the arm. By default, the tool is not limited.
struct ToolBound {
  Eigen::Matrix<double, 6, kMaxJoints> J = decltype(J)::Zero();  // [angular; linear]
  double rad_per_s = 1.0, m_per_s = 1.0;                         // > 0

  /// Returns the fraction of the speed limits that the twist [angular; linear] uses.
  [[nodiscard]] double share(const Vector6& V) const {
    return std::max(V.head<3>().norm() / rad_per_s, V.tail<3>().norm() / m_per_s);
  }
  /// Returns J̇ q̇, the acceleration of the tool at constant joint speeds.
  [[nodiscard]] Vector6 turn(const JointVector& joint_rad_per_s) const;
};

class JointLimiter {
 public:
  static constexpr int kTicksMax = 128;
  static constexpr double kAlike = 0.5;  // share of the accelerations that is available for braking together

  explicit JointLimiter(const RobotConfig& robot);

  /// Restarts at rest at these joint positions, clamped to the position limits.
  void reset(const JointVector& joint_rad);

  /// Returns true if one step reaches the goal and all joints move slowly.
  [[nodiscard]] bool reaches(const JointVector& wanted_rad, double dt) const;
  /// Moves towards `wanted_rad` (finite). `dt` > 0 is in s and should be the same in every step; a step with
  /// a different value restarts at rest.
  JointsLimited step(const JointVector& wanted_rad, const ToolBound& tool, double dt);

  [[nodiscard]] const JointVector& path_rad() const { return path_rad_; }
  [[nodiscard]] const JointVector& setpoint_rad() const { return setpoint_rad_; }
  /// Time in which all joints can brake to rest from these speeds with their maximum accelerations, s.
  [[nodiscard]] double braking_s(const JointVector& rad_per_s) const;
  [[nodiscard]] bool at_rest() const { return rad_per_s_.isZero(0.0); }
  /// Lag of the setpoint behind the path, s.
  [[nodiscard]] double lag_s() const { return 0.5 * (ticks_ - 1) * dt_; }
  /// True if the path is at rest and the setpoint has reached it.
  [[nodiscard]] bool settled() const { return still_ticks_ >= ticks_; }

 private:
  struct Joint {
    double min, max, speed, acceleration, jerk;
  };
  struct JointsShare {
    /// Factors by which the joint speeds must be scaled to respect the speed limits and the position limits.
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
  JointVector rad_per_s_ = JointVector::Zero();  // velocity of the path
  JointVector setpoint_rad_ = JointVector::Zero();
  /// Ring buffer of the last N points of the path.
  Eigen::Matrix<double, kMaxJoints, kTicksMax> before_ = decltype(before_)::Zero();
  int newest_ = 0;
  int still_ticks_ = 0;
};

}  // namespace longreach
