#include "master/housekeeping.hpp"

#include <spdlog/spdlog.h>

#include <thread>
#include <utility>

#include "common/io/adapter_channel.hpp"
#include "common/io/status_fields.hpp"

namespace longreach {
namespace {

constexpr auto kPollPeriod = std::chrono::milliseconds(20);

bool asks(const OperatorRequests& r) {
  return r.engage || r.hold || r.stop || r.mode.has_value() || r.scale.has_value() || r.scale_steps != 0 ||
         r.load.has_value();
}

/// What keys and pad ask for together; a stop wins.
OperatorRequests both(OperatorRequests keys, const OperatorRequests& pad) {
  keys.stop = keys.stop || pad.stop;
  keys.engage = (keys.engage || pad.engage) && !keys.stop;
  if (!keys.mode) keys.mode = pad.mode;
  if (!keys.load) keys.load = pad.load;
  keys.scale_steps += pad.scale_steps;
  return keys;
}

}  // namespace

bool scripted(const MasterConfig& config) {
  return config.operator_.kind == OperatorKind::kScript && config.device_adapter.address.empty();
}

ConsoleSnapshot picture(const MasterSnapshot& s, const MasterConfig& config) {
  ConsoleSnapshot out;
  out.view = s.view;
  out.link = s.side.link;
  out.late_ticks = s.side.loop.ticks_late_100ms;
  out.missed_ticks = s.side.loop.missed_ticks;
  out.rejected = s.side.rejected;
  if (scripted(config)) out.operator_phase = to_string(s.phase);
  out.force_max_n = config.rendering.force_max_n;
  out.hand_outside = s.hand_outside;
  return out;
}

void Chronicle::write(const MasterSnapshot& s, const std::string& trouble, const std::string& hand_trouble) {
  if (hand_trouble != hand_trouble_) {
    if (!hand_trouble.empty()) spdlog::warn("hand trouble=\"{}\"", hand_trouble);
    hand_trouble_ = hand_trouble;
  }
  if (trouble != trouble_) {
    if (!trouble.empty()) spdlog::warn("session trouble=\"{}\"", trouble);
    trouble_ = trouble;
  }
  const MasterView& now = s.view;
  if (now.state != last_.view.state) {
    spdlog::info("state from={} to={} cause=\"{}\" engagement={}", to_string(last_.view.state),
                 to_string(now.state), to_string(now.cause), now.engagement);
  }
  if (now.far_state != last_.view.far_state) spdlog::info("slave state={}", to_string(now.far_state));
  if (now.in_contact != last_.view.in_contact) {
    spdlog::info("contact now={} stiffness_n_per_m={:.0f}", now.in_contact, now.stiffness_n_per_m);
  }
  if (s.side.session != last_.side.session) spdlog::info("session number={:016x}", s.side.session);
  if (s.side.loop.ticks_late_100ms != last_.side.loop.ticks_late_100ms) {
    spdlog::warn("late ticks_late_100ms={} missed_ticks={}", s.side.loop.ticks_late_100ms,
                 s.side.loop.missed_ticks);
  }
  last_ = s;
}

Housekeeping::Housekeeping(const RunOptions& options, const MasterConfig& config, MasterShell& shell,
                           MasterService& service)
    : options_(options), config_(config), shell_(shell), service_(service), view_(options.view) {
  const bool pad = PadOperator::is_for(config.operator_.kind);
  if (pad) {
    pad_.emplace(config);
    shell.hand().write({.present = false});  // until it has been looked for
  }
  if (pad || config.operator_.kind == OperatorKind::kKeyboard) {
    keyboard_.emplace(KeyboardConfig{.workspace_m = config.device.delta.workspace_m});
  }
}

void Housekeeping::run(const std::atomic<bool>& stop, const SessionSeeker& seeker) {
  while (!stop && !quit_ && seconds() < options_.seconds.value_or(1e300)) {
    std::this_thread::sleep_for(kPollPeriod);
    const MasterSnapshot s = service_.snapshot();
    std::string trouble = seeker.trouble();
    if (trouble.empty()) trouble = hand_trouble(s);
    service_.put_trouble(trouble, seeker.taken_by());
    chronicle_.write(s, seeker.trouble(), hand_trouble(s));
    ConsoleSnapshot shown = picture(s, config_);
    shown.trouble = trouble;
    shown.seconds = seconds();
    if (options_.seconds) shown.seconds_left = *options_.seconds - shown.seconds;
    shown.show_keys = poll_hand(s.view);
    if (pad_) shown.pad_keys = pad_->key_line();
    view_.show(shown);
  }
  view_.close();
  keyboard_.reset();
}

/// Why there is nothing in the hand, and what to do.
std::string Housekeeping::hand_trouble(const MasterSnapshot& s) const {
  const std::string adapter = adapter_trouble(s.adapter, "haptic device", config_.device_adapter.address);
  if (!adapter.empty() || !pad_ || s.hand_outside) return adapter;
  const std::string pad = pad_->trouble();
  return pad.empty() && s.hand_lost ? "the hand takes up the handle; engage in a moment" : pad;
}

/// Returns whether the keys shall be listed.
bool Housekeeping::poll_hand(const MasterView& view) {
  if (!keyboard_) return false;
  const KeyboardState state = keyboard_->poll(view.mode);
  OperatorRequests requests = state.requests;
  if (pad_) {
    const double now_s = seconds();
    const double felt = view.spring_force_n.norm() / config_.rendering.force_max_n;
    const AxisHandState& pad = pad_->poll(view.mode, felt, now_s - std::exchange(polled_s_, now_s));
    HandLevel level = pad.level;
    level.clutch = level.clutch || requests.clutch;
    shell_.hand().write(level);
    requests = both(requests, pad.requests);
  } else {
    shell_.hand().write({.target_m = state.target_m, .clutch = requests.clutch});
  }
  if (asks(requests)) {
    if (const auto refusal = service_.request(requests)) spdlog::warn("key refused=\"{}\"", refusal->message);
  }
  quit_ = quit_ || state.quit;
  return state.show_keys;
}

}  // namespace longreach
