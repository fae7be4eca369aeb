// Poses of arms and devices from 1 mm to 20 m, at singular poses, with rotations by pi and with nothing to go
// by. The error of a pose is the larger of rad and share of the reach, in long double
// (deploy/lab/robot/random_arm).

#include <cmath>
#include <limits>
#include <numbers>

#include "common/config/config.hpp"
#include "common/text/number_text.hpp"
#include "deploy/lab/robot/random_arm.hpp"
#include "master/devices/delta/delta_kinematics.hpp"
#include "tests/extremes/extremes.hpp"

namespace longreach {
namespace {

constexpr double kPose = 1.2e-14;  // as tests/property holds it
constexpr double kPlace = 1e-3;    // weight of the rotation where the error of the place is asked for
constexpr double kDelta = 1e-13;   // of the device's size
constexpr double kTurn_rad = 1e-14;
constexpr double kNormal = std::numeric_limits<double>::min();  // below it numbers lose digits
constexpr double kPi = std::numbers::pi;

/// The arm with all its lengths multiplied.
RobotConfig scaled(RobotConfig robot, double factor) {
  for (JointConfig& joint : robot.joint) joint.a_m *= factor, joint.d_m *= factor;
  return robot;
}

/// `off_m`: how far the goal is from where it is said to be; of controls. `weight`: of rotation against
/// place.
ExtremeResult solved(const RobotConfig& robot, const Inverse& inverse, const JointVector& q, double off_m,
                     double weight, double& worst) {
  Pose goal = inverse.kinematics().forward(q);
  const InverseResult result = inverse.solve(goal, q, {});
  if (result.status == InverseStatus::kNearest) return bad("a pose that is reachable is not reached");
  goal.p.x() += off_m;
  const double reach_m = weight * inverse.kinematics().reach_m();
  worst = std::max(worst, weight * test::exact_error(robot, result.joint_rad, goal, reach_m));
  return accurate(worst, kPose);
}

ExtremeCell reach_cell(double reach_m, double off_m = 0.0) {
  return {short_text(reach_m) + " m", "", [reach_m, off_m](std::uint64_t seed) {
            ExtremeResult last;
            double worst = 0.0;
            for (const test::NamedArm& arm : test::ready_arms()) {
              const double factor = reach_m / Kinematics(arm.robot).reach_m();
              const RobotConfig robot = scaled(arm.robot, factor);
              const Inverse inverse(robot);
              Random random = Random(seed).child("extremes " + arm.name);
              for (int i = 0; i < 100; ++i) {
                last = solved(robot, inverse, test::random_joints(random), off_m, kPlace, worst);
                if (last.outcome == ExtremeOutcome::kBad) return last;
              }
            }
            return last;
          }};
}

/// Wrist (angle 5) and elbow (angle 3) at their singular angles, with any other angles.
ExtremeRow singular_row(const test::NamedArm& arm, double wrist_rad, double elbow_rad) {
  const auto cell = [&](const std::string& name, bool wrist, bool elbow, double off_m = 0.0) {
    return ExtremeCell{name, "", [=](std::uint64_t seed) {
                         const Inverse inverse(arm.robot);
                         Random random = Random(seed).child("extremes " + name);
                         ExtremeResult last;
                         double worst = 0.0;
                         for (int i = 0; i < 100; ++i) {
                           JointVector q = test::random_joints(random);
                           if (wrist) q[4] = wrist_rad;
                           if (elbow) q[2] = elbow_rad;
                           last = solved(arm.robot, inverse, q, off_m, 1.0, worst);
                           if (last.outcome == ExtremeOutcome::kBad) break;
                         }
                         return last;
                       }};
  };
  return {"arm: singular poses, " + arm.name,
          "error of the pose",
          cell("1 nm beside", true, true, 1e-9),
          {cell("wrist", true, false), cell("elbow", false, true), cell("both", true, true)}};
}

/// Goals that nobody can mean, and far ones: the joints stay finite and the answer says so.
ExtremeRow goal_row() {
  const auto cell = [](const std::string& name, const Pose& goal) {
    return ExtremeCell{name, "NEAREST", [goal](std::uint64_t) {
                         const Inverse inverse(test::ready_arms()[1].limited);
                         JointVector q = JointVector::Constant(0.3);
                         const InverseResult result = inverse.solve(goal, q, {});
                         if (!result.joint_rad.allFinite()) return bad("joints that are not finite");
                         if (result.status != InverseStatus::kNearest) return bad("found what is none");
                         return refused("NEAREST, the errors say by how much");
                       }};
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Pose there = Kinematics(test::ready_arms()[1].limited).forward(JointVector::Constant(0.3));
  return {"arm: goal that cannot be",
          "answered as the nearest",
          cell("one that can be", there),
          {cell("NaN", {{nan, 0.0, 0.0}, Quaternion::Identity()}),
           cell("1e300 m", {{1e300, 0.0, 0.0}, Quaternion::Identity()}),
           cell("20 m", {{20.0, 0.0, 0.0}, Quaternion::Identity()}),
           cell("q NaN", {{0.3, 0.2, 0.1}, Quaternion(nan, 0.0, 0.0, 0.0)})}};
}

/// `off`: share of the rods by which the inverse has others than the forward; of the control.
ExtremeResult delta_round_trip(double size_m, std::uint64_t seed, double off = 0.0) {
  const double third = 2.0 * kPi / 3.0;
  const auto geometry_of = [&](double rods_m) {
    return DeltaGeometry(DeltaSimple{0.15 * size_m, 0.3 * size_m, rods_m, {0.0, third, 2.0 * third}});
  };
  const DeltaGeometry geometry = geometry_of(0.55 * size_m);
  const DeltaKinematics kinematics(geometry), of_inverse(geometry_of((1.0 + off) * 0.55 * size_m));
  Random random = Random(seed).child("extremes delta");
  double worst = 0.0;
  for (int i = 0; i < 300; ++i) {
    const Vector3 p_m = size_m * Vector3(random.uniform(-0.15, 0.15), random.uniform(-0.15, 0.15),
                                         random.uniform(-0.65, -0.45));
    const DeltaAngles angles = of_inverse.inverse(p_m);
    if (angles.status != SolutionStatus::kFound) return bad("a position that is reachable is not reached");
    const DeltaPosition back = kinematics.forward(angles.theta_rad, geometry.working_assembly(), p_m);
    worst = std::max(worst, back.status == SolutionStatus::kFound ? (back.p_m - p_m).norm() / size_m : 1.0);
  }
  return accurate(worst, kDelta);
}

/// exp and log of a rotation vector of this length, any axis: the same rotation, and the shorter way.
ExtremeCell turn_cell(const std::string& name, double angle_rad, double off_rad = 0.0) {
  return {
      name, "", [angle_rad, off_rad](std::uint64_t seed) {
        Random random = Random(seed).child("extremes turn");
        double worst = 0.0;
        for (int i = 0; i < 300; ++i) {
          const Vector3 axis = Vector3(random.normal(), random.normal(), random.normal()).stableNormalized();
          const Quaternion q = exp_rotation(angle_rad * axis);
          const Vector3 back = log_rotation(q) + off_rad * Vector3::UnitX();
          if (!(back.norm() <= kPi + 1e-14)) return bad("not the shorter way round");
          const Quaternion again = exp_rotation(back);
          const double sign = q.dot(again) < 0.0 ? -1.0 : 1.0;
          worst = std::max({worst, std::abs(q.norm() - 1.0), (q.coeffs() - sign * again.coeffs()).norm()});
          // Below pi it is the vector itself, to all its digits.
          if (angle_rad > 0.0 && angle_rad < 3.0)
            worst = std::max(worst, (back - angle_rad * axis).stableNorm() / std::max(angle_rad, kNormal));
        }
        return accurate(worst, kTurn_rad);
      }};
}

}  // namespace

std::vector<ExtremeRow> extreme_kinematics() {
  std::vector<ExtremeRow> rows;
  ExtremeRow reach{"arm: reach, three arms", "error of the position / reach", reach_cell(1.0, 1e-9), {}};
  for (const double reach_m : {1e-3, 1e-1, 1.0, 20.0}) reach.cells.push_back(reach_cell(reach_m));
  rows.push_back(reach);
  const std::vector<test::NamedArm> arms = test::ready_arms();
  rows.push_back(singular_row(arms[0], kPi / 2.0, 0.0));
  rows.push_back(singular_row(arms[1], 0.0, -std::atan2(0.4318, 0.0203)));
  rows.push_back(singular_row(arms[2], 0.0, 0.0));
  rows.push_back(goal_row());
  const auto size = [](double size_m, const std::string& refusal) {
    return ExtremeCell{short_text(size_m) + " m", refusal,
                       [size_m](std::uint64_t seed) { return delta_round_trip(size_m, seed); }};
  };
  ExtremeRow delta{
      "DELTA: size",
      "error of the position / size",
      {"rods 1e-9 longer", "", [](std::uint64_t seed) { return delta_round_trip(1.0, seed, 1e-9); }},
      {size(1e-3, ""), size(1e-1, ""), size(1.0, ""), size(20.0, ""), size(0.0, "must be positive"),
       size(std::numeric_limits<double>::quiet_NaN(), "not a finite number")}};
  rows.push_back(delta);
  rows.push_back({"rotation: angle",
                  "error of exp and log, rad",
                  turn_cell("1 nrad beside", 1.0, 1e-9),
                  {turn_cell("0", 0.0), turn_cell("1e-320", 1e-320), turn_cell("1e-200", 1e-200),
                   turn_cell("1e-9", 1e-9), turn_cell("π-1e-9", kPi - 1e-9), turn_cell("π", kPi),
                   turn_cell("2π", 2.0 * kPi), turn_cell("1e9", 1e9)}});
  return rows;
}

}  // namespace longreach
