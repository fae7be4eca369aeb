#pragma once
// Inverse kinematics of the slave: joint angles for a tool pose. It uses the closed form if the arm has one
// (closed_inverse.hpp), linear equations for a Cartesian robot, and a numeric search otherwise.
//
// Each solution of the closed form is checked with the exact kinematics and improved by Newton steps until
// the tool is within Refinement::kExact of the goal (rad, and multiples of the reach). For an arm that has
// the closed form only approximately, such as a calibrated arm, the solutions of that form are the starting
// points of the Newton steps. Each angle is shifted by full turns to be nearest to the measured angle, and
// the preferred solution within the joint limits is chosen. If there is none, the damped iteration of
// numeric_inverse.hpp moves to the nearest pose within the limits.
//
//   kFound     the tool reaches the goal
//   kSingular  the tool reaches the goal, but cannot move from there in the direction `lost`
//   kNearest   the goal is out of reach, or reachable only beyond joint limits; the errors give the deviation
//
// A search (restarts_max > 0) never returns kNearest if all() lists a solution within the limits. A robot
// without a wrist (Cartesian) ignores the rotation of the goal and reports that in `rotation_ignored`.

#include <cstdint>
#include <string_view>

#include "slave/kinematics/closed_inverse.hpp"
#include "slave/kinematics/numeric_inverse.hpp"
#include "slave/kinematics/refinement.hpp"

namespace longreach {

enum class InverseStatus : std::uint8_t { kFound, kNearest, kSingular };

constexpr std::string_view to_string(InverseStatus status) {
  return status == InverseStatus::kFound     ? "FOUND"
         : status == InverseStatus::kNearest ? "NEAREST"
                                             : "SINGULAR";
}

struct InverseResult {
  InverseStatus status = InverseStatus::kNearest;
  /// Within the joint limits; finite if the start of the search was finite.
  JointVector joint_rad = JointVector::Zero();
  Pose X_WE{};                    // pose of the tool at joint_rad
  double position_error_m = 0.0;  // distance of X_WE from the goal
  double rotation_error_rad = 0.0;
  double conditioning = 0.0;  // 0 at a singular pose, about 0.3 at a well-conditioned one (joint_step.hpp)
  /// If kSingular, the unit vector [angular times length; linear] of the lost direction; otherwise zero.
  Vector6 lost = Vector6::Zero();
  bool at_joint_limit = false;  // a joint limit prevented a better result
  bool rotation_ignored = false;
  std::uint32_t iterations = 0;  // iterations of the numeric inverse
};

/// Permitted deviation of the tool from its path where the joints turn at a singular pose, as a share of the motion
/// length.
constexpr double kSingularAside = 5e-3;

/// Why the joints cannot move continuously to a pose.
struct ReachEnd {
  bool ends = false;   // false: they can, or a singular pose is in between
  int joint = 0;       // joint at its limit, from 1; 0: the end of the reach
  bool upper = false;  // its upper limit
};

/// All solutions for one pose, regardless of joint limits, with each angle shifted by full turns to be
/// nearest to the previous angle.
struct InverseSolutions {
  static constexpr int kMax = 16;  // maximum for any arm with six revolute joints (Primrose 1986)
  int count = 0;
  std::array<JointVector, kMax> joint_rad;
};

class Inverse {
 public:
  static constexpr double kSingular = 1e-7;  // conditioning below which a direction is considered lost

  explicit Inverse(const RobotConfig& robot);

  /// Returns the joint angles for a goal. `near_rad` is the start of the search and must be finite;
  /// `tolerance` applies to the numeric inverse. If the goal is not finite, returns `near_rad` and kNearest.
  [[nodiscard]] InverseResult solve(const Pose& X_WE_goal, const JointVector& near_rad,
                                    const InverseTolerance& tolerance) const;

