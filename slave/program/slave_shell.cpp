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
      arm_(config, Random(seed).child("arm")),
      adapter_channel_(open_adapter_channel(config.robot_adapter)),
      adapter_(robot_adapter(adapter_channel_.get(), config)),
      robot_(adapter_ ? static_cast<Robot&>(*adapter_) : arm_),
      side_(config, channel_, Random(seed).child("up")),
      reduced_(reduced) {}

void SlaveShell::wait_for_robot() {
  if (adapter_) wait_for_adapter(*adapter_);
}

void SlaveShell::tick(Time now, const LoopFigures& loop) {
  const bool stop = stops_.take();
  if (const SlaveCommand* command = mailbox_.take()) mailbox_.answer(obey(*command, now));
  side_.tick(now, robot_, loop, stop);
  publish();
  write_down();
}

void SlaveShell::publish() {
  snapshot_.side = side_.figures();
  snapshot_.send_hz = side_.send_hz();
  snapshot_.view = side_.node().view();
  snapshot_.view.reduced |= reduced_;
  snapshot_.rejected_setpoints = adapter_ ? adapter_->rejected_setpoints() : arm_.rejected_setpoints();
  snapshot_.watchdog_stopped = adapter_ ? adapter_->watchdog_stopped() : arm_.watchdog_stopped();
  if (adapter_) {
    snapshot_.adapter = adapter_->figures();
    snapshot_.adapter.unknown_peer = adapter_channel_->unknown_peer();
  }
  snapshots_.write(snapshot_);
}

void SlaveShell::write_down() {
  const std::uint64_t tick = ticks_++;
  if (record_buffer_ == nullptr) return;
  record_buffer_->add_tick(tick, config_number_, side_.input(), side_.output(), side_.node().view());
  if (record_buffer_->link_due(tick))
    record_buffer_->add_link(link_sample(side_.input().now, side_.figures()));
}

LoopAnswer SlaveShell::obey(const SlaveCommand& command, Time now) {
  if (const auto* impairment = std::get_if<ImpairmentConfig>(&command)) {
    side_.port().impairment().configure(*impairment, now);
  } else if (const auto* lease = std::get_if<SlaveLease>(&command)) {
    // Whoever had it before is not heard from now on, so the robot holds until the new one engages.
    const bool taken = occupied(now);
    if (!lease->take && taken) return LoopAnswer::kOccupied;
    side_.follow(lease->session, lease->send_hz, taken);
  } else if (const auto* returned = std::get_if<SlaveReturn>(&command)) {
    if (returned->session == 0 || returned->session != side_.port().endpoint().session())
      return LoopAnswer::kOccupied;
    side_.port().leave();
  } else if (const auto* recording_change = std::get_if<SlaveRecordingChange>(&command)) {
    record_buffer_ = recording_change->record_buffer;
  } else {
    const auto& change = std::get<SlaveChange>(command);
    if (change.only_disengaged && side_.node().engaged()) return LoopAnswer::kEngaged;
    side_.configure(change.config);
    config_number_ = change.number;
    if (change.impairment) side_.port().impairment().configure(change.config.link.impairment, now);
  }
  return LoopAnswer::kDone;
}

// A master that is there keeps its session: nobody else can take the robot from it.
bool SlaveShell::occupied(Time now) const {
  const auto heard = side_.port().endpoint().monitor().last_heard();
  return side_.node().engaged() || (heard && now - *heard < kOccupied);
}

}  // namespace longreach
