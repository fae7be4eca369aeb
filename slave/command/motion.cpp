#include "slave/command/motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "slave/command/load_limits.hpp"
#include "slave/kinematics/joint_step.hpp"

namespace longreach {
namespace {

constexpr double kFarRad = 0.1;        // a solution farther away than this cannot be reached in one tick
constexpr double kFollows = 0.9;       // of the joint speeds: the arm follows its straight path
constexpr double kLeftBehind = 0.02;   // conditioning above which a singular pose is left behind
constexpr double kTurningShare = 0.8;  // of the joint limits, on the way to another solution

constexpr double kAtLimit_rad = 0.02;  // from its limit, a joint counts as at its limit

int named(const ReachEnd& end) { return end.upper ? end.joint : -end.joint; }

bool touches(const MotionInput& input) { return input.contact.in_contact || input.moment.in_contact; }

}  // namespace

SlaveMotion::SlaveMotion(const CommandConfig& command, const RobotConfig& robot,
                         const std::optional<FirstTouch>& touch)
    : command_(command),
      robot_(robot),
      inverse_(robot),
      line_(inverse_, robot, command),
      limiter_(command, inverse_.kinematics().forward(start_joints(robot)).p),
      joints_(robot),
      watch_(robot),
      stall_detector_(inverse_.kinematics().motion_length_m()),
      approach_(command, touch) {
  reset(start_joints(robot));
}

void SlaveMotion::configure(const CommandConfig& command, const std::optional<FirstTouch>& touch) {
  command_ = command;
  approach_.configure(command, touch);
  limiter_.configure(command);
  line_.configure(command);
}

void SlaveMotion::reset(const JointVector& joint_rad) {
  joints_.reset(joint_rad);
  X_WE_ = inverse_.kinematics().forward(joints_.setpoint_rad());
  limiter_.reset(X_WE_);
  watch_.reset(joints_.setpoint_rad(), X_WE_);
  stall_detector_.reset();
  stands_.reset();
  line_.see(0.0);
  conditioning_ = 1.0;
  turning_ = around_ = false;
  force_persists_ = false;
  home_rad_ = joints_.path_rad();
}

Clamps SlaveMotion::step(const MotionInput& input) {
  const bool waits = input.X_WE_goal && !touches(input);
  const bool ends = waits && stall_detector_.ends(X_WE_, *input.X_WE_goal, input.dt);
  if (!ends) stands_.reset();
  if (!waits) stall_detector_.reset();
  Clamps clamps = stands_.value_or(Clamps{});
  limit_for_load(input.load_kg);
  find_approach_speed();
  line_.begin(joints_.path_rad());
  const LimiterOutput wanted = limiter_.step(
      {stands_ ? std::nullopt : input.X_WE_goal, input.contact, input.dt, input.let_go, input.moment,
       input.tool_m.value_or(X_WE_.p), approach_.braking_m_per_s2(), approach_.speed_m_per_s(), &line_});
  const ReachEnd end = wanted.reach ? line_.end() : ReachEnd{};
  if (end.ends) (end.joint > 0 ? clamps.joint_position : clamps.unreachable) = true;
  unknown_space_ = wanted.unknown_space;
  clamps.tool_speed = wanted.tool_speed;
  clamps.acceleration = wanted.acceleration;
  clamps.workspace = wanted.workspace;
  clamps.force_guard = wanted.force_guard;
  clamps.moment_guard = wanted.moment_guard;
  force_persists_ = wanted.force_persists;

  const bool stands = wanted.reach && waits && far_from(*input.X_WE_goal);
  const bool around = tries_around(stands ? input.X_WE_goal : std::nullopt, input.dt);
  if (!limiter_.at_rest() || around) {
    const InverseResult found = invert(wanted.X_WE, input, around);
    around_ = around && turning_;
    const bool plain = found.status == InverseStatus::kFound && joints_.reaches(found.joint_rad, input.dt);
    const JointsLimited limited = joints_.step(found.joint_rad, plain ? ToolBound{} : tool_bound(), input.dt);
    conditioning_ = found.conditioning;
    line_.see(conditioning_);
    if (plain && conditioning_ >= kSingularBand) home_rad_ = joints_.path_rad();
    clamps.joint_speed = limited.speed || line_.slowed();
    clamps.acceleration |= limited.acceleration;
    clamps.joint_position |= limited.position || found.at_joint_limit;
    clamps.unreachable |= found.status == InverseStatus::kNearest;
    clamps.singularity |= found.status == InverseStatus::kSingular || conditioning_ < kSingularBand;
    if (found.status == InverseStatus::kNearest) ++failures_;
    if (limited.any()) {
      limiter_.correct(kinematics().forward(joints_.path_rad()), input.dt);
    } else if (found.status != InverseStatus::kFound || found.rotation_ignored) {
      limiter_.correct(found.X_WE, input.dt);
    }
  } else {
    const bool moves = !joints_.at_rest();  // the joints still brake after the tool has stopped
    joints_.step(joints_.path_rad(), moves ? tool_bound() : ToolBound{}, input.dt);
    if (moves) limiter_.correct(kinematics().forward(joints_.path_rad()), input.dt);
  }
  if (clamps.joint_position)
    clamps.joint = named(end.joint > 0 ? end : inverse_.limit_of(joints_.path_rad(), kAtLimit_rad));
  if (ends && (clamps.unreachable || clamps.joint_position || clamps.singularity)) {
    stands_ = clamps;
    stands_->unreachable = true;  // from here
  }
  if (!joints_.settled()) X_WE_ = kinematics().forward(joints_.setpoint_rad());
  watch(input);
  return clamps;
}

// The limits in force are those of the command or, while the gripper may hold a load, lower ones.
void SlaveMotion::limit_for_load(double load_kg) {
  const CommandConfig limits = with_load(command_, load_kg);
  limiter_.configure(limits);
  line_.configure(limits);
  const auto reduced = [](double limit, double configured) { return limit < configured ? limit : 0.0; };
  load_acceleration_m_per_s2_ = reduced(limits.acceleration_max_m_per_s2, command_.acceleration_max_m_per_s2);
  load_acceleration_rad_per_s2_ =
      reduced(limits.acceleration_max_rad_per_s2, command_.acceleration_max_rad_per_s2);
}

// The deceleration that the joints permit changes slowly, so it is computed in every 32nd tick while the tool moves.
void SlaveMotion::find_approach_speed() {
  constexpr int kTicks = 32;
  constexpr double kDamping = 1e-12;  // of JᵀJ: arms with fixed joints have columns of zeros
  constexpr double kSlow_m_per_s = 5e-3;
  const Vector3& v = limiter_.velocity().linear;
  const double speed = v.norm();
  if (approach_ticks_ > 0) --approach_ticks_;
  if (approach_ticks_ > 0 || !(speed > kSlow_m_per_s)) return;
  approach_ticks_ = kTicks;
  Vector6 along = Vector6::Zero();
  along.tail<3>() = v / speed;
  const double length_m = kinematics().motion_length_m();
  const JointStep joints = damped_step(kinematics().rigid_with_jacobian(joints_.path_rad()).J, length_m,
                                       along, kDamping * length_m * length_m, 0.0);
  approach_.permit(1.0 / joints_.braking_s(joints.joint_rad));
}

// Farther than the goal of an operator runs ahead of a robot that is held back (master/mapping/mapping.hpp).
bool SlaveMotion::far_from(const Pose& X_WE_goal) const {
  constexpr double kFar_m = 0.01, kFarTurn_rad = 0.1;
  return (X_WE_goal.p - X_WE_.p).norm() > kFar_m || X_WE_goal.q.angularDistance(X_WE_.q) > kFarTurn_rad;
}

// A tool that stands at the end of its line may be able to reach a goal beyond on another way. That is tried once the goal
// has been at rest for half a second, because the goal of an operator is drawn back to the tool, and in every 32nd tick
// from then on.
bool SlaveMotion::tries_around(const std::optional<Pose>& X_WE_goal, double dt) {
  constexpr double kRests_s = 0.5, kRests_m = 1e-3, kRests_rad = 0.01;
  constexpr int kTicks = 32;
  if (!X_WE_goal) {
    around_goal_.reset();
    return around_ = false;
  }
  if (!around_goal_ || (X_WE_goal->p - around_goal_->p).norm() > kRests_m ||
      X_WE_goal->q.angularDistance(around_goal_->q) > kRests_rad) {
    around_goal_ = X_WE_goal;
    around_ticks_ = static_cast<int>(kRests_s / dt);
  }
  if (around_ || !limiter_.at_rest() || --around_ticks_ > 0) return around_;
  around_ticks_ = kTicks;
  return true;
}

// Against a contact, the tool may brake harder; the setpoint follows within the ticks over which it is averaged.
void SlaveMotion::watch(const MotionInput& input) {
  if (input.contact.in_contact) braking_ticks_ = 2 + static_cast<int>(2.0 * joints_.lag_s() / input.dt);
  const bool braking = braking_ticks_ > 0;
  if (braking) --braking_ticks_;
  watch_.step(joints_.setpoint_rad(), X_WE_, command_, input.dt,
              braking ? command_.braking_max_m_per_s2 : 0.0);
}

// Returns whether the joints can move this way in a tick at constant speed.
bool SlaveMotion::follows(const JointVector& way_rad, double dt) const {
  for (int i = 0; i < kMaxJoints; ++i) {
    const double most = kFollows * robot_.joint[static_cast<std::size_t>(i)].speed_max_rad_per_s * dt;
    if (!(std::abs(way_rad[i]) <= most)) return false;
  }
  return true;
}

// Returns the number of ticks in which the joints move this way proportionally and can stop at its end.
double SlaveMotion::ticks_for(const JointVector& way_rad, double dt) const {
  double ticks = 1.0;
  for (int i = 0; i < kMaxJoints; ++i) {
    const JointConfig& j = robot_.joint[static_cast<std::size_t>(i)];
    const double left = std::abs(way_rad[i]);
    const double speed = std::min(kTurningShare * j.speed_max_rad_per_s,
                                  braking_speed(left, kTurningShare * j.acceleration_max_rad_per_s2, dt));
    if (left > 0.0) ticks = std::max(ticks, left / (speed * dt));
  }
  return ticks;
}

// Returns true if the tool does not leave the workspace on this joint path, and is nowhere farther from the goal than it is
// now by more than `aside_m`.
bool SlaveMotion::leads_nearer(const JointVector& way_rad, const Rigid& X_WE_goal, double aside_m) const {
  const auto within = [&](double share) {
    return limiter_.within(kinematics().rigid_forward(joints_.path_rad() + share * way_rad).p);
  };
  const bool inside = within(0.0);
  for (const double share : {0.125, 0.25, 0.5, 0.75})
    if (inside && !within(share)) return false;
  return inverse_.aside_m(X_WE_goal, joints_.path_rad(), way_rad) <= aside_m;
}

// Returns the joints for a pose one tick away. At a singular pose, or where the arm cannot follow the path,
// the joints move straight to the solution at the goal (fewer than six joints: or at the nearest pose), if the tool only approaches
// the goal on that path and touches nothing. At a singular pose, the last branch of the arm is preferred to
// the nearest one.
InverseResult SlaveMotion::invert(const Pose& X_WE, const MotionInput& input, bool around) {
  const InverseTolerance tolerance{command_.tolerance_m, command_.iterations_max};
  const JointVector& q = joints_.path_rad();
  InverseResult found = inverse_.follow(X_WE, q, tolerance);
  const bool singular =
      conditioning_ < kSingularBand || (found.joint_rad - q).cwiseAbs().maxCoeff() > kFarRad;
  if (!singular && !turning_ && !around && found.status != InverseStatus::kNearest) return found;
  const bool plain = found.status == InverseStatus::kFound && follows(found.joint_rad - q, input.dt);
  if (plain && !around && (!turning_ || conditioning_ > kLeftBehind)) {
    turning_ = false;
    return found;
  }
  const bool turned = turning_;
  turning_ = false;
  if (touches(input)) return found;
  const Pose X_WE_goal = limiter_.goal().value_or(X_WE);
  const double aside_m = singular || turned ? kSingularAside * kinematics().motion_length_m() : 0.0;
  const bool homes = singular && inverse_.closed().applies();  // a search would take too long
  for (const bool home : {true, false}) {
    if (home && !homes) continue;
    const InverseResult there = inverse_.solve(X_WE_goal, home ? home_rad_ : q,
                                               {command_.tolerance_m, home ? 1 : command_.iterations_max});
    const bool exact = there.status != InverseStatus::kNearest;
    const JointVector way = there.joint_rad - q;
    const bool stuck =
        around || found.status == InverseStatus::kNearest || way.cwiseAbs().maxCoeff() > kFarRad;
    turning_ = (singular || stuck) && (exact || (!home && !line_.applies())) &&
               leads_nearer(way, to_rigid(X_WE_goal), aside_m);
    if (!turning_) continue;
    found.joint_rad = q + way / ticks_for(way, input.dt);
    found.X_WE = kinematics().forward(found.joint_rad);
    found.status = exact ? InverseStatus::kSingular : InverseStatus::kNearest;
    break;
  }
  return found;
}

ToolBound SlaveMotion::tool_bound() const {
  constexpr double kMean =
      0.98;  // at the mean of joint positions the tool may be faster than at each of them
  return {kinematics().rigid_with_jacobian(joints_.path_rad()).J, kMean * command_.speed_max_rad_per_s,
          kMean * command_.speed_max_m_per_s};
}

}  // namespace longreach
