#include "slave/kinematics/inverse.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "slave/kinematics/joint_step.hpp"

namespace longreach {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr double kSlack = 1e-12;  // an angle at its limit comes out with rounding
constexpr double kNearlySlack = 0.05;
constexpr double kFollowMaxRad = 0.1;

}  // namespace

Inverse::Inverse(const RobotConfig& robot)
    : numeric_(robot), closed_(numeric_.kinematics()), prefer_(robot.prefer) {
  int sliders = 0, fixed = 0;
  for (int i = 0; i < kMaxJoints; ++i) {
    const JointConfig& j = robot.joint[static_cast<std::size_t>(i)];
    per_speed_s_[i] = 1.0 / j.speed_max_rad_per_s;
    moves_[static_cast<std::size_t>(i)] = j.kind != JointKind::kFixed;
    if (j.kind == JointKind::kFixed) ++fixed;
    if (j.kind == JointKind::kPrismatic && sliders < 3) slider_[static_cast<std::size_t>(sliders++)] = i;
  }
  if (sliders != 3 || fixed != 3) return;
  const Jacobian J = kinematics().rigid_with_jacobian(JointVector::Zero()).J;
  Matrix3 axes;
  for (int i = 0; i < 3; ++i) axes.col(i) = J.col(slider_[static_cast<std::size_t>(i)]).tail<3>();
  cartesian_ = std::abs(axes.determinant()) > kRowTolerance;
  if (cartesian_) from_position_ = axes.inverse();
}

// Solutions of a nearly equal arm may be this much beyond a limit that the arm's own keep.
double Inverse::slack_rad() const { return closed_.loop().nearly ? kNearlySlack : kSlack; }

std::string_view Inverse::words() const {
  return cartesian_ ? "linear: three prismatic joints, rotation ignored" : longreach::words(closed_.loop());
}

// Each angle on the turn nearest to where it is that the limits allow. False: there is none.
bool Inverse::place(const JointVector& solution, JointVector& placed) const {
  const double slack = slack_rad();
  for (int i = 0; i < kMaxJoints; ++i) {
    const double low = numeric_.min_rad()[i], high = numeric_.max_rad()[i];
    double q = solution[i];
    const bool turns = numeric_.turns(i);
    if (turns && q > high + slack) q -= kTwoPi * std::ceil((q - high - slack) / kTwoPi);
    if (turns && q < low - slack) q += kTwoPi * std::ceil((low - slack - q) / kTwoPi);
    if (!(q >= low - slack && q <= high + slack)) return false;
    placed[i] = std::clamp(q, low, high);
  }
  return true;
}

double Inverse::cost(const JointVector& joint_rad, const JointVector& near_rad) const {
  switch (prefer_) {
    case BranchPreference::kSoonest:
      return (joint_rad - near_rad).cwiseAbs().cwiseProduct(per_speed_s_).maxCoeff();
    case BranchPreference::kCentred: {
      const JointVector middle = 0.5 * (numeric_.min_rad() + numeric_.max_rad());
      return (2.0 * (joint_rad - middle).cwiseAbs().cwiseQuotient(numeric_.max_rad() - numeric_.min_rad()))
          .maxCoeff();
    }
    case BranchPreference::kNearest:
      break;
  }
  return (joint_rad - near_rad).squaredNorm();
}

bool Inverse::inside(const JointVector& joint_rad, double slack_rad) const {
  return ((joint_rad - numeric_.min_rad()).array() >= -slack_rad).all() &&
         ((numeric_.max_rad() - joint_rad).array() >= -slack_rad).all();
}

Placed Inverse::limited(const Rigid& goal, const JointVector& joint_rad) const {
  return Refinement(kinematics(), goal)
      .at(joint_rad.cwiseMax(numeric_.min_rad()).cwiseMin(numeric_.max_rad()));
}

// Within the limits but for the rounding of the last step.
bool Inverse::reach(const Rigid& goal, const JointVector& joint_rad, Placed& placed) const {
  placed.joint_rad = joint_rad;
  if (!Refinement(kinematics(), goal).improve(placed)) return false;
  if (closed_.loop().nearly && !inside(placed.joint_rad, kSlack)) return false;
  if (!inside(placed.joint_rad, 0.0)) placed = limited(goal, placed.joint_rad);
  return true;
}

