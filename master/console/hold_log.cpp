#include "master/console/hold_log.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "master/console/formatted.hpp"
#include "master/console/words.hpp"

namespace longreach {
namespace {

bool is_machine(HoldCause cause) { return text_of(cause).attribution == HoldAttribution::kMachine; }

std::string machine_words(const HoldRecord& hold) {
  const bool here = is_machine(hold.cause);
  const bool stalled = (here ? hold.cause : hold.far_cause) == HoldCause::kStalled;
  std::string text = here ? "the master's control loop " : "the slave's control loop ";
  if (!stalled) return text + "cannot maintain its rate: its machine is too slow or too busy";
  return text + "stalled: its machine is busy";
}

/// Returns the text of the input problem that began together with a device fault; empty if there is none.
std::string hand_words(const HoldRecord& hold, const std::vector<HandTrouble>& hand) {
  constexpr double kApartS = 0.5;  // the hand is polled outside the loop
  if (hold.cause != HoldCause::kDeviceFault || hand.empty()) return "";
  const auto apart_s = [&](const HandTrouble& trouble) { return std::fabs(trouble.began_s - hold.began_s); };
  const auto nearest = std::min_element(
      hand.begin(), hand.end(), [&](const auto& a, const auto& b) { return apart_s(a) < apart_s(b); });
  return apart_s(*nearest) < kApartS ? nearest->text : "";
}

std::string words_of(const HoldRecord& hold, const std::vector<HandTrouble>& hand) {
  const std::string when = hold.lasts ? formatted("held at %.1f s until the end: ", hold.began_s)
                                      : formatted("held at %.1f s for %.1f s: ", hold.began_s, hold.lasted_s);
  if (hold.attribution == HoldAttribution::kMachine) return when + machine_words(hold);
  const std::string trouble = hand_words(hold, hand);
  std::string text = when + (trouble.empty() ? sentence(hold.cause) : trouble);
  // It is not worth mentioning that the slave holds because the master does.
  const bool follows = hold.far_cause == HoldCause::kPeerHolds && hold.cause != HoldCause::kNone;
  if (hold.far_cause != HoldCause::kNone && hold.far_cause != hold.cause && !follows)
    text += "; at the slave: " + sentence(hold.far_cause);
  return text + (hold.attribution == HoldAttribution::kOutage ? ", as the link profile specifies" : "");
}

}  // namespace

HoldAttribution HoldLog::attribution(const HoldRecord& hold) const {
  const auto is = [&](HoldAttribution which) {
    return text_of(hold.cause).attribution == which || text_of(hold.far_cause).attribution == which;
  };
  for (const auto which : {HoldAttribution::kMachine, HoldAttribution::kOperator, HoldAttribution::kFault})
    if (is(which)) return which;
  return outages_ && is(HoldAttribution::kOutage) ? HoldAttribution::kOutage : HoldAttribution::kProtection;
}

HoldRecord HoldLog::present() const {
  HoldRecord hold = hold_;
  hold.lasted_s = now_s_ - hold.began_s;
  hold.attribution = attribution(hold);
  hold.lasts = holds_;
  return hold;
}

void HoldLog::add(double seconds, const MasterView& view) {
  now_s_ = std::max(now_s_, seconds);
  const bool engaged = view.state == SafetyState::kEngaged;
  if (engaged_ && !engaged) {
    hold_ = {.began_s = now_s_};
    holds_ = true;
  }
  if (holds_ && !engaged) {
    if (view.cause != HoldCause::kNone && (hold_.cause == HoldCause::kNone || is_machine(view.cause)))
      hold_.cause = view.cause;
    const Reason far =
        view.cause_is_far ? view.cause : Reason(view.far_known ? view.far.cause : HoldCause::kNone);
    if (far != HoldCause::kNone && (hold_.far_cause == HoldCause::kNone || is_machine(far)))
      hold_.far_cause = far;
  }
  if (holds_ && engaged) {
    HoldRecord hold = present();
    hold.lasts = false;
    const std::uint64_t number = count() - 1;
    if (number < kKept) kept_[number] = hold;
    ++counts_[static_cast<std::size_t>(hold.attribution)];
    if (hold.attribution == HoldAttribution::kMachine) machine_s_ += hold.lasted_s;
    holds_ = false;
  }
  engaged_ = engaged;
}

std::uint64_t HoldLog::count() const {
  return std::accumulate(counts_.begin(), counts_.end(), std::uint64_t{holds_ ? 1U : 0U});
}

double HoldLog::machine_s() const {
  const bool now = holds_ && present().attribution == HoldAttribution::kMachine;
  return machine_s_ + (now ? present().lasted_s : 0.0);
}

std::vector<HoldLog::Sentence> HoldLog::words(const std::vector<HandTrouble>& hand) const {
  std::vector<Sentence> all;
  const auto add = [&](const HoldRecord& hold) {
    all.push_back({words_of(hold, hand), hold.attribution, hold.lasts});
  };
  for (std::size_t i = 0; i < std::min<std::size_t>(count() - (holds_ ? 1 : 0), kKept); ++i) add(kept_[i]);
  if (holds_) add(present());
  return all;
}

}  // namespace longreach
