#pragma once
// From the joints that the inverse asks for to joints that keep every limit, from setpoint to setpoint:
//   path      q' = q + v dt,  |v| <= V,  |v - v_before| <= A dt,  v <= u(q_max - q)     u: braking_speed
//   setpoint  mean of the path over N ticks,  N = ⌈2 A/(J dt)⌉
// From v <= u(r) one tick of braking always keeps v <= u(r), so the path can stop at every position limit. A
// mean keeps each convex bound of the path; the jerk of the setpoint is (a - a_N)/(N dt), at most 2 A/(N dt)
// <= J. It comes (N - 1)/2 ticks later than the path. Where N would exceed kTicksMax, A is lowered instead.
// All joints are slowed alike, and go alike from the speeds they have towards those they should have, so that
// the tool's motion lies between the two. Where it would still be faster than the tool may be, because the
// arm has another shape by now, they go towards braking alike. Only a joint that would pass its position
// limit all the same brakes by itself.

#include <algorithm>
#include <array>

#include "slave/robot/robot_config.hpp"

namespace longreach {

/// What kept the path from the joints asked for.
struct JointsLimited {
  bool speed = false;  // or acceleration
  bool position = false;
  [[nodiscard]] bool any() const { return speed || position; }
};

/// What the tool may do: J with its angular and its linear rows each in shares of the tool's speed limit.
struct ToolBound {
  Eigen::Matrix<double, 6, kMaxJoints> J_share = decltype(J_share)::Zero();

  [[nodiscard]] double used(const JointVector& rad_per_s) const {
    const Vector6 V = J_share * rad_per_s;
    return std::max(V.head<3>().norm(), V.tail<3>().norm());
  }
  /// The joint speeds nearest to these (damped) at which the tool keeps its limits.
  [[nodiscard]] JointVector within(const JointVector& rad_per_s) const;
};

class JointLimiter {
 public:
  static constexpr int kTicksMax = 128;

  explicit JointLimiter(const RobotConfig& robot);

  /// At rest at these joints, moved into their limits.
  void reset(const JointVector& joint_rad);

  /// True if one step leads there.
  [[nodiscard]] bool reaches(const JointVector& wanted_rad, double dt) const;
  /// Towards `wanted_rad` (finite). dt > 0, s, the same in every step (another one begins at rest).
  JointsLimited step(const JointVector& wanted_rad, const ToolBound& tool, double dt);

  [[nodiscard]] const JointVector& path_rad() const { return path_rad_; }
  [[nodiscard]] const JointVector& setpoint_rad() const { return setpoint_rad_; }
  [[nodiscard]] bool at_rest() const { return rad_per_s_.isZero(0.0); }
  /// The setpoint has come to the path and stays.
  [[nodiscard]] bool settled() const { return still_ticks_ >= ticks_; }

 private:
  struct Joint {
    double min, max, speed, acceleration, jerk, near;  // near: from this far off a position limit is felt
  };
  void tune(double dt);
  [[nodiscard]] double most(const Joint& j, double left_rad, double share) const;
  JointsLimited limit(JointVector& rad_per_s, const ToolBound& tool) const;
  [[nodiscard]] double share_before_limits(const JointVector& rad_per_s) const;
  [[nodiscard]] bool fits(const JointVector& rad_per_s, const ToolBound& tool) const;
  [[nodiscard]] JointVector go_towards(const JointVector& rad_per_s) const;
  [[nodiscard]] JointVector slowed(const JointVector& rad_per_s, const ToolBound& tool) const;
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
