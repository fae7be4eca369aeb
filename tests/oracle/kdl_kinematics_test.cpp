// Forward kinematics, Jacobian and every solution of the inverse against KDL.

#include <gtest/gtest.h>

#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainjnttojacsolver.hpp>

#include "deploy/lab/campaign_size.hpp"
#include "deploy/lab/robot/random_arm.hpp"
#include "tests/oracle/kdl_chain.hpp"

namespace longreach::kdl_kinematics_test {
namespace {

struct KdlArm {
  explicit KdlArm(const RobotConfig& robot)
      : chain(oracle::kdl_chain(robot)), position(chain), velocity(chain) {}

  Rigid forward(const JointVector& q) {
    KDL::Frame frame;
    EXPECT_GE(position.JntToCart(oracle::kdl_joints(q), frame), 0);
    Rigid X;
    for (int i = 0; i < 3; ++i) {
      X.p[i] = frame.p[i];
      for (int k = 0; k < 3; ++k) X.R(i, k) = frame.M(i, k);
    }
    return X;
  }

  Jacobian jacobian(const JointVector& q) {
    KDL::Jacobian linear_first(kMaxJoints);
    EXPECT_GE(velocity.JntToJac(oracle::kdl_joints(q), linear_first), 0);
    Jacobian J;
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < kMaxJoints; ++k) {
        J(i, k) = linear_first(static_cast<unsigned>(i) + 3, static_cast<unsigned>(k));
        J(i + 3, k) = linear_first(static_cast<unsigned>(i), static_cast<unsigned>(k));
      }
    }
    return J;
  }

  KDL::Chain chain;
  KDL::ChainFkSolverPos_recursive position;
  KDL::ChainJntToJacSolver velocity;
};

std::vector<test::NamedArm> arms() {
  std::vector<test::NamedArm> all = test::ready_arms();
  Random random(31);
  for (int n = 0; n < 4; ++n) {
    all.push_back({"any arm " + std::to_string(n), test::random_arm(random)});
    all.back().robot.convention = n % 2 == 0 ? DhConvention::kStandard : DhConvention::kModified;
  }
  // The UR10 and a spherical wrist in the other convention.
  all.push_back({"parallel, modified", test::random_arm(random, ArmFamily::kParallel, 1)});
  all.push_back({"meeting, modified", test::random_arm(random, ArmFamily::kSpherical, 2)});
  for (std::size_t n = all.size() - 2; n < all.size(); ++n) {
    // Behind a joint in one convention, before the next in the other.
    RobotConfig& robot = all[n].robot;
    robot.convention = DhConvention::kModified;
    for (std::size_t i = kMaxJoints - 1; i > 0; --i) {
      robot.joint[i].a_m = robot.joint[i - 1].a_m;
      robot.joint[i].alpha_rad = robot.joint[i - 1].alpha_rad;
    }
  }
  return all;
}

TEST(Kdl, AgreesAboutForwardKinematicsAndJacobian) {
  for (const test::NamedArm& arm : arms()) {
    const Kinematics kinematics(arm.robot);
    KdlArm kdl(arm.robot);
    Random random = Random(32).child(arm.name);
    double worst = 0.0;
    for (int n = campaign(100'000, 1'000); n > 0; --n) {
      const JointVector q = test::random_joints(random, 6.0);
      const Rigid X = kdl.forward(q);
      const RigidKinematics ours = kinematics.rigid_with_jacobian(q);
      const Pose pose = kinematics.forward(q);
      worst = std::max({worst, (ours.X_WE.p - X.p).cwiseAbs().maxCoeff(),
                        (ours.X_WE.R - X.R).cwiseAbs().maxCoeff(), (pose.p - X.p).cwiseAbs().maxCoeff(),
                        (pose.q.toRotationMatrix() - X.R).cwiseAbs().maxCoeff()});
      ASSERT_LE(worst, 1e-12) << arm.name << " at " << q.transpose();
      ASSERT_LE((ours.J - kdl.jacobian(q)).cwiseAbs().maxCoeff(), 1e-12)
          << arm.name << " at " << q.transpose();
    }
    std::printf("%s: differs by at most %.2g\n", arm.name.c_str(), worst);
  }
}

TEST(Kdl, ReachesTheGoalWithEverySolution) {
  for (const test::NamedArm& arm : arms()) {
    const Inverse inverse(arm.robot);
    if (!inverse.closed().applies()) continue;
    KdlArm kdl(arm.robot);
    const double reach = inverse.kinematics().reach_m();
    Random random = Random(33).child(arm.name);
    double worst = 0.0;
    for (int n = campaign(100'000, 1'000); n > 0; --n) {
      const JointVector q = test::random_joints(random);
      const Pose goal = inverse.kinematics().forward(q);
      const Matrix3 R = goal.q.toRotationMatrix();
      const InverseSolutions all = inverse.all(goal, q, {});
      ASSERT_GT(all.count, 0) << arm.name << " at " << q.transpose();
      for (int i = 0; i < all.count; ++i) {
        const Rigid X = kdl.forward(all.joint_rad[static_cast<std::size_t>(i)]);
        const double error = std::max(rotation_between(X.R, R).norm(), (X.p - goal.p).norm() / reach);
        ASSERT_LE(error, 1e-14) << arm.name << " at " << q.transpose();
        worst = std::max(worst, error);
      }
    }
    std::printf("%s: error at most %.2g\n", arm.name.c_str(), worst);
  }
}

}  // namespace
}  // namespace longreach::kdl_kinematics_test
