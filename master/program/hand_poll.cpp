#include "master/program/hand_poll.hpp"

#include <pthread.h>
#include <spdlog/spdlog.h>

#include <utility>

#include "common/loop/real_time_loop.hpp"

namespace longreach {
namespace {

constexpr auto kPollPeriod = std::chrono::milliseconds(20);

bool asks(const OperatorRequests& r) {
  return r.engage || r.hold || r.stop || r.mode.has_value() || r.scale.has_value() || r.scale_steps != 0 ||
         r.kv_steps != 0 || r.grip.has_value() || r.turns_gripper;
}

/// Combines the requests of keys and pad. A stop takes precedence.
OperatorRequests both(OperatorRequests keys, const OperatorRequests& pad) {
  keys.stop = keys.stop || pad.stop;
  keys.engage = (keys.engage || pad.engage) && !keys.stop;
  if (!keys.mode) keys.mode = pad.mode;
  keys.turns_gripper = keys.turns_gripper != pad.turns_gripper;
  keys.scale_steps += pad.scale_steps;
  keys.kv_steps += pad.kv_steps;
  return keys;
}

}  // namespace

HandPoll::HandPoll(const MasterConfig& config, MasterShell& shell, MasterService& service)
    : config_(config), shell_(shell), service_(service) {
  const bool pad = PadOperator::is_for(config.operator_.kind);
  if (pad) {
    pad_.emplace(config);
    shell.hand().write({.present = false});  // until the first poll
  }
  if (!pad && config.operator_.kind != OperatorKind::kKeyboard) return;
  keyboard_.emplace(KeyboardConfig{.workspace_m = config.device.delta.workspace_m,
                                   .workspace_rad = config.device.spherical.workspace_rad});
  polled_ = boottime_now();
  thread_ = std::thread([this] { run(); });
  (void)::pthread_setname_np(thread_.native_handle(), "hand");
}

HandPoll::~HandPoll() {
  ended_ = true;
  if (thread_.joinable()) thread_.join();
}

HandPoll::Seen HandPoll::seen() const {
  const std::lock_guard lock(seeing_);
  return seen_;
}

void HandPoll::run() {
  LoopConfig behind = config_.loop;
  behind.priority -= behind.priority > 0 ? 1 : 0;
  (void)ask_for_real_time(behind);  // the loop has already reported refused requests
  while (!ended_) {
    std::this_thread::sleep_for(kPollPeriod);
    poll();
  }
}

void HandPoll::poll() {
  const MasterSnapshot snapshot = service_.snapshot();
  const MasterView& view = snapshot.view;
  const HandBegin& begin = snapshot.hand_begin;
  if (std::exchange(begun_, begin.change) != begin.change) {
    keyboard_->begin_at(begin.target_m, begin.target_rad);
    if (pad_) pad_->begin_at(begin.target_m, begin.target_rad);
  }
  const Time now = boottime_now();
  const double since_s = to_seconds(now - std::exchange(polled_, now));
  const KeyboardState state = keyboard_->poll(view.mode, since_s, snapshot.hand_outside);
  OperatorRequests requests = state.requests;
  if (pad_) {
    requests = poll_pad(view, requests, since_s);
  } else {
    shell_.hand().write({.target_m = state.target_m,
                         .target_rad = state.target_rad,
                         .clutch = requests.clutch,
                         .change = begun_,
                         .present = keyboard_->trouble().empty(),
                         .said = boottime_now()});
  }
  if (asks(requests)) {
    if (const auto refusal = service_.request(requests)) spdlog::warn("key refused=\"{}\"", refusal->message);
  }
  const std::lock_guard lock(seeing_);
  seen_.show_keys = state.show_keys;
  seen_.notice = keyboard_->notice();
  seen_.quit = seen_.quit || state.quit;
  seen_.trouble = pad_ ? pad_->trouble() : keyboard_->trouble();
  if (pad_) seen_.pad_keys = pad_->key_line();
}

OperatorRequests HandPoll::poll_pad(const MasterView& view, OperatorRequests keys, double since_s) {
  const double felt = view.spring_force_n.norm() / config_.rendering.force_max_n;
  const AxisHandState& pad = pad_->poll(view.mode, felt, since_s);
  HandLevel level = pad.level;
  level.clutch = level.clutch || keys.clutch;
  level.change = begun_;
  level.said = boottime_now();
  shell_.hand().write(level);
  return both(std::move(keys), pad.requests);
}

}  // namespace longreach
