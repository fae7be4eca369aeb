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

// A goal behind a remembered surface is proof that the surface has gone only together with the tool's place:
// while the tool moves, it is reported more often than by the heartbeat.
constexpr double kReportedAfter_m = 5e-4, kReportedAfter_rad = 5e-3, kReportedAfter_s = 0.1;

bool changed(const ContactAtPlace& now, const ContactStiffness& reported) {
  return now.contact.touch() != reported.touch || now.contact.in_contact() != reported.in_contact ||
         now.held_back.isZero(0.0) != reported.held_back.isZero(0.0);
}

/// The place takes bytes only where it proves something: where nothing is touched though something was, where
/// a limit is, where no goal has told of the surface.
bool proves(const ContactAtPlace& at) {
  return (at.contact.touch() > 0 && !at.contact.in_contact()) || !at.held_back.isZero(0.0) ||
         at.contact.older();
}

bool moved(const ContactAtPlace& now, const ContactStiffness& reported, double far) {
  return proves(now) && (now.place - reported.place).norm() > far;
}

ContactStiffness report_of(const ContactAtPlace& at) {
  ContactStiffness report = at.contact.report();
  report.held_back = at.held_back;
  if (at.contact.older()) report.surface = at.contact.surface_point() - at.anchor;
  if (proves(at)) report.place = at.place;
  return report;
}

}  // namespace

bool Pace::due(Time now, double rate_hz) {
  if (next_ && now < *next_) return false;
  const Duration period = from_seconds(1.0 / rate_hz);
  next_ = next_ && now < *next_ + period ? *next_ + period : now + period;
  return true;
}

void SlaveReports::report(const SlaveInput& input, const SlaveView& view, std::uint64_t reached_sequence,
                          const PlayedGoals& goals, const ContactAtPlace& translation,
                          const ContactAtPlace& rotation, SlaveOutput& output) {
  const bool news = view.state != reported_.state || view.engagement != reported_.engagement ||
                    view.cause != reported_.cause || changed(translation, reported_.translation) ||
                    translation.contact.reported_n_per_m() != reported_n_per_m_ ||
                    changed(rotation, reported_.rotation) ||
                    rotation.contact.reported_n_per_m() != reported_nm_per_rad_;
  const bool elsewhere = moved(translation, reported_.translation, kReportedAfter_m) ||
                         moved(rotation, reported_.rotation, kReportedAfter_rad);
  const bool touching = translation.contact.in_contact() || rotation.contact.in_contact();
  if (news || (elsewhere && input.now - reported_at_ >= from_seconds(kReportedAfter_s))) reports_.hurry();
  if (!input.may_send ||
      !reports_.due(input.now, touching ? link_.heartbeat_contact_hz : link_.heartbeat_free_hz))
    return;
  translation.contact.locate_touch(goals.positions, goals.anchor_m, goals.sequence);
  rotation.contact.locate_touch(goals.turns, Vector3::Zero(), goals.turn_sequence);
  reported_.engagement = view.engagement;
  reported_.state = view.state;
  reported_.cause = view.cause;
  reported_.translation = report_of(translation);
  reported_.rotation = report_of(rotation);
  reported_.reached_sequence = reached_sequence;
  reported_n_per_m_ = translation.contact.reported_n_per_m();
  reported_nm_per_rad_ = rotation.contact.reported_n_per_m();
  reported_at_ = input.now;
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
