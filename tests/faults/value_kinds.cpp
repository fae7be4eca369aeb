// Numbers that are none, or that nobody could mean: in what devices and robot tell, and in authentic
// datagrams of a side that has gone mad.

#include <array>
#include <limits>

#include "tests/faults/world.hpp"

namespace longreach {
namespace {

/// NaN, infinities, extremes, denormals.
double wild(Random& random) {
  using Limits = std::numeric_limits<double>;
  constexpr std::array kWild = {Limits::quiet_NaN(),
                                Limits::infinity(),
                                -Limits::infinity(),
                                Limits::max(),
                                Limits::lowest(),
                                1e300,
                                -1e300,
                                1e30,
                                1e6,
                                Limits::denorm_min(),
                                -Limits::min(),
                                -0.0};
  return kWild[random.next() % kWild.size()];
}
void mark_affected(Vector3& v, Random& random) { v[static_cast<int>(random.next() % 3)] = wild(random); }
bool now(Active& fault) { return fault.begins || fault.random.chance(0.02); }

void handle_numbers(World&, Active& fault, HandleState& reported) {
  if (!now(fault)) return;
  const std::array<Vector3*, 3> fields = {&reported.p_MH, &reported.velocity_m_per_s,
                                          &reported.angular_rad_per_s};
  mark_affected(*fields[fault.random.next() % 3], fault.random);
}
void handle_quaternion(World&, Active& fault, HandleState& reported) {
  if (fault.fault.size < 0.3) {
    reported.q_MH.coeffs() *= -1.0;  // the same turn
  } else if (now(fault)) {
    reported.q_MH.coeffs() *= wild(fault.random);
  }
}
void joint_numbers(World&, Active& fault, RobotState& reported) {
  if (!now(fault)) return;
  const int joint = static_cast<int>(fault.random.next() % kMaxJoints);
  (fault.random.chance(0.5) ? reported.joint_rad : reported.joint_rad_per_s)[joint] = wild(fault.random);
}
void force_numbers(World&, Active& fault, RobotState& reported) {
  if (now(fault))
    mark_affected(fault.random.chance(0.7) ? reported.F_F_W.force : reported.F_F_W.moment, fault.random);
}

void command_numbers(World&, Active& fault, MasterOutput& out) {
  if (!out.command || !now(fault)) return;
  MotionCommand& c = *out.command;
  const double what = fault.random.uniform();
  if (what < 0.4) {
    mark_affected(c.position_m, fault.random);
  } else if (what < 0.7) {
    mark_affected(c.rotation_rad, fault.random);
  } else if (what < 0.9) {
    c.scale = wild(fault.random);
  } else {
    c.request = static_cast<Request>(fault.random.next() % 256);
  }
}
/// The goal leaps, as far as it may be.
void goal_leaps(World&, Active& fault, MasterOutput& out) {
  if (!out.command) return;
  if (fault.direction.isZero())
    fault.direction =
        Vector3(fault.random.normal(), fault.random.normal(), fault.random.normal()).normalized();
  const double far = log_scale(fault.fault.size, 0.01, 100.0);
  out.command->position_m += far * fault.direction;
  out.command->rotation_rad += std::min(far, 3.0) * fault.direction;
}
void report_numbers(World&, Active& fault, SlaveOutput& out) {
  if (!out.report) return;
  ContactReport& c = fault.random.chance(0.7) ? out.report->translation : out.report->rotation;
  ReportedSurface& s = c.surfaces[fault.random.next() % kSurfaces];
  s.touch += s.touch == 0;
  s.pressed = true;
  double* const numbers[] = {&s.stiffness, &s.foot, &s.offset, &s.normal.x(), &s.normal.y(), &s.normal.z()};
  *numbers[fault.random.next() % std::size(numbers)] = wild(fault.random);
  if (fault.random.chance(0.3)) s.touch_sequence = wild(fault.random);
}
/// Stiffness that changes with each report, by a thousand.
void report_leaps(World&, Active& fault, SlaveOutput& out) {
  if (!out.report) return;
  for (ReportedSurface& s : out.report->translation.surfaces)
    s.stiffness *= log_scale(fault.random.uniform(), 1e-3, 1e3);
}

constexpr std::string_view kGroup = "values";

const FaultKind kKinds[] = {
    {.name = "handle-numbers",
     .group = kGroup,
     .affects = AffectedSignal::kHandle | AffectedSignal::kOperator,
     .longest_s = 1.0,
     .handle = handle_numbers},
    {.name = "handle-quaternion",
     .group = kGroup,
     .affects = AffectedSignal::kHandle | AffectedSignal::kOperator,
     .longest_s = 1.0,
     .handle = handle_quaternion},
    {.name = "joint-numbers",
     .group = kGroup,
     .affects = only(AffectedSignal::kJoints),
     .longest_s = 1.0,
     .robot = joint_numbers},
    {.name = "force-numbers",
     .group = kGroup,
     .affects = only(AffectedSignal::kSensor),
     .longest_s = 1.0,
     .robot = force_numbers},
    {.name = "command-numbers",
     .group = kGroup,
     .affects = AffectedSignal::kMaster | AffectedSignal::kOperator,
     .longest_s = 2.0,
     .command = command_numbers},
    {.name = "goal-leaps",
     .group = kGroup,
     .affects = only(AffectedSignal::kMaster),
     .longest_s = 2.0,
     .command = goal_leaps},
    {.name = "report-numbers",
     .group = kGroup,
     .affects = only(AffectedSignal::kSlave),
     .report = report_numbers},
    {.name = "report-leaps",
     .group = kGroup,
     .affects = only(AffectedSignal::kSlave),
     .report = report_leaps},
};

}  // namespace

std::span<const FaultKind> value_kinds() { return kKinds; }

}  // namespace longreach
