#include "master/program/status_loop.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <thread>
#include <utility>

#include "common/net/adapter_channel.hpp"
#include "common/rpc/status_fields.hpp"
#include "master/console/words.hpp"

namespace longreach {
namespace {

constexpr auto kStatusPeriod = std::chrono::milliseconds(20);

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
  const double delay_s = config.link.impairment.delay_s;
  if (delay_s > 0.0) out.expected_rtt_s = 2.0 * delay_s;
  out.force_max_n = config.rendering.force_max_n;
  out.turns = config.device.turns;
  out.hand_outside = s.hand_outside;
  return out;
}

void StateLog::write(const MasterSnapshot& s, const std::string& trouble, const std::string& hand_trouble) {
  if (hand_trouble != hand_trouble_) {
    if (!hand_trouble.empty()) spdlog::warn("hand trouble=\"{}\"", hand_trouble);
    if (hand_trouble.empty()) spdlog::info("hand trouble=over");
    hand_trouble_ = hand_trouble;
  }
  if (trouble != trouble_) {
    if (!trouble.empty()) spdlog::warn("session trouble=\"{}\"", trouble);
    trouble_ = trouble;
  }
  const MasterView& now = s.view;
  if (now.state != last_.view.state) {
    spdlog::info("state from={} to={} cause=\"{}\" engagement={}{}", to_string(last_.view.state),
                 to_string(now.state), to_string(now.cause), now.engagement, because(now.cause));
  }
  const bool came_and_went = now.holds != last_.view.holds && now.state == SafetyState::kEngaged;
  if (came_and_went && last_.view.state == SafetyState::kEngaged)
    spdlog::info("held holds={} cause=\"{}\" resumed=true", now.holds, to_string(now.last_hold));
  if (now.refusal != HoldCause::kNone && now.refusal != last_.view.refusal)
    spdlog::warn("engagement refused={} cause=\"{}\" because=\"{}\"", now.engagement, to_string(now.refusal),
                 refusal_in_words(now));
  if (now.far_state != last_.view.far_state) spdlog::info("slave state={}", to_string(now.far_state));
  if (s.side.session != last_.side.session) spdlog::info("session number={:016x}", s.side.session);
  if (s.side.loop.ticks_late_100ms != last_.side.loop.ticks_late_100ms) {
    spdlog::warn("late ticks_late_100ms={} missed_ticks={}", s.side.loop.ticks_late_100ms,
                 s.side.loop.missed_ticks);
  }
  last_ = s;
}

void StateLog::write_notice(const std::string& notice) {
  if (notice != notice_ && !notice.empty()) spdlog::warn("keyboard notice=\"{}\"", notice);
  notice_ = notice;
}

void StateLog::write_situation(const Shown& shown) {
  if (std::exchange(situation_, shown.situation) == shown.situation) return;
  spdlog::info("situation now=\"{}\" sentence=\"{}\"", text_of(shown.situation).key, shown.sentence);
}

StatusLoop::StatusLoop(const RunOptions& options, const MasterConfig& config, MasterShell& shell,
                       MasterService& service)
    : options_(options),
      config_(config),
      service_(service),
      view_(options.view),
      hand_(std::in_place, config, shell, service),
      holds_(config.link.impairment.blackout_duration_s > 0.0) {}

void StatusLoop::run(const std::atomic<bool>& stop, const SessionClient& session_client) {
  while (!stop && !quit_ && seconds() < length_s()) {
    std::this_thread::sleep_for(kStatusPeriod);
    const MasterSnapshot s = service_.snapshot();
    watch_.update(s.side.loop.ticks);
    holds_.add(seconds(), s.view);
    if (scripted(config_) && config_.safety.engage_at_start && resumption_.step(seconds(), s.view, holds_))
      (void)service_.request({.engage = true});
    const std::string in_hand = hand_trouble(s);
    note(in_hand);
    std::string trouble = session_client.trouble();
    if (trouble.empty()) trouble = in_hand;
    service_.put_trouble(trouble, session_client.taken_by());
    const HandPoll::Seen hand = hand_->seen();
    state_log_.write(s, session_client.trouble(), in_hand);
    state_log_.write_notice(hand.notice);
    ConsoleSnapshot shown = picture(s, config_);
    shown.trouble = trouble;
    shown.seconds = seconds();
    if (options_.seconds) shown.seconds_left = length_s() - shown.seconds;
    shown.notice = hand.notice;
    shown.show_keys = hand.show_keys;
    shown.pad_keys = hand.pad_keys;
    shown.shown = situations_.step(shown);
    service_.put_shown(shown.shown);
    state_log_.write_situation(shown.shown);
    quit_ = hand.quit;
    view_.show(shown);
  }
  view_.close();
  hand_.reset();
}

void StatusLoop::note(const std::string& hand) {
  constexpr std::size_t kKept = 64;
  if (hand != hand_said_ && !hand.empty() && troubles_.size() < kKept) troubles_.push_back({seconds(), hand});
  hand_said_ = hand;
}

double StatusLoop::length_s() const {
  if (!options_.seconds) return 1e300;
  return *options_.seconds + std::min(*options_.seconds, holds_.machine_s());
}

bool Resumption::step(double seconds, const MasterView& view, const HoldLog& holds) {
  constexpr double kReaction_s = 1.0, kTimeout_s = 4.0;
  const auto attribution = holds.now();
  const bool wanted = attribution == HoldAttribution::kMachine || attribution == HoldAttribution::kOutage;
  if (!wanted || view.engaging || view.resumes) {
    ask_s_ = seconds + kReaction_s;
    return false;
  }
  if (seconds < ask_s_) return false;
  ask_s_ = seconds + kTimeout_s + view.rtt_s.value_or(0.0);
  return true;
}

/// Returns why the hand does not hold the handle, and a remedy; empty if it does.
std::string StatusLoop::hand_trouble(const MasterSnapshot& s) const {
  const std::string adapter = adapter_trouble(s.adapter, "haptic device", config_.device_adapter.address);
  const bool real_device = !config_.device_adapter.address.empty();
  if (real_device || !hand_->is_hand() || s.hand_outside) return adapter;
  const std::string hand = hand_->seen().trouble;
  return hand.empty() && s.hand_lost ? "the hand is grasping the handle; engage in a moment" : hand;
}

}  // namespace longreach
