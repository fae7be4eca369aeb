#include "slave/program/slave_shell.hpp"

#include "common/loop/wait_for_adapter.hpp"
#include "common/net/adapter_channel.hpp"

namespace longreach {
namespace {

constexpr Duration kOccupied = std::chrono::seconds(1);

std::optional<RobotAdapter> robot_adapter(UnixChannel* channel, const SlaveConfig& config) {
  if (channel == nullptr) return std::nullopt;
  return std::optional<RobotAdapter>(std::in_place, *channel,
                                     with_prompt_timeout(config.robot_adapter, config.loop.rate_hz),
                                     config.robot, draw_session(Cipher::kChaCha20Poly1305).number);
}

}  // namespace

SlaveShell::SlaveShell(const SlaveConfig& config, std::uint64_t seed, std::uint32_t reduced)
    : channel_(config.link.listen),
      port_(channel_, config.link.impairment, Random(seed).child("up")),
      arm_(config, Random(seed).child("arm")),
      adapter_channel_(open_adapter_channel(config.robot_adapter)),
      adapter_(robot_adapter(adapter_channel_.get(), config)),
      robot_(adapter_ ? static_cast<Robot&>(*adapter_) : arm_),
      node_(config),
      reduced_(reduced) {
  port_.limit(config.link.budget_kbit_per_s);
}

void SlaveShell::wait_for_robot() {
  if (adapter_) wait_for_adapter(*adapter_);
}

void SlaveShell::tick(Time now, const LoopFigures& loop) {
  const bool stop = stops_.take();
  bool taken = false;
  if (const SlaveCommand* command = mailbox_.take()) mailbox_.answer(obey(*command, now, taken));

  port_.receive(now, node_.stalled(now, snapshot_.send_hz));
  const Endpoint& endpoint = port_.endpoint();
  const SideFigures& side = observer_.observe(now, port_, channel_, loop);
  SlaveInput in;
  in.now = now;
  in.robot = robot_.read(now);
  in.commands = port_.commands();
  in.last_heard = endpoint.monitor().last_heard();
  in.peer_session_count = endpoint.sessions();
  in.taken = taken;
  in.stop = stop;
  in.send_hz = snapshot_.send_hz;
  in.rejected = port_.rejected_total();
  in.late_ticks = loop.ticks_late_100ms;
  in.overdue_ticks = loop.overdue_ticks;
  in.up_loss = side.link.loss;
  in.up_jitter_s = side.link.jitter_s;
  in.may_send = port_.may_send(now);

  const SlaveOutput out = node_.step(in);
  if (out.grip) robot_.grip(*out.grip);
  robot_.write(out.joint_setpoint_rad);
  if (out.report) port_.send(now, out.report_sequence, *out.report);
  if (out.telemetry) port_.send(now, out.telemetry_sequence, *out.telemetry);

  snapshot_.side = side;
  snapshot_.view = node_.view();
  snapshot_.view.reduced |= reduced_;
  snapshot_.rejected_setpoints = adapter_ ? adapter_->rejected_setpoints() : arm_.rejected_setpoints();
  snapshot_.watchdog_stopped = adapter_ ? adapter_->watchdog_stopped() : arm_.watchdog_stopped();
  if (adapter_) {
    snapshot_.adapter = adapter_->figures();
    snapshot_.adapter.unknown_peer = adapter_channel_->unknown_peer();
  }
  snapshots_.write(snapshot_);
  write_down(in, out);
}

void SlaveShell::write_down(const SlaveInput& in, const SlaveOutput& out) {
  const std::uint64_t tick = ticks_++;
  if (record_buffer_ == nullptr) return;
  record_buffer_->add_tick(tick, config_number_, in, out, node_.view());
  if (record_buffer_->link_due(tick)) record_buffer_->add_link(link_sample(in.now, snapshot_.side));
}

LoopAnswer SlaveShell::obey(const SlaveCommand& command, Time now, bool& taken) {
  if (const auto* impairment = std::get_if<ImpairmentConfig>(&command)) {
    port_.impairment().configure(*impairment, now);
  } else if (const auto* lease = std::get_if<SlaveLease>(&command)) {
    // Whoever had it before is not heard from now on, so the robot holds until the new one engages.
    taken = occupied(now);
    if (!lease->take && taken) return LoopAnswer::kOccupied;
    port_.follow(lease->session);
    snapshot_.send_hz = lease->send_hz;
  } else if (const auto* returned = std::get_if<SlaveReturn>(&command)) {
    if (returned->session == 0 || returned->session != port_.endpoint().session())
      return LoopAnswer::kOccupied;
    port_.leave();
  } else if (const auto* recording_change = std::get_if<SlaveRecordingChange>(&command)) {
    record_buffer_ = recording_change->record_buffer;
  } else {
    const auto& change = std::get<SlaveChange>(command);
    if (change.only_disengaged && node_.engaged()) return LoopAnswer::kEngaged;
    node_.configure(change.config);
    config_number_ = change.number;
    port_.limit(change.config.link.budget_kbit_per_s);
    if (change.impairment) port_.impairment().configure(change.config.link.impairment, now);
  }
  return LoopAnswer::kDone;
}

// A master that is there keeps its session: nobody else can take the robot from it.
bool SlaveShell::occupied(Time now) const {
  const auto heard = port_.endpoint().monitor().last_heard();
  return node_.engaged() || (heard && now - *heard < kOccupied);
}

}  // namespace longreach
