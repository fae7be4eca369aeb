// An arm as its calibration describes it: axes that are nearly parallel, and lengths of hundreds of metres
// in its rows.

#include <gtest/gtest.h>

#include <cmath>

#include "common/core/random.hpp"
#include "slave/kinematics/inverse.hpp"

namespace longreach::calibrated_arm_test {
namespace {

/// Figures of one UR5e, rounded; a, alpha, d, theta.
RobotConfig calibrated() {
  constexpr double kRows[6][4] = {{-0.00035302, 1.572600977, 0.1627014635, -0.001834915538},
                                  {0.3142236113, 0.002128944091, 133.9378327, 2.40418458},
                                  {0.3598208707, 0.0002997149165, 391.321015, 0.326978139},
                                  {0.0001358973979, 1.570969842, -525.1255949, -2.731633496},
                                  {-5.405128334e-05, 1.571463371, 0.09872171145, 3.141290926},
                                  {-0.0004272738576, 0.001305903337, -0.2958709501, -2.280435631}};
  RobotConfig robot;
  for (std::size_t i = 0; i < kMaxJoints; ++i) {
    JointConfig& j = robot.joint[i];
    j.a_m = kRows[i][0], j.alpha_rad = kRows[i][1], j.d_m = kRows[i][2], j.theta_rad = kRows[i][3];
    j.min_rad = -6.28, j.max_rad = 6.28;
  }
  return robot;
}

/// Straight from the table.
Pose by_rows(const RobotConfig& robot, const JointVector& q) {
  Eigen::Matrix<long double, 4, 4> X = Eigen::Matrix<long double, 4, 4>::Identity();
  for (int i = 0; i < kMaxJoints; ++i) {
    const JointConfig& j = robot.joint[static_cast<std::size_t>(i)];
    const long double t = q[i] + j.theta_rad, c = std::cos(t), s = std::sin(t);
    const long double ca = std::cos(static_cast<long double>(j.alpha_rad)),
                      sa = std::sin(static_cast<long double>(j.alpha_rad));
    Eigen::Matrix<long double, 4, 4> A;
    A << c, -s * ca, s * sa, j.a_m * c, s, c * ca, -c * sa, j.a_m * s, 0, sa, ca, j.d_m, 0, 0, 0, 1;
    X = X * A;
  }
  const Matrix3 R = X.topLeftCorner<3, 3>().cast<double>();
  return {X.topRightCorner<3, 1>().cast<double>(), Quaternion(R).normalized()};
}

JointVector draw(Random& random) {
  JointVector q;
  for (double& x : q) x = 6.0 * random.uniform() - 3.0;
  return q;
}

TEST(CalibratedArm, IsPlacedAsItsRowsSay) {
  const RobotConfig robot = calibrated();
  const Kinematics kinematics(robot);
  EXPECT_LT(kinematics.reach_m(), 2.0) << "no length is much greater than the arm";
  Random random(1);
  for (int n = 0; n < 1000; ++n) {
    const JointVector q = draw(random);
    const Pose mine = kinematics.forward(q), table = by_rows(robot, q);
    ASSERT_LT((mine.p - table.p).norm(), 1e-12) << "1e-15 of the lengths in its rows";
    ASSERT_LT(mine.q.angularDistance(table.q), 1e-7);
  }
}

TEST(CalibratedArm, IsSolvedFromTheClosedFormOfANearlyEqualOne) {
  const Inverse inverse(calibrated());
  EXPECT_EQ(inverse.words(),
            "closed form of a similar arm, then Newton steps, quadratic: axes 2-3-4 parallel");
  Random random(2);
  int solutions = 0, missed = 0;
  for (int n = 0; n < 1000; ++n) {
    const JointVector q = draw(random);
    const Pose goal = inverse.kinematics().forward(q);
    const InverseResult result = inverse.solve(goal, q + 0.1 * JointVector::Ones(), {1e-12, 100, 20});
    ASSERT_NE(result.status, InverseStatus::kNearest) << q.transpose();
    ASSERT_LT(result.position_error_m, 1e-9);
    ASSERT_LT(result.rotation_error_rad, 1e-9);
    const InverseSolutions all = inverse.all(goal, q, {});
    solutions += all.count;
    bool found = false;
    for (int i = 0; i < all.count; ++i)
      found = found || (all.joint_rad[static_cast<std::size_t>(i)] - q).cwiseAbs().maxCoeff() < 1e-6;
    missed += !found;
  }
  EXPECT_GT(solutions, 4000) << "of about eight, as far as they are within reach";
  EXPECT_LE(missed, 20) << "beside poses that are singular for one of the two arms";
}

}  // namespace
}  // namespace longreach::calibrated_arm_test
