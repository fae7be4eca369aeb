#pragma once
// Joint angles for a tool pose from nearby joint angles, by damped least squares
//   (JᵀJ + (|e|² + μ) I) Δq = Jᵀ e,   e = [L log(R_goal Rᵀ); p_goal - p]
// with L (Kinematics::motion_length_m) making radians and metres comparable, damping |e|² that vanishes at
// the solution (Sugihara 2011: quadratic convergence), and μ that rises near singular poses and after an
// unsuccessful step (Levenberg). Joint limits are respected by projection. One run finds only a solution of
// its own branch; a search restarts from a fixed sequence of starts until it has found a solution, first from
// those whose tools are nearest to the goal.

#include <array>
#include <cstdint>

#include "slave/kinematics/kinematics.hpp"

namespace longreach {

struct InverseTolerance {
  double residual_m = 1e-10;          // |e| at which the iteration ends, m
  std::uint32_t iterations_max = 20;  // steps per run, at least 1
  std::uint32_t restarts_max = 0;     // further runs if the first one fails
};

struct NumericResult {
  bool found = false;                           // within the tolerance; otherwise the nearest result
  JointVector joint_rad = JointVector::Zero();  // within the joint limits; finite if the start was
  RigidKinematics tool{};                       // of joint_rad
  double residual_m = 0.0;                      // |e| of joint_rad
  bool at_joint_limit = false;                  // limited by a joint limit
  std::uint32_t iterations = 0;
};

class NumericInverse {
 public:
  explicit NumericInverse(const RobotConfig& robot);

  /// `start_rad`: within the joint limits, finite. For a goal that is not finite it returns the start.
  [[nodiscard]] NumericResult solve(const Rigid& X_WE_goal, const JointVector& start_rad,
                                    const InverseTolerance& tolerance) const;

  /// One run of the search; its iteration ignores the limits of joints that can make a whole turn.
  [[nodiscard]] NumericResult search_once(const Rigid& X_WE_goal, const JointVector& start_rad,
                                          const InverseTolerance& tolerance) const;

  /// The `number`-th start of a search, from 1.
  [[nodiscard]] JointVector start(std::uint32_t number) const;

  [[nodiscard]] const Kinematics& kinematics() const { return kinematics_; }
  [[nodiscard]] const JointVector& min_rad() const { return min_rad_; }
  [[nodiscard]] const JointVector& max_rad() const { return max_rad_; }
  /// An angle: a whole turn makes no difference.
  [[nodiscard]] bool turns(int joint) const { return turns_[static_cast<std::size_t>(joint)]; }

 private:
  struct Run;
  static constexpr std::uint32_t kKnownStarts = 128;  // starts whose tool poses are stored
  using Place = Eigen::Matrix<double, 1, 12>;  // of a tool: rotation matrix times a length, position; m

  [[nodiscard]] Place place_m(const Rigid& X_WE) const;

  Kinematics kinematics_;
  JointVector min_rad_;
  JointVector max_rad_;
  std::array<bool, kMaxJoints> turns_{};
  Eigen::Matrix<double, kKnownStarts, 12> start_place_m_;
  Eigen::Array<double, kKnownStarts, 1> start_square_m2_;
};

}  // namespace longreach
