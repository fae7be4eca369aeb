// Inverse kinematics of the arm for goals that are 0.1 rad away in every joint, for the three supplied
// six-joint arms. KDL is measured with the same goals in tests/peers.

#include "deploy/lab/robot/random_arm.hpp"
#include "deploy/lab/trade/arm_goals.hpp"
#include "deploy/lab/trade/trade.hpp"
#include "slave/kinematics/inverse.hpp"

namespace longreach {
namespace {

std::vector<TradePoint> measure_arm(const ExperimentRun& run) {
  constexpr std::uint32_t kIterations[] = {1, 2, 3, 4, 5, 8, 20};
  std::vector<TradePoint> points{{"closed_form", "", 0.0, 0.0, 0.0, true}};
  for (const std::uint32_t n : kIterations)
    points.push_back({"damped_iteration", std::to_string(n), 0.0, 0.0, 0.0});
  const auto arms = test::ready_arms();
  const double share = 1.0 / static_cast<double>(arms.size());
  for (const test::NamedArm& arm : arms) {
    const Inverse inverse(arm.robot);
    const NumericInverse numeric(arm.robot);
    const Kinematics& kinematics = inverse.kinematics();
    const ArmGoals g = arm_goals(kinematics, Random(run.seed).child("trade " + arm.name));
    measure_inverse(points[0], kinematics, g, share,
                    [&](const Pose& goal, const JointVector& from, JointVector& q) {
                      q = inverse.solve(goal, from, {}).joint_rad;
                    });
    for (std::size_t n = 0; n < std::size(kIterations); ++n) {
      const InverseTolerance tolerance{1e-15, kIterations[n], 0};
      measure_inverse(points[1 + n], kinematics, g, share,
                      [&](const Pose& goal, const JointVector& from, JointVector& q) {
                        q = numeric.solve(to_rigid(goal), from, tolerance).joint_rad;
                      });
    }
  }
  return points;
}

}  // namespace

TradeStage trade_arm_inverse() {
  return {.name = "arm_inverse",
          .title = "Inverse kinematics: closed form, and damped least squares with 1 to 20 iterations",
          .cost = "time per call",
          .cost_unit = "ns",
          .error = "mean error",
          .error_unit = "fraction of the reach",
          .series = {"closed_form", "damped_iteration"},
          .measure = measure_arm};
}

}  // namespace longreach