  /// Like solve, for a goal one tick ahead. If the solution is farther away than a joint can move (another
  /// branch, or the other side of a singular pose), the damped iteration approaches it instead of jumping to
  /// it.
  [[nodiscard]] InverseResult follow(const Pose& X_WE_goal, const JointVector& joint_rad,
                                     const InverseTolerance& tolerance) const;

  /// Returns whether the joints can move from `joint_rad` (finite, within the limits) to the pose `X_WE`, which is up to
  /// some cm away, on the present branch, or on another one to which they can turn at a singular pose while the tool
  /// stays on its path (kSingularAside); if not, why.
  [[nodiscard]] ReachEnd reach_end(const Pose& X_WE, const JointVector& joint_rad,
                                   const InverseTolerance& tolerance) const;

  /// Returns by how much the tool is farther from the goal on the straight joint path `way_rad` than at its start, at
  /// most, m; the distance of two poses is √((L φ)² + |Δp|²) with the motion length L.
  [[nodiscard]] double aside_m(const Rigid& X_WE_goal, const JointVector& from_rad,
                               const JointVector& way_rad) const;

  /// Returns all solutions of the closed form. If the arm has no closed form, returns those that
  /// `tolerance.restarts_max` runs of the search find.
  [[nodiscard]] InverseSolutions all(const Pose& X_WE_goal, const JointVector& near_rad,
                                     const InverseTolerance& tolerance) const;

  /// Returns a description of the kind of inverse kinematics.
  [[nodiscard]] std::string_view words() const;
  [[nodiscard]] const Kinematics& kinematics() const { return numeric_.kinematics(); }
  [[nodiscard]] const ClosedInverse& closed() const { return closed_; }
  /// Returns the least distance of a joint from its limits, rad or m; fixed joints do not count.
  [[nodiscard]] double room_rad(const JointVector& joint_rad) const;
  /// Returns the first joint that is at most `slack_rad` from a limit; ends is true in any case.
  [[nodiscard]] ReachEnd limit_of(const JointVector& joint_rad, double slack_rad = 0.0) const;
  [[nodiscard]] bool cartesian() const { return cartesian_; }  // three prismatic joints, the others fixed

 private:
  [[nodiscard]] bool choose(const Rigid& goal, const JointVector& near_rad, Placed& placed) const;
  [[nodiscard]] bool stay(const Rigid& goal, const JointVector& near_rad, Placed& placed) const;
  [[nodiscard]] bool inside(const JointVector& joint_rad, double slack_rad) const;
  [[nodiscard]] Placed limited(const Rigid& goal, const JointVector& joint_rad) const;
  [[nodiscard]] bool reach(const Rigid& goal, const JointVector& joint_rad, Placed& placed) const;
  [[nodiscard]] double slack_rad() const;
  [[nodiscard]] bool place(const JointVector& solution, JointVector& placed) const;
  [[nodiscard]] bool choose_exact(const Pose& X_WE_goal, const JointVector& near_rad,
                                  const InverseTolerance& tolerance, Placed& placed) const;
  [[nodiscard]] double cost(const JointVector& joint_rad, const JointVector& near_rad) const;
  [[nodiscard]] InverseResult report(const Placed& placed, double enough_m) const;
  [[nodiscard]] InverseResult iterate(const Rigid& goal, const JointVector& near_rad,
                                      const InverseTolerance& tolerance) const;
  [[nodiscard]] InverseResult slide(const Rigid& goal, const JointVector& near_rad) const;

  NumericInverse numeric_;
  ClosedInverse closed_;
  BranchPreference prefer_;
  JointVector per_speed_s_;               // 1 / speed limit, s/rad
  std::array<bool, kMaxJoints> moves_{};  // the joint is not fixed
  bool cartesian_ = false;
  std::array<int, 3> slider_{};  // indices of the prismatic joints
  /// Maps a displacement of the tool (m) to displacements of the prismatic joints (m).
  Matrix3 from_position_ = Matrix3::Zero();
};

}  // namespace longreach
