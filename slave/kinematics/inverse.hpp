#pragma once
// Joint angles for a tool pose: the inverse kinematics of the slave. Closed form if the arm has one
// (closed_inverse.hpp), linear for a Cartesian robot, numeric search otherwise.
//
// An arm that is nearly one with a closed form, as calibrated rows describe it, is solved by that form, too:
// its solutions are where the Newton steps begin.
// Each solution of the closed form is checked with the exact kinematics and improved by Newton steps until
// the tool is within Refinement::kExact of the goal (rad, and share of the reach). Of those within the joint
// limits, with each angle on the turn nearest to the measured joints, the preferred one is chosen. If there
// is none, the damped iteration of numeric_inverse.hpp moves to the nearest pose within the limits.
//
// kFound     the tool reaches the goal
// kSingular  the tool reaches the goal, but cannot move from there in the direction `lost`
// kNearest   the goal is out of reach, or only beyond joint limits; the errors give the deviation. A search
//            (restarts_max > 0) never returns this while all() lists a solution within the limits
// A robot without a wrist (Cartesian) ignores the rotation of the goal and reports that in
// `rotation_ignored`.

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
  JointVector joint_rad = JointVector::Zero();  // within the joint limits; finite if `near_rad` was
  Pose X_WE{};                                  // of joint_rad
  double position_error_m = 0.0;                // of X_WE from the goal
  double rotation_error_rad = 0.0;
  double conditioning = 0.0;       // joint_step.hpp: 0 at a singular pose, about 0.3 at a good one
  Vector6 lost = Vector6::Zero();  // kSingular: unit vector [angular times length; linear]; otherwise zero
  bool at_joint_limit = false;     // limited by a joint limit
  bool rotation_ignored = false;
  std::uint32_t iterations = 0;  // of the numeric inverse
};

/// All solutions for one pose, regardless of joint limits, each angle on the turn nearest to the previous
/// joints.
struct InverseSolutions {
  static constexpr int kMax = 16;  // maximum for any arm with six revolute joints (Primrose 1986)
  int count = 0;
  std::array<JointVector, kMax> joint_rad;
};

class Inverse {
 public:
  static constexpr double kSingular = 1e-7;  // conditioning below which a direction is lost

  explicit Inverse(const RobotConfig& robot);

  /// `near_rad`: finite start of the search. `tolerance` is for the numeric inverse. For a goal that is not
  /// finite it returns `near_rad` and kNearest.
  [[nodiscard]] InverseResult solve(const Pose& X_WE_goal, const JointVector& near_rad,
                                    const InverseTolerance& tolerance) const;

  /// Like solve, for a goal one tick ahead: a solution farther away than a joint can move (another branch, or
  /// the other side of a singular pose) is not jumped to but approached by the damped iteration.
  [[nodiscard]] InverseResult follow(const Pose& X_WE_goal, const JointVector& joint_rad,
                                     const InverseTolerance& tolerance) const;

  /// All solutions in closed form; otherwise those that `tolerance.restarts_max` runs of the search find.
  [[nodiscard]] InverseSolutions all(const Pose& X_WE_goal, const JointVector& near_rad,
                                     const InverseTolerance& tolerance) const;

  /// Description of the kind of inverse.
  [[nodiscard]] std::string_view words() const;
  [[nodiscard]] const Kinematics& kinematics() const { return numeric_.kinematics(); }
  [[nodiscard]] const ClosedInverse& closed() const { return closed_; }

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
  JointVector per_speed_s_;                  // 1 / speed limit, s/rad
  bool cartesian_ = false;                   // three prismatic joints, the others fixed
  std::array<int, 3> slider_{};              // which
  Matrix3 from_position_ = Matrix3::Zero();  // m of the sliders per m of the tool
};

}  // namespace longreach
