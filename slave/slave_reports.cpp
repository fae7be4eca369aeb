#include "slave/slave_reports.hpp"

#include <algorithm>

namespace longreach {
namespace {

void merge(Clamps& all, const Clamps& one) {
  all.tool_speed = all.tool_speed || one.tool_speed;
  all.joint_speed = all.joint_speed || one.joint_speed;
  all.joint_position = all.joint_position || one.joint_position;
  all.workspace = all.workspace || one.workspace;
  all.force_guard = all.force_guard || one.force_guard;
  all.singularity = all.singularity || one.singularity;
  all.unreachable = all.unreachable || one.unreachable;
  all.acceleration = all.acceleration || one.acceleration;
  all.moment_guard = all.moment_guard || one.moment_guard;
  if (one.joint != 0) all.joint = one.joint;
}

// The goal may not run ahead of a tool that is held back: while it moves, that is told more often than by the
// heartbeat.
constexpr double kReportedAfter_m = 5e-4, kReportedAfter_rad = 5e-3, kReportedAfter_s = 0.1;

// The master holds if it receives nothing for 0.5 s, and the operator then loses the displayed force. At this rate, that
// takes 30 lost datagrams in a row, as many as the slave tolerates. A burst of 17, which the sum of telemetry and
// heartbeat gave, occurs several times an hour if 2 % of the datagrams are lost in bursts of 4.
constexpr double kEngaged_hz = 60.0;

// In free space the next heartbeat comes after half a second. Since a report that a surface is left or gone may be lost, it
// is repeated for this time at this rate.
constexpr double kNews_s = 0.3, kNews_hz = 10.0;

bool same(const ReportedSurface& a, const ReportedSurface& b) {
  return a.touch == b.touch && a.pressed == b.pressed && a.stiffness == b.stiffness && a.foot == b.foot;
}

bool changed(const ContactReport& now, const ContactReport& reported) {
  return !std::ranges::equal(now.surfaces, reported.surfaces, same) ||
         now.held_back.isZero(0.0) != reported.held_back.isZero(0.0);
}

bool moved(const ContactReport& now, const ContactReport& reported, double far) {
  return !now.held_back.isZero(0.0) && (now.place - reported.place).norm() > far;
}

ContactReport report_of(const ContactAtPlace& at) {
  ContactReport report{
      .surfaces = at.contact.report(at.anchor), .held_back = at.held_back, .threshold = at.contact.touch_n()};
  if (!at.held_back.isZero(0.0)) report.place = at.place;
  return report;
}

}  // namespace

void SlaveReports::configure(const SlaveConfig& config) {
  link_ = config.link;
  guard_n_ = config.sensing.force ? config.command.force_guard_n : 0.0;
  guard_nm_ = measures_moment(config.sensing) ? config.command.moment_guard_nm : 0.0;
}

void SlaveReports::report(const SlaveInput& input, const SlaveView& view, std::uint64_t reached_sequence,
                          const PlayedGoals& goals, const ContactAtPlace& translation,
                          const ContactAtPlace& rotation, SlaveOutput& output) {
  const ContactReport linear = report_of(translation), angular = report_of(rotation);
  const bool felt = changed(linear, reported_.translation) || changed(angular, reported_.rotation);
  const bool news = view.state != reported_.state || view.engagement != reported_.engagement ||
                    view.cause != reported_.cause || view.refused != reported_.refused ||
                    view.refusal != reported_.refusal || view.gripper.closed != reported_.gripper_closed ||
                    view.gripper.holds != reported_.load || felt;
  const bool elsewhere = moved(linear, reported_.translation, kReportedAfter_m) ||
                         moved(angular, reported_.rotation, kReportedAfter_rad);
  if (felt) news_at_ = input.now;
  const bool repeats = news_at_ && input.now - *news_at_ < from_seconds(kNews_s);
  const double free_hz = std::max(link_.heartbeat_free_hz, repeats ? kNews_hz : 0.0);
  const bool touching = linear.in_contact() || angular.in_contact();
  if (news || (elsewhere && input.now - reported_at_ >= from_seconds(kReportedAfter_s))) reports_.hurry();
  if (!input.may_send || !reports_.due(input.now, touching ? link_.heartbeat_contact_hz : free_hz)) return;
  translation.contact.locate_touches(goals.positions, goals.anchor_m, goals.sequence);
  rotation.contact.locate_touches(goals.turns, Vector3::Zero(), goals.turn_sequence);
  reported_.engagement = view.engagement;
  reported_.state = view.state;
  reported_.cause = view.cause;
  reported_.refused = view.refused;
  reported_.refusal = view.refusal;
  reported_.gripper_closed = view.gripper.closed;
  reported_.load = view.gripper.holds;
  reported_.approach_m_per_s = view.approach_m_per_s;
  reported_.translation = report_of(translation);
  reported_.translation.guard = guard_n_;
  reported_.rotation = report_of(rotation);
  reported_.rotation.guard = guard_nm_;
  reported_.reached_sequence = reached_sequence;
  reported_at_ = input.now;
  output.report = reported_;
  output.report_sequence = ++report_sequence_;
}

void SlaveReports::telemetry(const SlaveInput& input, const SlaveView& view, bool robot_ok,
                             double penetration_m, SlaveOutput& output) {
  merge(clamps_, view.clamps);
  const double least_hz = view.state == SafetyState::kEngaged ? kEngaged_hz : 0.0;
  if (!input.may_send || !telemetry_.due(input.now, std::max(link_.telemetry_hz, least_hz))) return;
  Telemetry t;
  t.state = view.state;
  t.cause = view.cause;
  t.engagement = view.engagement;
  t.X_WE = view.X_WE;
  t.X_WE_goal = view.X_WE_goal;
  if (robot_ok) t.joint_rad = input.robot.joint_rad;
  t.F_E_W = view.F_E_W;
  t.estimate = view.estimate;
  t.penetration_m = penetration_m;
  t.clamps = clamps_;
  t.up_loss = input.up_loss;
  t.up_jitter_s = input.up_jitter_s;
  t.playout_delay_s = view.playout_delay_s;
  t.rejected = input.rejected;
  t.limit_violations = view.limit_violations;
  t.late_ticks = input.late_ticks;
  t.gripper = view.gripper;
  t.reduced = view.reduced;
  t.load_acceleration_m_per_s2 = view.load_acceleration_m_per_s2;
  t.load_acceleration_rad_per_s2 = view.load_acceleration_rad_per_s2;
  clamps_ = {};
  output.telemetry = t;
  output.telemetry_sequence = ++telemetry_sequence_;
}

}  // namespace longreach
