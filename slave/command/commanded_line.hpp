#pragma once
// Stops the tool on its commanded line before the first pose that the joints cannot reach continuously: the end of
// the reach, or a joint limit. Translation and rotation have a line each, from where they are towards their goals; if
// one of them has ended, the other continues. The boundary is not followed. A singular pose with a path through it is
// not an end (motion.hpp).
//
// In every tick the pose is checked at which the tool could come to rest, with a margin of 1 mm and 2 mrad. At the
// distance d before the last reachable pose, less the margin, the speed is at most
//   v = d/τ for d <= a τ²,  √(2 a (d - a τ²/2)) beyond
// where the deceleration a is such that the joints can brake along with the tool in its present pose. Towards the end of
// the reach a joint moves ever faster (the angle of an elbow that straightens changes with √d), and a decreases. Before
// a singular pose that is not an end, the tool slows down as far as the joint speeds require. All joints brake together,
// so no line ends sooner than the slowest joint or the other line, and before a joint limit the tool slows down even where
// its path turns back. Poses are checked only if a
// limit or a singular pose may be within the stopping distance. Arms with fewer than six joints have no free choice of
// pose, so their lines are not limited here. Pure; allocates nothing.

#include "slave/command/goal_limiter.hpp"
#include "slave/config/command_config.hpp"
#include "slave/kinematics/inverse.hpp"

namespace longreach {

class CommandedLine : public ReachLimit {
 public:
  /// `inverse` must outlive this object.
  CommandedLine(const Inverse& inverse, const RobotConfig& robot, const CommandConfig& command);

  void configure(const CommandConfig& command) { command_ = command; }

  /// Starts a tick with these joints at the setpoint.
  void begin(const JointVector& joint_rad) {
    joint_rad_ = joint_rad;
    ended_ = slowed_ = false;
  }
  /// Sets the conditioning of the joints (joint_step.hpp); 0 if it is not known.
  void see(double conditioning) { conditioning_ = conditioning; }
  Twist limit(const Pose& X_WE, const Twist& before, const Twist& wanted, double dt) override;
  [[nodiscard]] bool ended() const override { return ended_; }
  /// What ended the line when ended() was last true.
  [[nodiscard]] const ReachEnd& end() const { return end_; }
  /// True if the velocity was reduced in this tick because joints could not move fast enough.
  [[nodiscard]] bool slowed() const { return slowed_; }
  [[nodiscard]] bool applies() const { return applies_; }

 private:
  struct Line;
  [[nodiscard]] bool reaches(const Pose& X_WE, const Vector3& way_m, const Vector3& way_rad);
  [[nodiscard]] JointVector joints_per_speed(const JointVector& joint_rad, const Line& line) const;
  void limit_braking(Line& line) const;
  void brake_joints(Line& linear, Line& angular, double dt);
  [[nodiscard]] Vector3 slow_down(const Pose& X_WE, const Line& line);
  [[nodiscard]] bool near(double way_m, double way_rad) const;
  [[nodiscard]] Vector3 shorten(const Pose& X_WE, const Line& line, const Vector3& other_way);

  const Inverse& inverse_;
  CommandConfig command_;
  JointVector joint_rad_ = JointVector::Zero();
  double conditioning_ = 0.0;
  JointVector joint_min_rad_ = JointVector::Zero(), joint_max_rad_ = JointVector::Zero();
  JointVector joint_speed_ = JointVector::Zero();
  JointVector joint_acceleration_ = JointVector::Zero();
  ReachEnd end_{};
  bool ended_ = false, slowed_ = false;
  bool holds_place_ = false;  // the translation, not the rotation, was to stand last
  bool applies_;
};

}  // namespace longreach
