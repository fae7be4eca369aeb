#include "slave/slave_reports.hpp"

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
}

bool same_touch(const SlaveContact& contact, const ContactStiffness& told) {
  return contact.touch() == told.touch && contact.in_contact() == told.in_contact;
}

}  // namespace

bool Pace::due(Time now, double rate_hz) {
  if (next_ && now < *next_) return false;
  const Duration period = from_seconds(1.0 / rate_hz);
  next_ = next_ && now < *next_ + period ? *next_ + period : now + period;
  return true;
}

void SlaveReports::report(const SlaveInput& input, const SlaveView& view, std::uint64_t reached_sequence,
                          const PlayedGoals& goals, SlaveContact& contact, SlaveContact& turn_contact,
                          SlaveOutput& output) {
  const bool changed = view.state != reported_.state || view.engagement != reported_.engagement ||
                       view.cause != reported_.cause || !same_touch(contact, reported_.translation) ||
                       contact.reported_n_per_m() != reported_n_per_m_ ||
                       !same_touch(turn_contact, reported_.rotation) ||
                       turn_contact.reported_n_per_m() != reported_nm_per_rad_;
  const bool touching = contact.in_contact() || turn_contact.in_contact();
  if (changed) reports_.hurry();
  if (!input.may_send ||
      !reports_.due(input.now, touching ? link_.heartbeat_contact_hz : link_.heartbeat_free_hz))
    return;
  contact.locate_touch(goals.positions, goals.anchor_m, goals.sequence);
  turn_contact.locate_touch(goals.turns, Vector3::Zero(), goals.turn_sequence);
  reported_.engagement = view.engagement;
  reported_.state = view.state;
  reported_.cause = view.cause;
  reported_.translation = contact.report();
  reported_.rotation = turn_contact.report();
  reported_.reached_sequence = reached_sequence;
  reported_n_per_m_ = contact.reported_n_per_m();
  reported_nm_per_rad_ = turn_contact.reported_n_per_m();
  output.report = reported_;
  output.report_sequence = ++report_sequence_;
}

void SlaveReports::telemetry(const SlaveInput& input, const SlaveView& view, bool robot_ok,
                             double penetration_m, SlaveOutput& output) {
  merge(clamps_, view.clamps);
  if (!input.may_send || !telemetry_.due(input.now, link_.telemetry_hz)) return;
  Telemetry t;
  t.state = view.state;
  t.cause = view.cause;
  t.engagement = view.engagement;
  t.X_WE = view.X_WE;
  t.X_WE_goal = view.X_WE_goal;
  if (robot_ok) {
    for (int i = 0; i < kMaxJoints; ++i) t.joint_rad[static_cast<std::size_t>(i)] = input.robot.joint_rad[i];
  }
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
  t.load = input.robot.load;
  clamps_ = {};
  output.telemetry = t;
  output.telemetry_sequence = ++telemetry_sequence_;
}

}  // namespace longreach
