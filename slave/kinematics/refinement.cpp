#include "slave/kinematics/refinement.hpp"

#include <algorithm>
#include <cmath>

#include "slave/kinematics/joint_step.hpp"

namespace longreach {
namespace {

constexpr double kEnoughMiss = 0.4 * Refinement::kExact;

}  // namespace

Placed Refinement::at(const JointVector& joint_rad) const {
  const double length = kinematics_.reach_m();
  Placed placed;
  placed.joint_rad = joint_rad;
  placed.tool = kinematics_.rigid_with_jacobian(joint_rad);
  placed.rotation_error_rad = rotation_between(placed.tool.X_WE.R, goal_.R);
  placed.position_error_m = goal_.p - placed.tool.X_WE.p;
  placed.miss = std::sqrt(std::max(placed.rotation_error_rad.squaredNorm(),
                                   placed.position_error_m.squaredNorm() / (length * length)));
  return placed;
}

bool Refinement::improve(Placed& placed) const {
  placed = at(placed.joint_rad);
  if (placed.miss <= kEnoughMiss || newton(placed)) return true;
  constexpr double kMet = 1e-8;
  constexpr int kTimes = 3;
  for (int i = 0; i < kTimes && placed.miss <= kMet; ++i) {
    const double before = placed.miss;
    step_aside(placed);
    if (newton(placed)) return true;
    if (!(placed.miss < before)) break;
  }
  return false;
}

Placed Refinement::moved(const Placed& from, bool damped) const {
  constexpr double kDamping = 1e-12;  // of the length squared
  const double length = kinematics_.motion_length_m();
  Vector6 e_m;
  e_m << length * from.rotation_error_rad, from.position_error_m;
  if (damped)
    return at(from.joint_rad +
              damped_step(from.tool.J, length, e_m, kDamping * length * length, 0.0).joint_rad);
  Jacobian J_m = from.tool.J;
  J_m.topRows<3>() *= length;
  return at(from.joint_rad + newton_step(J_m, e_m));
}

// Each step the better of two: one omits directions that are all but lost, and so keeps their rounding
// out; the other goes along with them first, towards the one root of two that have met.
bool Refinement::newton(Placed& placed) const {
  constexpr int kStepsMax = 24, kTimeout = 2;  // between two roots that met, a step halves the distance
  Placed next = placed;
  for (int i = 0, worse = 0; i < kStepsMax && worse < kTimeout && next.miss < 1.0; ++i) {
    const Placed start = next;
    next = moved(start, true);
    if (next.miss > kEnoughMiss) {
      const Placed along = moved(moved(start, false), true);
      if (along.miss < next.miss) next = along;
    }
    worse = next.miss < placed.miss ? 0 : worse + 1;
    if (next.miss < placed.miss) placed = next;
    if (placed.miss <= kEnoughMiss) break;
  }
  return placed.miss <= kExact;
}

// Between two roots that have met no Newton step leaves the place, and where a root is flat each gains too
// little: along the joint motion that moves the tool least, to either side, to where it is nearest.
void Refinement::step_aside(Placed& placed) const {
  constexpr double kFirstRad = 1e-8, kLastRad = 0.3, kRatio = 1.6;
  constexpr int kRefinements = 12;
  const JointVector along = idle_motion(placed.tool.J, kinematics_.motion_length_m());
  const JointVector from = placed.joint_rad;
  double best = 0.0;
  const auto try_at = [&](double h) {
    const Placed next = moved(at(from + h * along), true);
    if (!(next.miss < placed.miss)) return;
    placed = next;
    best = h;
  };
  for (double h = kFirstRad; h < kLastRad; h *= kRatio) try_at(h), try_at(-h);
  double width = 0.25 * best;
  for (int i = 0; i < kRefinements && best != 0.0; ++i, width *= 0.6) {
    const double middle = best;
    try_at(middle + width);
    try_at(middle - width);
  }
}

}  // namespace longreach