bool Inverse::choose(const Rigid& goal, const JointVector& near_rad, Placed& placed) const {
  const KnownJoints near = closed_.known(near_rad);
  Branches branches;
  if (prefer_ == BranchPreference::kNearest) {
    closed_.solve(goal, near, branches, true);
    if (branches.count == 1 && inside(branches.branch[0].joint_rad, slack_rad()) &&
        reach(goal, branches.branch[0].joint_rad, placed))
      return true;
  }
  closed_.solve(goal, near, branches);
  std::array<double, Branches::kMax> costs;
  constexpr double kNever = std::numeric_limits<double>::infinity();
  for (int i = 0; i < branches.count; ++i) {
    const auto n = static_cast<std::size_t>(i);
    Branch& b = branches.branch[n];
    JointVector allowed;
    const bool possible = b.miss <= closed_.loop().miss_max && place(b.joint_rad, allowed);
    costs[n] = possible ? cost(allowed, near_rad) : kNever;
    if (possible) b.joint_rad = allowed;
  }
  for (int tries = 0; tries < branches.count; ++tries) {
    const auto best = std::min_element(costs.begin(), costs.begin() + branches.count);
    if (!(*best < kNever)) return false;
    *best = kNever;
    if (reach(goal, branches.branch[static_cast<std::size_t>(best - costs.begin())].joint_rad, placed))
      return true;
  }
  return false;
}

// A singular pose has solutions without end, and the closed form gives some of them, in which joints may have
// gone far although the tool has hardly moved: one beside the joints themselves is preferred. Elsewhere that
// is the one that is chosen already, but for rounding.
bool Inverse::stay(const Rigid& goal, const JointVector& near_rad, Placed& placed) const {
  constexpr double kThere = 1e-6, kNear = 0.3, kNearer = 0.25;
  constexpr InverseTolerance kBeside{1e-10, 20, 0};
  constexpr double kLeap = 2.5;  // of the joints, over the tool's way in rad and shares of the reach
  const Refinement refinement(kinematics(), goal);
  Placed beside = refinement.at(near_rad);
  const double leap = (placed.joint_rad - near_rad).cwiseAbs().maxCoeff();
  const bool leaps = beside.miss < kNear && leap > kLeap * beside.miss;
  if (beside.miss > kThere && !leaps) return false;
  // Damped, since beside a singular pose an undamped step goes far.
  if (leaps) beside.joint_rad = numeric_.solve(goal, near_rad, kBeside).joint_rad;
  if (!refinement.improve(beside) || !inside(beside.joint_rad, 0.0) ||
      !(cost(beside.joint_rad, near_rad) < kNearer * cost(placed.joint_rad, near_rad)))
    return false;
  placed = beside;
  return true;
}

InverseResult Inverse::report(const Placed& placed, double enough_m) const {
  const double length = kinematics().motion_length_m();
  InverseResult result;
  result.joint_rad = placed.joint_rad;
  result.X_WE = to_pose(placed.tool.X_WE);
  result.position_error_m = placed.position_error_m.norm();
  result.rotation_error_rad = placed.rotation_error_rad.norm();
  result.conditioning = conditioning(placed.tool.J, length);
  const double residual_m = std::hypot(length * result.rotation_error_rad, result.position_error_m);
  if (!(residual_m <= std::max(enough_m, 2.0 * Refinement::kExact * kinematics().reach_m()))) return result;
  result.status = InverseStatus::kFound;
  if (result.conditioning > kSingular) return result;
  result.status = InverseStatus::kSingular;
  result.lost = lost_direction(placed.tool.J, length);
  return result;
}

InverseResult Inverse::iterate(const Rigid& goal, const JointVector& near_rad,
                               const InverseTolerance& tolerance) const {
  const NumericResult found = numeric_.solve(goal, near_rad, tolerance);
  InverseResult result = report(Refinement(kinematics(), goal).at(found.joint_rad), tolerance.residual_m);
  result.at_joint_limit = found.at_joint_limit;
  result.iterations = found.iterations;
  return result;
}

