#include "tests/property/inverse_judge.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>

namespace longreach::test {
namespace {

// What is wrong with the solutions at the pose of `q`: each is one, and one of them is `q` unless the pose
// leaves an angle free. Nothing if they are right.
std::string complaint(const RobotConfig& robot, const Inverse& inverse, const JointVector& q,
                      const JointVector& near, bool regular, Score& score) {
  const double reach = inverse.kinematics().reach_m();
  const Pose goal = inverse.kinematics().forward(q);
  const InverseSolutions all = inverse.all(goal, near, {});
  if (all.count == 0) return "no solution";
  if (all.count > (regular ? 8 : InverseSolutions::kMax)) return "too many solutions";
  double nearest = 10.0, least_way = std::numeric_limits<double>::infinity();
  for (int i = 0; i < all.count; ++i) {
    const JointVector& solution = all.joint_rad[static_cast<std::size_t>(i)];
    const double error = exact_error(robot, solution, goal, reach);
    if (!(error <= kError)) return "error of " + std::to_string(1e15 * error) + "e-15";
    score.worst = std::max(score.worst, error);
    nearest = std::min(nearest, apart(solution, q));
    least_way = std::min(least_way, (solution - near).norm());
  }
  if (regular && nearest > 1e-4) return "misses the joints that it comes from";
  score.solutions += all.count;
  const InverseResult one = inverse.solve(goal, near, {});
  if (one.status == InverseStatus::kNearest) return "not the one that it is asked for";
  if (!(exact_error(robot, one.joint_rad, goal, reach) <= kError)) return "the one is not exact";
  if (regular && (one.joint_rad - near).norm() > least_way + 1e-6) return "the one is not the nearest";
  return "";
}

}  // namespace

void judge(const NamedArm& arm, const Inverse& inverse, const JointVector& q, const JointVector& near,
           bool regular, Score& score) {
  constexpr long kShown = 10;
  const std::string wrong = complaint(arm.robot, inverse, q, near, regular, score);
  ++score.poses;
  if (wrong.empty() || ++score.failed > kShown) return;
  ADD_FAILURE() << arm.name << " at " << q.transpose().format(Eigen::IOFormat(Eigen::FullPrecision)) << ": "
                << wrong;
}

void print(const std::string& name, const Score& score) {
  std::printf("%s: %ld poses, %ld failed, %.2f solutions each, error at most %.2g\n", name.c_str(),
              score.poses, score.failed,
              static_cast<double>(score.solutions) / static_cast<double>(score.poses), score.worst);
  EXPECT_EQ(score.failed, 0) << name;
}

bool make_singular(const Kinematics& kinematics, int i, JointVector& q) {
  const auto determinant = [&](double x) {
    JointVector at = q;
    at[i] = x;
    Jacobian J = kinematics.rigid_with_jacobian(at).J;
    J.topRows<3>() *= kinematics.reach_m();
    return J.determinant();
  };
  constexpr double kStep = 0.05;
  double low = q[i], f_low = determinant(low);
  for (int n = 0; n < 130; ++n, low += kStep) {
    double high = low + kStep;
    const double f_high = determinant(high);
    if ((f_low < 0.0) != (f_high < 0.0)) {
      for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        ((determinant(middle) < 0.0) == (f_low < 0.0) ? low : high) = middle;
      }
      q[i] = low;
      return true;
    }
    f_low = f_high;
  }
  return false;
}

double beside(Random& random) {
  const int exponent = static_cast<int>(random.next() % 16);
  if (exponent < 3) return 0.0;
  return (random.chance(0.5) ? 1.0 : -1.0) * std::pow(10.0, -exponent);
}

}  // namespace longreach::test
