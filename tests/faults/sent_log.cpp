#include "tests/faults/sent_log.hpp"

#include <algorithm>
#include <cstring>

namespace longreach {
namespace {

constexpr double kTicks_s = 0.003;    // a state changes a tick later
constexpr double kOvertaken_s = 0.5;  // what is later is not heard

bool same(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0 || a == b; }

bool same(const Vector3& a, const Vector3& b) {
  return same(a.x(), b.x()) && same(a.y(), b.y()) && same(a.z(), b.z());
}

bool same(const MotionCommand& a, const MotionCommand& b) {
  const bool goal = a.goal_kind == GoalKind::kGoalPosition ? same(a.position_m, b.position_m)
                                                           : same(a.rotation_rad, b.rotation_rad);
  return a.engagement == b.engagement && a.request == b.request && a.mode == b.mode &&
         same(a.scale, b.scale) && a.grip == b.grip && a.let_go == b.let_go && a.goal_kind == b.goal_kind &&
         goal;
}

}  // namespace

void SentLog::lease(double t_s, std::uint64_t session, bool to_master) {
  ended(t_s);
  session_ = session;
  if (to_master) master_session_ = session;
}

void SentLog::master_sent(double t_s, std::uint64_t sequence, const MotionCommand& command) {
  numbers_ = std::max(numbers_, command.engagement);
  sent_.push_back({t_s, master_session_, sequence, command});
}

const SentCommand* SentLog::find(std::uint64_t sequence) const {
  const auto at = std::ranges::lower_bound(sent_, sequence, {}, &SentCommand::sequence);
  return at != sent_.end() && at->sequence == sequence ? &*at : nullptr;
}

bool SentLog::slave_given(double t_s, double slept_s, std::span<const Received<MotionCommand>> commands) {
  bool good = true;
  const bool slept = slept_s > gap_s_;
  for (const Received<MotionCommand>& received : commands) {
    ++given_;
    const SentCommand* sent = find(received.sequence);
    if (sent == nullptr || sent->session != session_ || !same(sent->command, received.message)) {
      good = false;
      continue;
    }
    // A hold that lasted longer needs a new engagement.
    if (t_s - authority_.had_s > resume_s_ + kTicks_s && entered_ >= authority_.engagement)
      ended_ = std::max(ended_, authority_.engagement);
    authority_.engaged = authority_.engaged && authority_.engagement > ended_;
    if (!received.newest) {
      if (!slept && sent->t_s >= authority_.sent_s - kOvertaken_s) authority_.received_s = t_s;
      continue;
    }
    good = good && received.sequence > newest_;
    newest_ = std::max(newest_, received.sequence);
    obey(t_s, *sent, slept);
  }
  if (authority_.engaged && t_s - authority_.received_s <= gap_s_) authority_.had_s = t_s;
  return good;
}

void SentLog::obey(double t_s, const SentCommand& sent, bool slept) {
  const MotionCommand& command = sent.command;
  authority_.request = command.request;
  authority_.newest = &sent;
  authority_.sent_s = sent.t_s;
  // Whoever holds or stops ends this engagement and all before it, but a hand that is let go.
  if (command.request == Request::kStop || command.request == Request::kHold)
    ended_ = std::max({ended_, authority_.engagement, command.engagement});
  if (slept) {
    authority_.engaged = false;
    return;
  }
  authority_.received_s = t_s;
  if (command.request == Request::kEngage && command.engagement > std::max(ended_, authority_.engagement)) {
    authority_.engagement = command.engagement;
    authority_.had_s = t_s;
  }
  authority_.engaged = command.request == Request::kEngage && command.engagement > ended_ &&
                       command.engagement == authority_.engagement;
}

void SentLog::ended(double t_s) {
  ended_ = std::max(ended_, authority_.engagement);
  if (authority_.engaged) authority_.had_s = t_s;
  authority_.engaged = false;
}

}  // namespace longreach