InverseResult Inverse::slide(const Rigid& goal, const JointVector& near_rad) const {
  const Vector3 change = from_position_ * (goal.p - kinematics().rigid_forward(near_rad).p);
  JointVector wanted = near_rad;
  for (std::size_t i = 0; i < 3; ++i) wanted[slider_[i]] += change[static_cast<int>(i)];
  const Placed placed = limited(goal, wanted);
  InverseResult result = report(placed, 0.0);
  result.status = result.position_error_m <= 2.0 * Refinement::kExact * kinematics().reach_m()
                      ? InverseStatus::kFound
                      : InverseStatus::kNearest;
  result.lost.setZero();
  result.conditioning = 1.0;
  result.at_joint_limit = placed.joint_rad != wanted;
  result.rotation_ignored = true;
  return result;
}

InverseResult Inverse::solve(const Pose& X_WE_goal, const JointVector& near_rad,
                             const InverseTolerance& tolerance) const {
  const JointVector start = near_rad.cwiseMax(numeric_.min_rad()).cwiseMin(numeric_.max_rad());
  if (!is_finite(X_WE_goal)) {
    InverseResult result;
    result.joint_rad = start;
    result.X_WE = kinematics().forward(start);
    result.position_error_m = result.rotation_error_rad = std::numeric_limits<double>::infinity();
    return result;
  }
  const Rigid goal{X_WE_goal.q.normalized().toRotationMatrix(), X_WE_goal.p};
  if (cartesian_) return slide(goal, start);
  Placed placed;
  if (closed_.applies() && choose(goal, near_rad, placed)) {
    (void)stay(goal, start, placed);
    return report(placed, tolerance.residual_m);
  }
  const InverseResult found = iterate(goal, start, tolerance);
  const bool thorough = tolerance.restarts_max > 0;
  if (found.status != InverseStatus::kNearest || !thorough ||
      !choose_exact(X_WE_goal, near_rad, tolerance, placed))
    return found;
  return report(placed, tolerance.residual_m);
}

// A run of the search may end beside a solution that Newton steps reach.
bool Inverse::choose_exact(const Pose& X_WE_goal, const JointVector& near_rad,
                           const InverseTolerance& tolerance, Placed& placed) const {
  const InverseSolutions exact = all(X_WE_goal, near_rad, tolerance);
  double least = std::numeric_limits<double>::infinity();
  JointVector best = near_rad, allowed;
  for (int i = 0; i < exact.count; ++i) {
    if (!place(exact.joint_rad[static_cast<std::size_t>(i)], allowed) || !(cost(allowed, near_rad) < least))
      continue;
    least = cost(allowed, near_rad);
    best = allowed;
  }
  const Rigid goal{X_WE_goal.q.normalized().toRotationMatrix(), X_WE_goal.p};
  placed = limited(goal, best);
  return std::isfinite(least);
}

InverseResult Inverse::follow(const Pose& X_WE_goal, const JointVector& joint_rad,
                              const InverseTolerance& tolerance) const {
  if (cartesian_ || !closed_.applies() || !is_finite(X_WE_goal))
    return solve(X_WE_goal, joint_rad, tolerance);
  const Rigid goal{X_WE_goal.q.normalized().toRotationMatrix(), X_WE_goal.p};
  Placed placed;
  if (choose(goal, joint_rad, placed) &&
      (placed.joint_rad - joint_rad).cwiseAbs().maxCoeff() <= kFollowMaxRad) {
    return report(placed, tolerance.residual_m);
  }
  return iterate(goal, joint_rad, tolerance);
}

double Inverse::room_rad(const JointVector& joint_rad) const {
  double room = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMaxJoints; ++i) {
    if (!moves_[static_cast<std::size_t>(i)]) continue;
    room = std::min({room, joint_rad[i] - numeric_.min_rad()[i], numeric_.max_rad()[i] - joint_rad[i]});
  }
  return room;
}

ReachEnd Inverse::limit_of(const JointVector& joint_rad, double slack_rad) const {
  for (int i = 0; i < kMaxJoints; ++i) {
    const bool upper = joint_rad[i] >= numeric_.max_rad()[i] - slack_rad;
    if (moves_[static_cast<std::size_t>(i)] && (upper || joint_rad[i] <= numeric_.min_rad()[i] + slack_rad))
      return {true, i + 1, upper};
  }
  return {true};
}

