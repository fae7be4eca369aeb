// Forward and inverse kinematics of an installed robot, a UR5e: tool at zero angles, all solutions, the nearest one.
#include <algorithm>
#include <cstdio>
#include <longreach/robot_arm.hpp>

int main() {
  const longreach::RobotArm arm("ur5e");
  const Eigen::Vector3d zero_m = arm.forward(Eigen::VectorXd::Zero(6)).translation();
  std::printf("tool at zero %.4f %.4f %.4f m\n", zero_m.x(), zero_m.y(), zero_m.z());

  Eigen::VectorXd joints(6);
  joints << 0.3, -1.2, 1.5, -0.8, 0.7, 0.2;
  const Eigen::Isometry3d X_WE = arm.forward(joints);
  double error_m = 0.0;
  const auto all = arm.inverse_all(X_WE, joints);
  for (const Eigen::VectorXd& solution : all)
    error_m = std::max(error_m, (arm.forward(solution).translation() - X_WE.translation()).norm());
  std::printf("%zu solutions, within %.0e m\n", all.size(), error_m);

  const longreach::ArmSolution nearest =
      arm.inverse_nearest(X_WE, joints + Eigen::VectorXd::Constant(6, 0.05));
  std::printf("nearest: %.1e rad from the joints\n", (nearest.joints - joints).norm());
  const Eigen::VectorXd twist = arm.jacobian(joints) * Eigen::VectorXd::Unit(6, 0);
  std::printf("first axis: %.3f rad/s about z\n", twist[2]);
}
