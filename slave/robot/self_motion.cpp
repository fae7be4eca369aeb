#include "slave/robot/self_motion.hpp"

#include "slave/robot/joint_step.hpp"

namespace longreach {

JointVector self_motion_step(const Kinematics& arm, const SelfMotion& from, const Rigid& X_WE_goal) {
  const double reach_m = arm.reach_m(), damping_m2 = from.lost * from.lost * reach_m * reach_m;
  const RigidKinematics tool = arm.rigid_with_jacobian(from.joint_rad);
  Jacobian J_m = tool.J;
  J_m.topRows<3>() *= reach_m;
  Vector6 e_m;
  e_m << reach_m * rotation_between(tool.X_WE.R, X_WE_goal.R), X_WE_goal.p - tool.X_WE.p;
  Matrix6 A = J_m.transpose() * J_m;
  A.diagonal().array() += damping_m2;
  JointVector b = J_m.transpose() * e_m + damping_m2 * from.pull_rad;

  const JointVector low = from.min_rad - from.joint_rad, high = from.max_rad - from.joint_rad;
  JointVector step = b;
  for (int stopped = 0; stopped <= kMaxJoints; ++stopped) {
    step = b;
    solve_symmetric(A, step);
    int worst = -1;
    double excess = 0.0;
    for (int i = 0; i < kMaxJoints; ++i) {
      const double beyond = std::max(step[i] - high[i], low[i] - step[i]);
      if (beyond > excess) worst = i, excess = beyond;
    }
    if (worst < 0) break;
    const double there = step[worst] > high[worst] ? high[worst] : low[worst];
    b -= A.col(worst) * there;
    A.row(worst).setZero();
    A.col(worst).setZero();
    A(worst, worst) = 1.0;
    b[worst] = there;
  }
  return (from.joint_rad + step).cwiseMax(from.min_rad).cwiseMin(from.max_rad);
}

}  // namespace longreach
