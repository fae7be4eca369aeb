// One arm in several Denavit-Hartenberg tables, and on several bases, gives the same results.

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "deploy/lab/robot/random_arm.hpp"
#include "slave/command/motion.hpp"
#include "slave/kinematics/joint_step.hpp"

namespace longreach::same_arm_test {
namespace {

using namespace test;

constexpr double kPi = 2.0 * kHalfPi;

/// The same arm, said otherwise: joint i counts q' = sign q + offset, and the base is raised.
struct Form {
  std::string name;
  RobotConfig robot;
  JointVector sign = JointVector::Ones(), offset_rad = JointVector::Zero();
  double raised_m = 0.0;

  [[nodiscard]] JointVector to(const JointVector& q) const { return sign.cwiseProduct(q) + offset_rad; }
  [[nodiscard]] JointVector from(const JointVector& q) const { return sign.cwiseProduct(q - offset_rad); }
  [[nodiscard]] Pose moved(Pose X) const {
    X.p.z() += raised_m;
    return X;
  }
};

void restate_limits(Form& form, const RobotConfig& robot) {
  for (std::size_t i = 0; i < kMaxJoints; ++i) {
    const auto n = static_cast<int>(i);
    const JointConfig& j = robot.joint[i];
    const double a = form.sign[n] * j.min_rad + form.offset_rad[n],
                 b = form.sign[n] * j.max_rad + form.offset_rad[n];
    JointConfig& k = form.robot.joint[i];
    k.min_rad = std::min(a, b), k.max_rad = std::max(a, b);
    k.start_rad = form.sign[n] * j.start_rad + form.offset_rad[n];
  }
}

/// `parallel`: axes 2, 3 and 4 are.
std::vector<Form> forms(const RobotConfig& robot, bool parallel) {
  Form high{"high base", robot};
  high.robot.joint[0].d_m += high.raised_m = 4.0;
  Form low{"low base", robot};
  low.robot.joint[0].d_m += low.raised_m = -60.0;
  Form turned{"other zeros of the angles", robot};
  for (int i = 0; i < kMaxJoints; ++i) {
    turned.offset_rad[i] = 0.3 * (i + 1);
    turned.robot.joint[static_cast<std::size_t>(i)].theta_rad -= turned.offset_rad[i];
  }
  // Rz(q + θ) Tz(d) = Rx(π) Rz(-q - θ) Tz(-d) Rx(π)
  Form flipped{"an axis the other way round", robot};
  flipped.sign[3] = -1.0;
  flipped.robot.joint[2].alpha_rad += kPi;
  flipped.robot.joint[3].theta_rad *= -1.0;
  flipped.robot.joint[3].d_m *= -1.0;
  flipped.robot.joint[3].alpha_rad += kPi;
  // Of the row before, a and α; those of the last row are the tool's.
  Form modified{"modified", robot};
  modified.robot.convention = DhConvention::kModified;
  for (std::size_t i = 0; i < kMaxJoints; ++i) {
    modified.robot.joint[i].a_m = i == 0 ? 0.0 : robot.joint[i - 1].a_m;
    modified.robot.joint[i].alpha_rad = i == 0 ? 0.0 : robot.joint[i - 1].alpha_rad;
  }
  const JointConfig& last = robot.joint[5];
  const Quaternion twist = exp_rotation({last.alpha_rad, 0.0, 0.0});
  modified.robot.tool.position_m = Vector3(last.a_m, 0.0, 0.0) + twist * robot.tool.position_m;
  modified.robot.tool.rotation_rad = log_rotation(twist * exp_rotation(robot.tool.rotation_rad));
  std::vector<Form> all{high, low, turned, flipped, modified};
  if (parallel) {
    Form apart{"offsets that cancel", robot};
    apart.robot.joint[1].d_m += 50.0;
    apart.robot.joint[2].d_m -= 20.0;
    apart.robot.joint[3].d_m -= 30.0;
    all.push_back(apart);
  }
  for (Form& form : all) restate_limits(form, robot);
  return all;
}

TEST(SameArm, InAnyTableHasTheSameSolutionsAndConditioning) {
  Random random(47);
  std::vector<std::pair<NamedArm, bool>> arms;
  for (const NamedArm& arm : ready_arms()) arms.emplace_back(arm, arm.name != "puma560");
  for (int i = 0; i < 3; ++i) arms.emplace_back(NamedArm{"random", random_arm(random)}, false);
  for (const auto& [arm, parallel] : arms) {
    const Inverse inverse(arm.robot);
    for (const Form& form : forms(arm.robot, parallel)) {
      SCOPED_TRACE(arm.name + ", " + form.name);
      const Inverse other(form.robot);
      const double length = inverse.kinematics().motion_length_m();
      EXPECT_NEAR(other.kinematics().motion_length_m(), length, 1e-10 * length);
      for (int n = 0; n < 200; ++n) {
        const JointVector q = random_joints(random), near = q + 0.1 * random_joints(random, 1.0);
        const Pose X = inverse.kinematics().forward(q);
        ASSERT_LT((other.kinematics().forward(form.to(q)).p - form.moved(X).p).norm(), 1e-11);
        const double good = conditioning(inverse.kinematics().rigid_with_jacobian(q).J, length);
        if (good < 0.01) continue;  // there rounding is magnified
        const InverseTolerance tolerance{1e-10, 60, 0};
        const InverseResult a = inverse.solve(X, near, tolerance),
                            b = other.solve(form.moved(X), form.to(near), tolerance);
        ASSERT_EQ(a.status, b.status);
        EXPECT_LT((a.joint_rad - form.from(b.joint_rad)).cwiseAbs().maxCoeff(), 1e-7);
        EXPECT_NEAR(a.conditioning, b.conditioning, 1e-7);
      }
    }
  }
}

/// Goals through a singular wrist, there and back; the joints at every tick.
struct Driven {
  std::vector<JointVector> joint_rad;
  std::vector<bool> singularity;
  std::uint64_t violations = 0;
};

Driven drive(const Form& form, const std::vector<Pose>& goals) {
  SlaveMotion motion({}, form.robot);
  Driven driven;
  for (const Pose& goal : goals) {
    driven.singularity.push_back(motion.step({form.moved(goal), {}, 1e-3}).singularity);
    driven.joint_rad.push_back(form.from(motion.joint_setpoint_rad()));
  }
  driven.violations = motion.limit_violations();
  return driven;
}

TEST(SameArm, OnAHighBaseMovesAsOnALowOne) {
  RobotConfig robot = ready_arms()[2].limited;  // ur10
  const double start[] = {0.0, -1.2, 1.6, -1.97, -0.25, 0.0};
  for (std::size_t i = 0; i < kMaxJoints; ++i) robot.joint[i].start_rad = start[i];
  Form plain{"as it is", robot};
  const Kinematics kinematics(robot);
  JointVector end = start_joints(robot);
  end[4] = 0.25;
  const Pose from = kinematics.forward(start_joints(robot)), to = kinematics.forward(end);
  std::vector<Pose> goals;
  for (int i = 0; i < 8000; ++i) {
    const double share = std::min(i / 4000.0, 1.0);
    goals.push_back({from.p + share * (to.p - from.p),
                     exp_rotation(share * log_rotation(to.q * from.q.conjugate())) * from.q});
  }
  const Driven one = drive(plain, goals);
  EXPECT_TRUE(std::find(one.singularity.begin(), one.singularity.end(), true) != one.singularity.end());
  for (const Form& form : forms(robot, true)) {
    const Driven other = drive(form, goals);
    EXPECT_NEAR(static_cast<double>(other.violations), static_cast<double>(one.violations), 2.0) << form.name;
    double worst = 0.0;
    int differ = 0;
    for (std::size_t i = 0; i < goals.size(); ++i) {
      worst = std::max(worst, (one.joint_rad[i] - other.joint_rad[i]).cwiseAbs().maxCoeff());
      differ += one.singularity[i] != other.singularity[i] ? 1 : 0;
    }
    EXPECT_LT(worst, 1e-4) << form.name;
    EXPECT_LE(differ, 2) << form.name;  // ticks at the edge of the band
  }
}

/// A UR5e as a calibration gives it: axes 2 to 4 are 0.8 mrad from parallel.
RobotConfig calibrated() {
  constexpr double rows[6][4] = {
      {-0.0003530198970029234, 1.572600976604981, 0.162701463453409, -0.0018349155383453556},
      {0.3142236113414998, 0.0021289440911159015, 133.93783274685794, 2.4041845794700105},
      {0.3598208707022262, 0.00029971491650953935, 391.3210156560581, 0.32697813895839223},
      {0.00013589739890845412, 1.5709698417257516, -525.1255949419626, -2.731633496214672},
      {-5.40512833377219e-05, 1.5714633712424082, 0.09872171145292098, 3.1412909260515427},
      {-0.0004272738575563784, 0.0013059033366860208, -0.2958709501448927, -2.2804356313104193}};
  RobotConfig robot;
  for (std::size_t i = 0; i < kMaxJoints; ++i) {
    JointConfig& j = robot.joint[i];
    j.a_m = rows[i][0], j.alpha_rad = rows[i][1], j.d_m = rows[i][2], j.theta_rad = rows[i][3];
  }
  return unlimited(robot);
}

TEST(SameArm, IsNeverAnsweredWithTheNearestWhileASolutionIsListed) {
  constexpr InverseTolerance kThorough{1e-12, 100, 200};
  Random random(4);
  std::vector<NamedArm> arms = ready_arms();
  arms.push_back({"calibrated", calibrated()});
  for (const NamedArm& arm : arms) {
    const Inverse inverse(arm.robot);
    int listed = 0, nearest = 0;
    for (int n = 0; n < 150; ++n) {
      const Pose goal = inverse.kinematics().forward(random_joints(random));
      // Also from joints that are several turns away.
      const JointVector near = random_joints(random, n % 3 == 0 ? 40.0 : 3.14);
      const int count = inverse.all(goal, near, kThorough).count;
      const InverseResult result = inverse.solve(goal, near, kThorough);
      listed += count > 0 ? 1 : 0;
      nearest += result.status == InverseStatus::kNearest ? 1 : 0;
      if (count > 0) {
        EXPECT_LT(result.position_error_m, 1e-9) << arm.name;
      }
    }
    EXPECT_EQ(nearest, 0) << arm.name;
    EXPECT_GE(listed, 149) << arm.name;
  }
}

}  // namespace
}  // namespace longreach::same_arm_test
