#pragma once
// Random goals for an arm, and the cost and error of an inverse kinematics method for them.

#include <algorithm>
#include <cmath>
#include <vector>

#include "deploy/lab/robot/random_arm.hpp"
#include "deploy/lab/trade/cost.hpp"
#include "deploy/lab/trade/trade.hpp"

namespace longreach {

/// Goals per pass; number of goals for which instructions are counted.
constexpr int kGoals = 256, kGoalsCounted = 2;
constexpr double kGoalAway_rad = 0.1;

struct ArmGoals {
  std::vector<Pose> goal;
  std::vector<JointVector> from_rad;
};

inline ArmGoals arm_goals(const Kinematics& kinematics, Random random) {
  ArmGoals g;
  for (int i = 0; i < kGoals; ++i) {
    const JointVector q = test::random_joints(random);
    g.goal.push_back(kinematics.forward(q));
    g.from_rad.push_back(q + test::random_joints(random, kGoalAway_rad));
  }
  return g;
}

/// The error |e| of numeric_inverse.hpp, as a fraction of the reach.
inline double inverse_error(const Kinematics& kinematics, const JointVector& q, const Pose& goal) {
  const Pose at = kinematics.forward(q);
  const double turn = 2.0 * std::asin(std::min(1.0, (at.q.conjugate() * goal.q).vec().norm()));
  return std::hypot((at.p - goal.p).norm() / kinematics.reach_m(), turn);
}

/// Adds the cost and error of `solve`, weighted by `share`, to `point`. The values are means, because medians
/// over the poses and arms would hide failures.
template <class Solve>
void measure_inverse(TradePoint& point, const Kinematics& kinematics, const ArmGoals& g, double share,
                     Solve&& solve) {
  JointVector q;
  for (int i = 0; i < kGoals; ++i) {
    const auto k = static_cast<std::size_t>(i);
    solve(g.goal[k], g.from_rad[k], q);
    point.error += share * inverse_error(kinematics, q, g.goal[k]) / kGoals;
  }
  const auto call = [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    solve(g.goal[k], g.from_rad[k], q);
  };
  point.cost += share * cost_ns(kGoals, call);
  if (std::isfinite(point.instructions)) point.instructions += share * instructions(kGoalsCounted, call);
}

}  // namespace longreach
