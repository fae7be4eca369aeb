#include "slave/recording/slave_record_buffer.hpp"

#include "common/recording/record_rates.hpp"
#include "common/recording/recorded_values.hpp"

namespace longreach {

static_assert(sizeof(RobotState) == 160 && sizeof(SlaveInput) == 272);
static_assert(sizeof(SlaveOutput) == 1168 && sizeof(SlaveView) == 896);

SlaveRecordBuffer::SlaveRecordBuffer(double rate_hz, Duration to_log_time)
    : RecordBuffer("slave", to_log_time),
      view_every_(ticks_between(rate_hz, kViewHz)),
      link_every_(ticks_between(rate_hz, kLinkHz)),
      ring_(record_capacity(rate_hz)) {}

void SlaveRecordBuffer::add_tick(std::uint64_t tick, std::uint32_t config, const SlaveInput& input,
                                 const SlaveOutput& output, const SlaveView& view) {
  if (!open()) return;
  // All of a tick or nothing: an input without its messages is of no use.
  if (ring_.room() < input.commands.size() + 2) {
    drop_tick();
    return;
  }
  for (const auto& command : input.commands) ring_.next() = command;
  auto& record = ring_.next().emplace<SlaveTickRecord>();
  record.tick = tick;
  record.config = config;
  record.commands = static_cast<std::uint32_t>(input.commands.size());
  record.input = input;
  record.input.commands = {};
  record.output = output;
  if (tick % view_every_ == 0) ring_.next() = ViewRecord{tick, input.now, view};
  ring_.publish();
}

void SlaveRecordBuffer::add_link(const LinkSample& sample) {
  if (!open() || ring_.room() == 0) return;
  ring_.next() = sample;
  ring_.publish();
}

void SlaveRecordBuffer::declare_ticks(McapWriter& writer) {
  command_channel_ = writer.add_channel(topic("received_command"), *command_.descriptor());
  tick_channel_ = writer.add_channel(topic("tick"), *tick_.descriptor());
  view_channel_ = writer.add_channel(topic("view"), *view_.descriptor());
}

void SlaveRecordBuffer::drain_ticks(McapWriter& writer) {
  for (std::size_t i = 0; i < ring_.capacity(); ++i) {
    const Record* record = ring_.front();
    if (record == nullptr) return;
    std::visit([this, &writer](const auto& r) { write_record(r, writer); }, *record);
    ring_.pop();
  }
}

void SlaveRecordBuffer::write_record(const Received<MotionCommand>& record, McapWriter& writer) {
  command_.Clear();
  write(record, command_);
  writer.write(command_channel_, log_time_ns(record.received), command_);
}

void SlaveRecordBuffer::write_record(const SlaveTickRecord& record, McapWriter& writer) {
  tick_.Clear();
  tick_.set_tick(record.tick);
  tick_.set_config(record.config);
  write(record.input, *tick_.mutable_input());
  tick_.mutable_input()->set_commands(record.commands);
  write(record.output, *tick_.mutable_output());
  writer.write(tick_channel_, log_time_ns(record.input.now), tick_);
}

void SlaveRecordBuffer::write_record(const ViewRecord& record, McapWriter& writer) {
  view_.Clear();
  write(record.view, view_);
  view_.set_tick(record.tick);
  writer.write(view_channel_, log_time_ns(record.now), view_);
}

void write(const SlaveInput& input, recording::SlaveInput& out) {
  out.set_now_ns(to_ns(input.now));
  recording::Robot& robot = *out.mutable_robot();
  write_joints(input.robot.joint_rad, *robot.mutable_joint_rad());
  write_joints(input.robot.joint_rad_per_s, *robot.mutable_joint_rad_per_s());
  write(input.robot.F_F_W, *robot.mutable_wrench());
  robot.set_ok(input.robot.ok);
  robot.set_load(input.robot.load);
  robot.set_age_s(input.robot.age_s);
  if (input.last_heard) out.set_last_heard_ns(to_ns(*input.last_heard));
  out.set_peer_session_count(input.peer_session_count);
  out.set_taken(input.taken);
  out.set_stop(input.stop);
  out.set_send_hz(input.send_hz);
  out.set_rejected(input.rejected);
  out.set_late_ticks(input.late_ticks);
  out.set_up_loss(input.up_loss);
  out.set_up_jitter_s(input.up_jitter_s);
  out.set_may_send(input.may_send);
  out.set_overdue_ticks(input.overdue_ticks);
}

SlaveInput read(const recording::SlaveInput& in) {
  SlaveInput out;
  out.now = to_time(in.now_ns());
  out.robot.joint_rad = read_joints<JointVector>(in.robot().joint_rad());
  out.robot.joint_rad_per_s = read_joints<JointVector>(in.robot().joint_rad_per_s());
  out.robot.F_F_W = read(in.robot().wrench());
  out.robot.ok = in.robot().ok();
  out.robot.load = in.robot().load();
  out.robot.age_s = in.robot().age_s();
  if (in.has_last_heard_ns()) out.last_heard = to_time(in.last_heard_ns());
  out.peer_session_count = in.peer_session_count();
  out.taken = in.taken();
  out.stop = in.stop();
  out.send_hz = in.send_hz();
  out.rejected = in.rejected();
  out.late_ticks = in.late_ticks();
  out.up_loss = in.up_loss();
  out.up_jitter_s = in.up_jitter_s();
  out.may_send = in.may_send();
  out.overdue_ticks = in.overdue_ticks();
  return out;
}

void write(const SlaveOutput& output, recording::SlaveOutput& out) {
  if (output.joint_setpoint_rad) write_joints(*output.joint_setpoint_rad, *out.mutable_joint_setpoint_rad());
  if (output.grip) out.set_grip(*output.grip);
  if (output.report) write(*output.report, *out.mutable_report());
  out.set_report_sequence(output.report_sequence);
  if (output.telemetry) write(*output.telemetry, *out.mutable_telemetry());
  out.set_telemetry_sequence(output.telemetry_sequence);
}

void write(const SlaveView& v, recording::SlaveView& out) {
  out.set_state(to_recorded<recording::State>(v.state));
  out.set_cause(to_recorded<recording::Cause>(v.cause.cause));
  out.set_engagement(v.engagement);
  write(v.X_WE, *out.mutable_tool());
  write(v.X_WE_anchor, *out.mutable_anchor());
  write(v.X_WE_goal, *out.mutable_goal());
  write(v.F_E_W, *out.mutable_wrench());
  out.set_in_contact(v.in_contact);
  write(v.estimate, *out.mutable_estimate());
  out.set_reported_stiffness_n_per_m(v.reported_stiffness_n_per_m);
  write(v.turn_estimate, *out.mutable_turn_estimate());
  out.set_reported_stiffness_nm_per_rad(v.reported_stiffness_nm_per_rad);
  write(v.reported_at_m, *out.mutable_reported_at_m());
  out.set_touch_sequence(v.touch_sequence);
  out.set_touch(v.touch);
  out.set_played_sequence(v.played_sequence);
  out.set_playout_delay_s(v.playout_delay_s);
  write(v.clamps, *out.mutable_clamps());
  out.set_limit_violations(v.limit_violations);
  out.set_false_holds(v.false_holds);
  out.set_rejected_values(v.rejected_values);
  out.set_ik_failures(v.ik_failures);
}

}  // namespace longreach
