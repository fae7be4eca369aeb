#include "slave/program/slave_shell.hpp"

namespace longreach {
namespace {

constexpr Duration kOccupied = std::chrono::seconds(1);

}  // namespace

SlaveShell::SlaveShell(const SlaveConfig& config, std::uint64_t seed, std::uint32_t reduced)
    : SideShell(config, std::nullopt, Random(seed).child("up"), reduced, config.robot),
      arm_(config, Random(seed).child("arm")),
      robot_(adapter_ ? static_cast<Robot&>(*adapter_) : arm_) {}

void SlaveShell::tick(Time now, const LoopFigures& loop) {
  const bool stop = stops_.take();
  if (const SlaveCommand* command = mailbox_.take()) mailbox_.answer(obey(*command, now));
  side_.tick(now, robot_, loop, stop);
  snapshot_.send_hz = side_.send_hz();
  snapshot_.rejected_setpoints = adapter_ ? adapter_->rejected_setpoints() : arm_.rejected_setpoints();
  snapshot_.watchdog_stopped = adapter_ ? adapter_->watchdog_stopped() : arm_.watchdog_stopped();
  publish();
}

LoopAnswer SlaveShell::obey(const SlaveCommand& command, Time now) {
  if (const auto* lease = std::get_if<SlaveLease>(&command)) {
    // Whoever had it before is not heard from now on, so the robot holds until the new one engages.
    const bool taken = occupied(now);
    if (!lease->take && taken) return LoopAnswer::kOccupied;
    side_.follow(lease->session, lease->send_hz, taken);
  } else if (const auto* returned = std::get_if<SlaveReturn>(&command)) {
    if (returned->session == 0 || returned->session != side_.port().endpoint().session())
      return LoopAnswer::kOccupied;
    side_.port().leave();
  } else {
    return obey_common(command, now);
  }
  return LoopAnswer::kDone;
}

// A master that is there keeps its session: nobody else can take the robot from it.
bool SlaveShell::occupied(Time now) const {
  const auto heard = side_.port().endpoint().monitor().last_heard();
  return side_.node().engaged() || (heard && now - *heard < kOccupied);
}

}  // namespace longreach