ReachEnd Inverse::reach_end(const Pose& X_WE, const JointVector& joint_rad,
                            const InverseTolerance& tolerance) const {
  constexpr double kBeside =
      1.0;  // rad: another branch, or the other side of a singular pose, is farther away
  if (cartesian_) {
    const InverseResult found = solve(X_WE, joint_rad, tolerance);
    return found.status == InverseStatus::kNearest ? limit_of(found.joint_rad) : ReachEnd{};
  }
  if (!closed_.applies()) {
    const InverseResult found = solve(X_WE, joint_rad, tolerance);
    if (found.status != InverseStatus::kNearest) return {};
    return found.at_joint_limit ? limit_of(found.joint_rad) : ReachEnd{true};
  }
  const Rigid goal{X_WE.q.normalized().toRotationMatrix(), X_WE.p};
  const auto is_beside = [&](const JointVector& q) {
    return (q - joint_rad).cwiseAbs().maxCoeff() <= kBeside;
  };
  Placed placed;
  const bool possible = choose(goal, joint_rad, placed);
  if (possible && is_beside(placed.joint_rad)) return {};
  Branches branches;
  closed_.solve(goal, closed_.known(joint_rad), branches, true);
  const JointVector& present = branches.branch[0].joint_rad;
  if (branches.count == 1 && is_beside(present) && !inside(present, slack_rad())) return limit_of(present);
  return {!possible || aside_m(goal, joint_rad, placed.joint_rad - joint_rad) >
                           kSingularAside * kinematics().motion_length_m()};
}

double Inverse::aside_m(const Rigid& X_WE_goal, const JointVector& from_rad,
                        const JointVector& way_rad) const {
  const auto off_m = [&](double share) {
    const Rigid X = kinematics().rigid_forward(from_rad + share * way_rad);
    return std::hypot(kinematics().motion_length_m() * rotation_between(X.R, X_WE_goal.R).norm(),
                      (X_WE_goal.p - X.p).norm());
  };
  double most_m = 0.0;
  for (const double share : {0.125, 0.25, 0.5, 0.75}) most_m = std::max(most_m, off_m(share));
  return most_m - off_m(0.0);
}

InverseSolutions Inverse::all(const Pose& X_WE_goal, const JointVector& near_rad,
                              const InverseTolerance& tolerance) const {
  constexpr double kSame = 1e-6;  // rad
  InverseSolutions solutions;
  if (!is_finite(X_WE_goal)) return solutions;
  const Rigid goal{X_WE_goal.q.normalized().toRotationMatrix(), X_WE_goal.p};
  const auto add = [&](JointVector q) {
    for (int i = 0; i < kMaxJoints; ++i) {
      if (numeric_.turns(i)) q[i] = near_rad[i] + nearest_turn(q[i] - near_rad[i]);
    }
    for (int n = 0; n < solutions.count; ++n) {
      const JointVector gap = q - solutions.joint_rad[static_cast<std::size_t>(n)];
      double largest = 0.0;
      for (int i = 0; i < kMaxJoints; ++i)
        largest = std::max(largest, std::abs(numeric_.turns(i) ? nearest_turn(gap[i]) : gap[i]));
      if (largest <= kSame) return;
    }
    if (solutions.count < InverseSolutions::kMax)
      solutions.joint_rad[static_cast<std::size_t>(solutions.count++)] = q;
  };
  const Refinement refinement(kinematics(), goal);
  Placed placed;
  if (closed_.applies()) {
    Branches branches;
    closed_.solve(goal, closed_.known(near_rad), branches);
    for (int i = 0; i < branches.count; ++i) {
      const Branch& b = branches.branch[static_cast<std::size_t>(i)];
      placed.joint_rad = b.joint_rad;
      if (b.miss <= closed_.loop().miss_max && refinement.improve(placed)) add(placed.joint_rad);
    }
    return solutions;
  }
  if (cartesian_) {
    const InverseResult result = slide(goal, near_rad);
    if (result.status != InverseStatus::kNearest)
      solutions.joint_rad[0] = result.joint_rad, solutions.count = 1;
    return solutions;
  }
  for (std::uint32_t n = 0; n <= tolerance.restarts_max; ++n) {
    placed.joint_rad = numeric_.search_once(goal, n == 0 ? near_rad : numeric_.start(n), tolerance).joint_rad;
    if (refinement.improve(placed)) add(placed.joint_rad);
  }
  return solutions;
}

}  // namespace longreach
