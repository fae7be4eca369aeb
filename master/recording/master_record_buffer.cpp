#include "master/recording/master_record_buffer.hpp"

#include "common/recording/record_rates.hpp"
#include "common/recording/recorded_values.hpp"

namespace longreach {

static_assert(sizeof(HandleState) == 112 && sizeof(OperatorRequests) == 32);
static_assert(sizeof(MasterInput) == 256 && sizeof(MasterOutput) == 136 && sizeof(MasterView) == 1104);

MasterRecordBuffer::MasterRecordBuffer(double rate_hz, Duration to_log_time)
    : RecordBuffer("master", to_log_time),
      view_every_(ticks_between(rate_hz, kViewHz)),
      link_every_(ticks_between(rate_hz, kLinkHz)),
      ring_(record_capacity(rate_hz)) {}

void MasterRecordBuffer::add_tick(std::uint64_t tick, std::uint32_t config, const MasterInput& input,
                                  const MasterOutput& output, const MasterView& view) {
  if (!open()) return;
  // A tick is recorded completely or not at all, because an input without its messages is useless.
  if (ring_.room() < input.reports.size() + input.telemetry.size() + 2) {
    drop_tick();
    return;
  }
  for (const auto& report : input.reports) ring_.next() = report;
  for (const auto& telemetry : input.telemetry) ring_.next() = telemetry;
  auto& record = ring_.next().emplace<MasterTickRecord>();
  record.tick = tick;
  record.config = config;
  record.reports = static_cast<std::uint32_t>(input.reports.size());
  record.telemetry = static_cast<std::uint32_t>(input.telemetry.size());
  record.input = input;
  record.input.reports = {};
  record.input.telemetry = {};
  record.output = output;
  if (tick % view_every_ == 0) ring_.next() = ViewRecord{tick, input.now, view};
  ring_.publish();
}

void MasterRecordBuffer::add_link(const LinkSample& sample) {
  if (!open() || ring_.room() == 0) return;
  ring_.next() = sample;
  ring_.publish();
}

void MasterRecordBuffer::declare_ticks(McapWriter& writer) {
  report_channel_ = writer.add_channel(topic("received_report"), *report_.descriptor());
  telemetry_channel_ = writer.add_channel(topic("received_telemetry"), *telemetry_.descriptor());
  tick_channel_ = writer.add_channel(topic("tick"), *tick_.descriptor());
  view_channel_ = writer.add_channel(topic("view"), *view_.descriptor());
}

void MasterRecordBuffer::drain_ticks(McapWriter& writer) {
  for (std::size_t i = 0; i < ring_.capacity(); ++i) {
    const Record* record = ring_.front();
    if (record == nullptr) return;
    std::visit([this, &writer](const auto& r) { write_record(r, writer); }, *record);
    ring_.pop();
  }
}

void MasterRecordBuffer::write_record(const Received<StiffnessReport>& record, McapWriter& writer) {
  report_.Clear();
  write(record, report_);
  writer.write(report_channel_, log_time_ns(record.received), report_);
}

void MasterRecordBuffer::write_record(const Received<Telemetry>& record, McapWriter& writer) {
  telemetry_.Clear();
  write(record, telemetry_);
  writer.write(telemetry_channel_, log_time_ns(record.received), telemetry_);
}

void MasterRecordBuffer::write_record(const MasterTickRecord& record, McapWriter& writer) {
  tick_.Clear();
  tick_.set_tick(record.tick);
  tick_.set_config(record.config);
  write(record.input, *tick_.mutable_input());
  tick_.mutable_input()->set_reports(record.reports);
  tick_.mutable_input()->set_telemetry(record.telemetry);
  write(record.output, *tick_.mutable_output());
  writer.write(tick_channel_, log_time_ns(record.input.now), tick_);
}

void MasterRecordBuffer::write_record(const ViewRecord& record, McapWriter& writer) {
  view_.Clear();
  write(record.view, view_);
  view_.set_tick(record.tick);
  writer.write(view_channel_, log_time_ns(record.now), view_);
}

namespace {

void write(const HandleState& h, recording::Handle& out) {
  longreach::write(h.p_MH, *out.mutable_position_m());
  longreach::write(h.velocity_m_per_s, *out.mutable_velocity_m_per_s());
  longreach::write(h.q_MH, *out.mutable_orientation());
  longreach::write(h.angular_rad_per_s, *out.mutable_angular_rad_per_s());
  out.set_button_mode(h.buttons.mode);
  out.set_button_scale_up(h.buttons.scale_up);
  out.set_button_scale_down(h.buttons.scale_down);
  out.set_button_clutch(h.buttons.clutch);
  out.set_held(h.held);
  out.set_ok(h.ok);
}

HandleState read(const recording::Handle& in) {
  return {longreach::read(in.position_m()),
          longreach::read(in.velocity_m_per_s()),
          longreach::read(in.orientation()),
          longreach::read(in.angular_rad_per_s()),
          {in.button_mode(), in.button_scale_up(), in.button_scale_down(), in.button_clutch()},
          in.held(),
          in.ok()};
}

void write(const OperatorRequests& r, recording::OperatorRequests& out) {
  out.set_engage(r.engage);
  out.set_hold(r.hold);
  out.set_stop(r.stop);
  if (r.mode) out.set_mode(to_recorded<recording::Mode>(*r.mode));
  if (r.scale) out.set_scale(*r.scale);
  out.set_scale_steps(r.scale_steps);
  out.set_clutch(r.clutch);
  if (r.grip) out.set_grip(*r.grip);
  out.set_turns_gripper(r.turns_gripper);
}

OperatorRequests read(const recording::OperatorRequests& in) {
  OperatorRequests r;
  r.engage = in.engage();
  r.hold = in.hold();
  r.stop = in.stop();
  if (in.has_mode()) r.mode = read_enum(in.mode(), MotionMode::kPosition);
  if (in.has_scale()) r.scale = in.scale();
  r.scale_steps = in.scale_steps();
  r.clutch = in.clutch();
  if (in.has_grip()) r.grip = in.grip();
  r.turns_gripper = in.turns_gripper();
  return r;
}

}  // namespace

void write(const MasterInput& input, recording::MasterInput& out) {
  out.set_now_ns(to_ns(input.now));
  write(input.handle, *out.mutable_handle());
  write(input.requests, *out.mutable_requests());
  if (input.last_heard) out.set_last_heard_ns(to_ns(*input.last_heard));
  out.set_peer_restarts(input.peer_restarts);
  out.set_taken(input.taken);
  out.set_hand_stale(input.hand_stale);
  if (input.rtt_s) out.set_rtt_s(*input.rtt_s);
  out.set_may_send(input.may_send);
  out.set_overdue_ticks(input.overdue_ticks);
}

MasterInput read(const recording::MasterInput& in) {
  MasterInput out;
  out.now = to_time(in.now_ns());
  out.handle = read(in.handle());
  out.requests = read(in.requests());
  if (in.has_last_heard_ns()) out.last_heard = to_time(in.last_heard_ns());
  out.peer_restarts = in.peer_restarts();
  out.taken = in.taken();
  out.hand_stale = in.hand_stale();
  if (in.has_rtt_s()) out.rtt_s = in.rtt_s();
  out.may_send = in.may_send();
  out.overdue_ticks = in.overdue_ticks();
  return out;
}

void write(const MasterOutput& output, recording::MasterOutput& out) {
  write(output.F_H_M, *out.mutable_wrench());
  if (output.command) write(*output.command, *out.mutable_command());
  out.set_sequence(output.sequence);
}

void write(const MasterView& v, recording::MasterView& out) {
  out.set_state(to_recorded<recording::State>(v.state));
  out.set_cause(to_recorded<recording::Cause>(v.cause.cause));
  out.set_far_state(to_recorded<recording::State>(v.far_state));
  out.set_engagement(v.engagement);
  out.set_mode(to_recorded<recording::Mode>(v.mode));
  out.set_scale(v.scale);
  out.set_clutched(v.clutched);
  out.set_gripper_closed(v.gripper_closed());
  out.set_at_boundary(v.at_boundary);
  out.set_hand_missing(v.hand_missing);
  write(v.p_MH, *out.mutable_hand_m());
  write(v.goal_m, *out.mutable_goal_m());
  write(v.goal_rad, *out.mutable_goal_rad());
  write(v.forecast, *out.mutable_forecast());
  write(v.F_H_M, *out.mutable_wrench());
  write(v.spring_force_n, *out.mutable_spring_force_n());
  write(v.spring_moment_nm, *out.mutable_spring_moment_nm());
  out.set_in_contact(v.in_contact);
  out.set_surface_known(v.surface_known);
  out.set_surface_m(v.surface_m);
  write(v.inward, *out.mutable_inward());
  out.set_stiffness_n_per_m(v.stiffness_n_per_m);
  out.set_rotational_stiffness_nm_per_rad(v.rotational_stiffness_nm_per_rad);
  out.set_force_step_n(v.force_step_n);
  out.set_port_energy_j(v.port_energy_j);
  out.set_port_energy_min_j(v.port_energy_min_j);
  out.set_stored_energy_j(v.stored_energy_j);
  out.set_energy_drawdown_j(v.energy_drawdown_j);
  out.set_tank_j(v.tank_j);
  out.set_force_clamped(v.force_clamped);
  out.set_stiffness_clamped(v.stiffness_clamped);
  out.set_rotational_stiffness_clamped(v.rotational_stiffness_clamped);
  out.set_damping_injected(v.damping_injected);
  out.set_reports(v.reports);
  out.set_rejected_values(v.rejected_values);
  out.set_false_holds(v.false_holds);
  out.set_engaging(v.engaging);
  if (v.answer_in_s) out.set_answer_in_s(*v.answer_in_s);
  if (v.rtt_s) out.set_rtt_s(*v.rtt_s);
  if (v.rtt_least_s) out.set_rtt_least_s(*v.rtt_least_s);
}

}  // namespace longreach
