#pragma once
// Finds joint angles for a tool pose from nearby joint angles, by damped least squares
//   (JᵀJ + (|e|² + μ) I) Δq = Jᵀ e,   e = [L log(R_goal Rᵀ); p_goal - p]
// L (Kinematics::motion_length_m) makes radians and metres comparable. The damping |e|² vanishes at the
// solution (Sugihara 2011: quadratic convergence). μ rises near singular poses and after an unsuccessful step
// (Levenberg). Joint limits are respected by projection. One run finds only a solution on the branch of its
// start. A search therefore runs from a fixed sequence of starts until it finds a solution, beginning with
// starts whose tool pose is near the goal.

#include <array>
#include <cstdint>

#include "slave/kinematics/kinematics.hpp"

namespace longreach {

struct InverseTolerance {
  double residual_m = 1e-10;          // |e| below which the iteration ends, m
  std::uint32_t iterations_max = 20;  // steps per run, at least 1
  std::uint32_t restarts_max = 0;     // maximum number of further runs if the first one fails
};

struct NumericResult {
  bool found = false;  // true if within the tolerance; otherwise the result is the nearest pose
  /// Within the joint limits; finite if the start was finite.
  JointVector joint_rad = JointVector::Zero();
  RigidKinematics tool{};       // pose and Jacobian at joint_rad
  double residual_m = 0.0;      // |e| at joint_rad, m
  bool at_joint_limit = false;  // a joint limit prevented a better result
  std::uint32_t iterations = 0;
};

class NumericInverse {
 public:
  explicit NumericInverse(const RobotConfig& robot);

  /// Runs the iteration, or the search if `tolerance.restarts_max` > 0. `start_rad` must be finite and within
  /// the joint limits. If the goal is not finite, returns the start.
  [[nodiscard]] NumericResult solve(const Rigid& X_WE_goal, const JointVector& start_rad,
                                    const InverseTolerance& tolerance) const;

  /// Performs one run of the search. It ignores the limits of joints that can make a full turn.
  [[nodiscard]] NumericResult search_once(const Rigid& X_WE_goal, const JointVector& start_rad,
                                          const InverseTolerance& tolerance) const;

  /// Returns start number `number` of a search, counted from 1.
  [[nodiscard]] JointVector start(std::uint32_t number) const;

  [[nodiscard]] const Kinematics& kinematics() const { return kinematics_; }
  [[nodiscard]] const JointVector& min_rad() const { return min_rad_; }
  [[nodiscard]] const JointVector& max_rad() const { return max_rad_; }
  /// True if the joint is revolute, so that a full turn makes no difference.
  [[nodiscard]] bool turns(int joint) const { return turns_[static_cast<std::size_t>(joint)]; }

 private:
  struct Run;
  static constexpr std::uint32_t kKnownStarts = 128;  // number of starts whose tool poses are stored
  /// Coordinates of a tool pose for comparing distances: rotation matrix times a length, then position; m.
  using Place = Eigen::Matrix<double, 1, 12>;

  [[nodiscard]] Place place_m(const Rigid& X_WE) const;

  Kinematics kinematics_;
  JointVector min_rad_;
  JointVector max_rad_;
  std::array<bool, kMaxJoints> turns_{};
  Eigen::Matrix<double, kKnownStarts, 12> start_place_m_;
  Eigen::Array<double, kKnownStarts, 1> start_square_m2_;
};

}  // namespace longreach
