// The arm's inverse: a goal a tenth of a radian away in every joint, for the three arms with six joints that
// ship. KDL's is measured beside it.

#include <cmath>
#include <kdl/chainiksolverpos_lma.hpp>

#include "deploy/lab/robot/random_arm.hpp"
#include "deploy/lab/trade/cost.hpp"
#include "deploy/lab/trade/trade.hpp"
#include "slave/kinematics/inverse.hpp"
#include "tests/oracle/kdl_chain.hpp"

namespace longreach {
namespace {

constexpr int kPoses = 256, kCounted = 2;
constexpr double kAway_rad = 0.1;

struct Goals {
  std::vector<Pose> goal;
  std::vector<JointVector> from_rad;
};

Goals goals_of(const Kinematics& kinematics, Random random) {
  Goals g;
  for (int i = 0; i < kPoses; ++i) {
    const JointVector q = test::random_joints(random);
    g.goal.push_back(kinematics.forward(q));
    g.from_rad.push_back(q + test::random_joints(random, kAway_rad));
  }
  return g;
}

/// |e| of numeric_inverse.hpp as a share of the reach.
double error_of(const Kinematics& kinematics, const JointVector& q, const Pose& goal) {
  const Pose at = kinematics.forward(q);
  const double turn = 2.0 * std::asin(std::min(1.0, (at.q.conjugate() * goal.q).vec().norm()));
  return std::hypot((at.p - goal.p).norm() / kinematics.reach_m(), turn);
}

/// Medians over the poses and arms would hide the failures: the mean does not.
template <class Solve>
void add(TradePoint& point, const Kinematics& kinematics, const Goals& g, double share, Solve&& solve) {
  JointVector q;
  for (int i = 0; i < kPoses; ++i) {
    const auto k = static_cast<std::size_t>(i);
    solve(g.goal[k], g.from_rad[k], q);
    point.error += share * error_of(kinematics, q, g.goal[k]) / kPoses;
  }
  const auto call = [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    solve(g.goal[k], g.from_rad[k], q);
  };
  point.cost += share * cost_ns(kPoses, call);
  if (std::isfinite(point.instructions)) point.instructions += share * instructions(kCounted, call);
}

std::vector<TradePoint> measure(const ExperimentRun& run) {
  constexpr std::uint32_t kIterations[] = {1, 2, 3, 4, 5, 8, 20};
  std::vector<TradePoint> points{{"closed_form", "", 0.0, 0.0, 0.0, true}, {"kdl", ""}};
  for (const std::uint32_t n : kIterations)
    points.push_back({"damped_iteration", std::to_string(n), 0.0, 0.0, 0.0});
  const auto arms = test::ready_arms();
  const double share = 1.0 / static_cast<double>(arms.size());
  for (const test::NamedArm& arm : arms) {
    const Inverse inverse(arm.robot);
    const NumericInverse numeric(arm.robot);
    const Kinematics& kinematics = inverse.kinematics();
    const Goals g = goals_of(kinematics, Random(run.seed).child("trade " + arm.name));
    add(points[0], kinematics, g, share, [&](const Pose& goal, const JointVector& from, JointVector& q) {
      q = inverse.solve(goal, from, {}).joint_rad;
    });
    const KDL::Chain chain = oracle::kdl_chain(arm.robot);
    KDL::ChainIkSolverPos_LMA kdl(chain);
    KDL::JntArray out(kMaxJoints);
    add(points[1], kinematics, g, share, [&](const Pose& goal, const JointVector& from, JointVector& q) {
      const auto& r = goal.q;
      kdl.CartToJnt(
          oracle::kdl_joints(from),
          {KDL::Rotation::Quaternion(r.x(), r.y(), r.z(), r.w()), {goal.p.x(), goal.p.y(), goal.p.z()}}, out);
      for (int i = 0; i < q.size(); ++i) q[i] = out(static_cast<unsigned>(i));
    });
    for (std::size_t n = 0; n < std::size(kIterations); ++n) {
      const InverseTolerance tolerance{1e-15, kIterations[n], 0};
      add(points[2 + n], kinematics, g, share,
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
          .title = "Joints of a pose: closed form, damped least squares by iterations, KDL",
          .cost = "time of a call",
          .cost_unit = "ns",
          .error = "mean error",
          .error_unit = "of the reach",
          .series = {"closed_form", "damped_iteration", "kdl"},
          .measure = measure};
}

}  // namespace longreach
