// A robot that does not do what it is asked for, or tells what is not so.

#include "tests/faults/world.hpp"

namespace longreach {
namespace {

int joint_of(const Active& fault) { return static_cast<int>(fault.fault.seed % kMaxJoints); }

/// In the end somebody restarts the robot, as the words of the fault ask for.
bool restarted(const Active& fault, RobotState& reported) {
  if (fault.age_s < fault.fault.duration_s - 0.02) return false;
  reported.ok = false;
  return true;
}

void jump(World&, Active& fault, RobotState& reported) {
  if (restarted(fault, reported)) return;
  reported.joint_rad[joint_of(fault)] += log_scale(fault.fault.size, 1e-3, 1.0);
}
void freeze(World&, Active& fault, RobotState& reported) {
  if (fault.begins) fault.robot = reported;
  if (restarted(fault, reported)) return;
  reported.joint_rad = fault.robot.joint_rad;
  reported.joint_rad_per_s.setZero();
}
void leave_range(World& world, Active& fault, RobotState& reported) {
  if (restarted(fault, reported)) return;
  const JointConfig& joint = world.scenario().slave.robot.joint[static_cast<std::size_t>(joint_of(fault))];
  reported.joint_rad[joint_of(fault)] = joint.max_rad + log_scale(fault.fault.size, 0.01, 10.0);
}
void jitter(World&, Active& fault, RobotState& reported) {
  for (int i = 0; i < kMaxJoints; ++i) {
    reported.joint_rad[i] += log_scale(fault.fault.size, 1e-7, 1e-4) * fault.random.normal();
    reported.joint_rad_per_s[i] += log_scale(fault.fault.size, 1e-5, 1e-2) * fault.random.normal();
  }
}
void protective_stop(World&, Active&, RobotState& reported) { reported.ok = false; }
/// The operator asks for an engagement again and again while the robot fails.
void ask_meanwhile(World& world, Active&) { world.requests.engage = world.levels.impatient = true; }

void stand(World& world, Active& fault, JointVector& setpoint) {
  if (fault.begins) fault.robot = world.moment().truth;
  setpoint = fault.robot.joint_rad;
}
/// By somebody, with the pendant: as far as half a radian, softly.
void move(World& world, Active& fault, JointVector& setpoint) {
  if (fault.begins) fault.robot = world.moment().truth;
  const double share = fault.age_s / fault.fault.duration_s;
  setpoint = fault.robot.joint_rad;
  setpoint[joint_of(fault)] += log_scale(fault.fault.size, 0.005, 0.5) * share * share * (3.0 - 2.0 * share);
}
void lag(World&, Active& fault, JointVector& setpoint) {
  fault.queue.push_back(setpoint);
  const auto ticks = static_cast<std::size_t>(1e3 * log_scale(fault.fault.size, 0.005, 0.2));
  if (fault.queue.size() > ticks) fault.queue.pop_front();
  setpoint = fault.queue.front();
}
/// Its drives, not its brakes.
void creep(World& world, Active& fault, JointVector& setpoint) {
  if (!world.moment().moves) return;
  setpoint[joint_of(fault)] += fault.age_s * log_scale(fault.fault.size, 1e-4, 0.05);
}

/// An adapter that answers late: what it told last is told again, and the robot gets nothing new.
bool stalls(Active& fault) {
  if (fault.count == 0 && !fault.random.chance(0.02)) return false;
  const auto ticks = static_cast<std::uint64_t>(1e3 * log_scale(fault.fault.size, 0.005, 0.1));
  fault.count = fault.count == 0 ? ticks : fault.count - 1;
  return fault.count != 0;
}
void report_again(const World& world, Active& fault, RobotState& reported) {
  if (fault.level == 0.0 || fault.begins) fault.robot = reported;
  reported = fault.robot;
  fault.robot.age_s += world.moment().period_s;
}
void stall_reported(World& world, Active& fault, RobotState& reported) {
  fault.level = stalls(fault) ? 1.0 : 0.0;
  report_again(world, fault, reported);
}
void stall_setpoint(World&, Active& fault, JointVector& setpoint) {
  if (fault.queue.empty() || fault.level == 0.0) fault.queue = {setpoint};
  setpoint = fault.queue.front();
}
/// One that answers 125 times a second.
void slow_reported(World& world, Active& fault, RobotState& reported) {
  fault.level = fault.count++ % 8 == 0 ? 0.0 : 1.0;
  report_again(world, fault, reported);
}

constexpr std::string_view kGroup = "robot";
constexpr auto kJoints = only(AffectedSignal::kJoints), kRobot = only(AffectedSignal::kRobot);
constexpr auto kBoth = static_cast<std::uint16_t>((AffectedSignal::kRobot | AffectedSignal::kJoints) |
                                                  only(AffectedSignal::kSensor));

const FaultKind kKinds[] = {
    {.name = "joints-jump", .group = kGroup, .affects = kJoints, .longest_s = 3.0, .robot = jump},
    {.name = "joints-freeze", .group = kGroup, .affects = kJoints, .longest_s = 3.0, .robot = freeze},
    {.name = "joints-leave-range",
     .group = kGroup,
     .affects = kJoints,
     .longest_s = 3.0,
     .robot = leave_range},
    {.name = "joints-noisy", .group = kGroup, .affects = kJoints, .robot = jitter},
    {.name = "protective-stop",
     .group = kGroup,
     .affects = kRobot,
     .longest_s = 3.0,
     .robot = protective_stop,
     .setpoint = stand},
    {.name = "protective-stop-while-engaging",
     .group = kGroup,
     .affects = AffectedSignal::kRobot | AffectedSignal::kOperator,
     .longest_s = 3.0,
     .shortest_s = 0.05,
     .besides = 0.15,
     .act = ask_meanwhile,
     .robot = protective_stop,
     .setpoint = stand},
    {.name = "robot-blocked", .group = kGroup, .affects = kRobot, .longest_s = 3.0, .setpoint = stand},
    {.name = "robot-moved", .group = kGroup, .affects = kRobot, .longest_s = 4.0, .setpoint = move},
    {.name = "robot-lags", .group = kGroup, .affects = kRobot, .setpoint = lag},
    {.name = "robot-creeps", .group = kGroup, .affects = kRobot, .longest_s = 10.0, .setpoint = creep},
    {.name = "robot-adapter-stalls",
     .group = kGroup,
     .affects = kBoth,
     .robot = stall_reported,
     .setpoint = stall_setpoint},
    {.name = "robot-at-125-hz",
     .group = kGroup,
     .affects = kBoth,
     .robot = slow_reported,
     .setpoint = stall_setpoint},
};

}  // namespace

std::span<const FaultKind> robot_kinds() { return kKinds; }

}  // namespace longreach
