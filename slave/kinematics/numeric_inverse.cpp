#include "slave/kinematics/numeric_inverse.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "slave/kinematics/joint_step.hpp"

namespace longreach {
namespace {

// How a run goes about it. Chosen on random arms: the search by its cost a success, the other by its
// smoothness.
struct Temper {
  double step_max_rad;  // a longer step leaves the region in which the Jacobian means something
  double singular;      // below this share of the length a direction counts as nearly singular and is damped
  double damping;       // of |e|²
  std::uint32_t timeout;  // a run gives up when so many steps have not halved the residual
  bool turns_freely;      // joints with a range of a whole turn pass their limits on the way
};
constexpr Temper kFollow{0.3, 0.005, 1.0, 12, false};
constexpr Temper kSearch{0.5, 3e-5, 0.003, 3, true};

struct Candidate {
  JointVector joint_rad;
  RigidKinematics tool;
  Vector6 error;
  double residual_m;

  void place(const Kinematics& kinematics, const Rigid& goal, const JointVector& q_rad) {
    joint_rad = q_rad;
    tool = kinematics.rigid_with_jacobian(q_rad);
    error.head<3>() = kinematics.motion_length_m() * chord_between(tool.X_WE.R, goal.R);
    error.tail<3>() = goal.p - tool.X_WE.p;
    residual_m = error.norm();
  }
};

JointVector step_from(const Candidate& c, double boost, double length_m, const Temper& temper) {
  const double singular_m = temper.singular * length_m;
  const double damping_m2 = temper.damping * boost * c.residual_m * c.residual_m;
  JointVector step = damped_step(c.tool.J, length_m, c.error, damping_m2, singular_m * singular_m).joint_rad;
  const double largest = step.cwiseAbs().maxCoeff();
  if (!(largest <= temper.step_max_rad)) step *= temper.step_max_rad / largest;
  return step;
}

}  // namespace

NumericInverse::NumericInverse(const RobotConfig& robot) : kinematics_(robot) {
  for (int i = 0; i < kMaxJoints; ++i) {
    min_rad_[i] = robot.joint[static_cast<std::size_t>(i)].min_rad;
    max_rad_[i] = robot.joint[static_cast<std::size_t>(i)].max_rad;
    turns_[static_cast<std::size_t>(i)] =
        robot.joint[static_cast<std::size_t>(i)].kind == JointKind::kRevolute;
  }
  for (std::uint32_t n = 1; n <= kKnownStarts; ++n) {
    const Place place = place_m(kinematics_.rigid_forward(start(n)));
    start_place_m_.row(n - 1) = place;
    start_square_m2_[n - 1] = place.squaredNorm();
  }
}

NumericInverse::Place NumericInverse::place_m(const Rigid& X_WE) const {
  constexpr double kRadius = 0.2;  // of the length; measured: half the steps that all of it leads to
  const double weight = kRadius * kinematics_.motion_length_m() / std::numbers::sqrt2;
  Place place;
  place << weight * X_WE.R.reshaped().transpose(), X_WE.p.transpose();
  return place;
}

// Evenly spread without randomness: multiples of the powers of 1/φ₆, φ₆ the root of x^7 = x + 1 (Roberts
// 2018), over one turn of each joint about the middle of its range, and the whole range of a slide.
JointVector NumericInverse::start(std::uint32_t number) const {
  constexpr double kPhi = 1.1127756842787055;
  JointVector q;
  double share = 1.0;
  for (int i = 0; i < kMaxJoints; ++i) {
    share /= kPhi;
    const double place = 0.5 + share * number;
    const double range = max_rad_[i] - min_rad_[i];
    const double width = turns(i) ? std::min(range, 2.0 * std::numbers::pi) : range;
    q[i] = 0.5 * (min_rad_[i] + max_rad_[i]) + width * (place - std::floor(place) - 0.5);
  }
  return q;
}

// One run of the iteration.
struct NumericInverse::Run {
  const NumericInverse& inverse;
  const Rigid& goal;
  const InverseTolerance& tolerance;
  const Temper& temper;

  [[nodiscard]] bool turns(int i) const {
    constexpr double kTurn = 2.0 * std::numbers::pi - 1e-4;  // limits of 3.14159 mean a whole turn
    return temper.turns_freely && inverse.turns(i) && inverse.max_rad_[i] - inverse.min_rad_[i] >= kTurn;
  }

  // Within the limits, but for joints that turn freely.
  [[nodiscard]] JointVector limited(const JointVector& q) const {
    JointVector allowed = q.cwiseMax(inverse.min_rad_).cwiseMin(inverse.max_rad_);
    for (int i = 0; i < kMaxJoints; ++i) {
      if (turns(i)) allowed[i] = q[i];
    }
    return allowed;
  }

  // Within the limits, joints that turn freely by whole turns.
  [[nodiscard]] JointVector folded(JointVector q) const {
    for (int i = 0; i < kMaxJoints; ++i) {
      const double middle = 0.5 * (inverse.min_rad_[i] + inverse.max_rad_[i]);
      if (turns(i)) q[i] = middle + std::remainder(q[i] - middle, 2.0 * std::numbers::pi);
    }
    return q.cwiseMax(inverse.min_rad_).cwiseMin(inverse.max_rad_);
  }

  [[nodiscard]] NumericResult from(const JointVector& start_rad) const {
    const Kinematics& kinematics = inverse.kinematics_;
    const double length = kinematics.motion_length_m();
    std::array<Candidate, 2> candidates;
    Candidate *best = candidates.data(), *next = best + 1;
    best->place(kinematics, goal, start_rad);
    NumericResult result;
    double boost = 1.0, milestone = best->residual_m;
    std::uint32_t since = 0;
    // A loose tolerance must not freeze a slow motion: one step is made unless the start is exact.
    for (std::uint32_t i = 0; i < tolerance.iterations_max && std::isfinite(best->residual_m); ++i) {
      const double enough = i == 0 ? 1e-14 * kinematics.reach_m() : tolerance.residual_m;
      if (best->residual_m <= enough || ++since > temper.timeout) break;
      const JointVector step = step_from(*best, boost, length, temper);
      ++result.iterations;
      if (!step.allFinite()) break;
      const JointVector wanted = best->joint_rad + step;
      const JointVector allowed = limited(wanted);
      result.at_joint_limit = result.at_joint_limit || allowed != wanted;
      next->place(kinematics, goal, allowed);
      if (next->residual_m < best->residual_m) {
        std::swap(best, next);
        boost = std::max(0.1 * boost, 1.0);
        if (best->residual_m < 0.5 * milestone) milestone = best->residual_m, since = 0;
      } else {
        boost = std::min(100.0 * boost, 1e12);
      }
    }
    if (const JointVector q = folded(best->joint_rad); q != best->joint_rad) best->place(kinematics, goal, q);
    result.found = best->residual_m <= tolerance.residual_m;
    result.joint_rad = best->joint_rad;
    result.tool = best->tool;
    result.residual_m = best->residual_m;
    return result;
  }
};

NumericResult NumericInverse::search_once(const Rigid& X_WE_goal, const JointVector& start_rad,
                                          const InverseTolerance& tolerance) const {
  return Run{*this, X_WE_goal, tolerance, kSearch}.from(start_rad);
}

NumericResult NumericInverse::solve(const Rigid& X_WE_goal, const JointVector& start_rad,
                                    const InverseTolerance& tolerance) const {
  const Place goal = place_m(X_WE_goal);
  if (tolerance.restarts_max == 0 || !goal.allFinite())
    return Run{*this, X_WE_goal, tolerance, kFollow}.from(start_rad);
  constexpr double kTried = std::numeric_limits<double>::infinity();
  Eigen::Array<double, kKnownStarts + 1, 1> miss;  // squared distances less |goal|²; the last is start_rad's
  miss.head<kKnownStarts>() = start_square_m2_ - 2.0 * (start_place_m_ * goal.transpose()).array();
  miss[kKnownStarts] =
      (place_m(kinematics_.rigid_forward(start_rad)) - goal).squaredNorm() - goal.squaredNorm();
  NumericResult best;
  std::uint32_t iterations = 0;
  for (std::uint32_t n = 0; n <= tolerance.restarts_max; ++n) {
    std::uint32_t number = n;
    if (n <= kKnownStarts) {
      Eigen::Index nearest;
      miss.minCoeff(&nearest);
      miss[nearest] = kTried;
      number = (static_cast<std::uint32_t>(nearest) + 1) % (kKnownStarts + 1);
    }
    const NumericResult next = search_once(X_WE_goal, number == 0 ? start_rad : start(number), tolerance);
    iterations += next.iterations;
    if (n == 0 || next.residual_m < best.residual_m) best = next;
    if (best.found || !std::isfinite(best.residual_m)) break;
  }
  best.iterations = iterations;
  return best;
}

}  // namespace longreach
