#include "slave/sensing/force_answer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace longreach {
namespace {

constexpr double kSettled_s = 0.008;  // after the touch, the force is smooth and has its usual delay
constexpr double kTrendRest_s = 0.04;
constexpr double kFast_s = 0.008, kFast = 0.5;  // of the bound: there is no time for a longer observation
constexpr double kGrown_n = 0.4, kGrownNoise = 8.0;  // growth that noise does not cause
constexpr double kTrend_s = 0.25, kMuch_n = 1.6;     // duration or growth over which a trend is determined
constexpr double kNoGrowth_s = 0.5;                  // rest without growth
constexpr double kStale_s = 1.0;                     // duration of motion after which a trend is obsolete
constexpr double kStep_m = 1e-4;
constexpr double kFollows_m = 5e-3;  // distance after which every wall at rest would have responded
constexpr double kComes_n = 0.25,
                 kComesNoise = 5.0;  // smooth growth during the rest after that distance: an approaching wall
constexpr double kAsideShare = 0.2,
                 kRounding_m =
                     1e-5;  // sideways motion, relative to the distance, that still counts as straight back
constexpr double kAnswer_n = 0.5, kAnswerNoise = 10.0;
constexpr double kOfAnswer = 0.7;          // fraction of a response that suffices when g is known better
constexpr double kAnswer_n_per_m = 100.0;  // minimum stiffness of a contact
constexpr double kLearn_n = 2.0, kLearn_m = 3e-3;  // force and retreat with which a stiffness is learnt
constexpr double kHardest_n_per_m = 1e7;           // steel on steel
constexpr double kCheckMax_s = 0.5;                // a tool at its maximum speed has come to rest by then
constexpr double kHaste_n_per_s = 250.0;           // growth at which the full acceleration is used
constexpr double kLeastHaste = 0.05;
constexpr double kRefined_s = 0.1;  // after the response, while a longer distance improves the stiffness
constexpr double kRetreat_s = 0.1;  // τ
constexpr double kFastest_m_per_s = 10.0;  // maximum speed of a wall; more is noise
constexpr double kWall_s = 0.05;           // time constant of v

}  // namespace

ForceAnswer::Trend ForceAnswer::trend(const Point& from, const Point& to) {
  const double passed_s = std::max(to.t_s - from.t_s, 1e-6);
  return {(to.force_n - from.force_n) / passed_s, (to.p_m - from.p_m) / passed_s};
}

void ForceAnswer::step(const ForceAnswerInput& in) {
  if (!in.in_contact) return reset();
  const Point now{before_.t_s + in.dt, in.force_n, in.p_m};
  if (before_.t_s == 0.0) before_ = now;
  still_ = in.still;
  known_ = known_ || in.known;
  rest(now, in);
  if (gives_way() && !in.may_move) state_ = State::kGrowing;
  switch (state_) {
    case State::kRest:
      suspected_ = false;
      if (grew_) state_ = State::kGrowing;
      watch_retreat(now, in);
      break;
    case State::kGrowing:
      if (!grew_) state_ = State::kRest;
      watch_retreat(now, in);
      learns_ = !known_ && !tried_ && in.force_n < in.bound_n;
      if (grew_ && in.may_move && in.force_n >= (learns_ ? kLearn_n : in.bound_n)) {
        tried_ = tried_ || learns_;
        begin_to_give_way(now, in.reaction);
      }
      break;
    case State::kGivingWay:
      look_for_answer(now);
      if (gives_way() && learns_ && !answered_here_ && deviation(now, 0.0).way_m > kLearn_m)
        state_ = State::kGrowing;
      break;
    case State::kAnswered:
      answered_s_ += in.dt;
      if (!grew_ && in.still) state_ = State::kRest;
      break;
    case State::kChecking:
      checked_s_ += in.dt;
      check(now, in);
      break;
    case State::kWrongSign:
      break;
  }
  if (gives_way()) drive(now, in);
  before_ = now;
}

// Returns whether the force grew by more than the noise and the motion of the tool can cause.
bool ForceAnswer::grown(const Point& from, const Point& now, const ForceAnswerInput& in) const {
  const double nearer_m = std::max(-in.reaction.dot(now.p_m - from.p_m), 0.0);
  const double grown_n = now.force_n - from.force_n - limits_.stiffness_n_per_m * nearer_m;
  const double passed_s = now.t_s - from.t_s;
  const bool fast = passed_s >= kFast_s && grown_n >= kFast * in.bound_n;
  return (passed_s >= kTrendRest_s || fast) && grown_n >= std::max(kGrown_n, kGrownNoise * limits_.noise_n);
}

// Uses two points of the rest, so that a trend covers neither a moment nor a time long ago.
void ForceAnswer::rest(const Point& now, const ForceAnswerInput& in) {
  if (!in.still || now.t_s < kSettled_s) {
    rest_s_ = 0.0;
    moved_s_ += in.dt;
    if (moved_s_ > kStale_s && !gives_way()) grew_ = false;
    return;
  }
  if (rest_s_ == 0.0) begun_ = now;
  if (rest_s_ == 0.0 || now.force_n < older_.force_n) older_ = newer_ = now;
  rest_s_ += in.dt;
  moved_s_ = 0.0;
  const bool lately = now.t_s - newer_.t_s <= kNoGrowth_s;
  if (grown(older_, now, in)) {
    grew_ = grew_ || lately;
    trend_ = trend(older_, now);
  }
  if (grown(newer_, now, in)) {
    grew_ = true;
    if (now.t_s - newer_.t_s >= kTrend_s || now.force_n - newer_.force_n >= kMuch_n)
      older_ = std::exchange(newer_, now);
  } else if (!lately) {
    grew_ = false;
  }
}

void ForceAnswer::begin_to_give_way(const Point& now, const Vector3& reaction) {
  state_ = State::kGivingWay;
  watches_ = false;
  gave_way_ = true;
  from_ = now;
  given_ = trend_;
  along_ = reaction;
  retreat_m_per_s_ = 0.0;
}

ForceAnswer::Deviation ForceAnswer::deviation(const Point& now, double trend_n_per_s) const {
  const double passed_s = now.t_s - from_.t_s;
  return {from_.force_n + trend_n_per_s * passed_s - now.force_n,
          along_.dot(now.p_m - from_.p_m - passed_s * given_.m_per_s)};
}

bool ForceAnswer::decides(double change_n, double way_m, double share) const {
  return way_m >= kStep_m &&
         change_n >= share * std::max({kAnswer_n, kAnswerNoise * limits_.noise_n, kAnswer_n_per_m * way_m});
}

// Monitors a tool that retreats because the guard is exceeded. Only straight motion counts, because a tool
// that slides may touch something else.
void ForceAnswer::watch_retreat(const Point& now, const ForceAnswerInput& in) {
  const Vector3 way_m = now.p_m - from_.p_m;
  const double out_m = along_.dot(way_m), aside_m = (way_m - out_m * along_).norm();
  if (!in.may_move || in.force_n <= in.guard_n) watches_ = false;
  if (!watches_ || out_m < 0.0 || aside_m > kAsideShare * out_m + kRounding_m) {
    watches_ = in.may_move && in.force_n > in.guard_n;
    from_ = now;
    along_ = in.reaction;
    given_ = {};
    return;
  }
  const bool fell = decides(from_.force_n - now.force_n, out_m);
  const bool grew = decides(now.force_n - from_.force_n, out_m);
  const bool follows = !fell && !grew && out_m >= kFollows_m;
  if (!grew && !fell && !follows) return;
  if (!fell) {
    state_ = State::kChecking;
    checked_s_ = 0.0;
    tries_ = grew;
    follows_ = follows;
  }
  watches_ = false;
}

void ForceAnswer::look_for_answer(const Point& now) {
  const Deviation d = deviation(now, given_.n_per_s);
  if (decides(d.fell_n, d.way_m)) {
    state_ = State::kAnswered;
    answered_ = answered_here_ = true;
    suspected_ = false;
    answered_s_ = 0.0;
  } else if (decides(-d.fell_n, d.way_m)) {
    state_ = State::kChecking;
    checked_s_ = 0.0;
  }
}

// Returns whether the tool has rested for as long as it moved, so that both growths are known equally well,
// or whether there is no time for that.
bool ForceAnswer::seen_enough(const Point& now) const {
  if (rest_s_ == 0.0) return false;
  const double much_n = std::max(kMuch_n, 2.0 * kAnswerNoise * limits_.noise_n);
  const bool fast = rest_s_ >= kFast_s && now.force_n - begun_.force_n >= much_n;
  return fast || rest_s_ >= std::clamp(begun_.t_s - from_.t_s, kTrendRest_s, kTrend_s);
}

// A wall that accelerates, or that is stiffer deeper, looks like a wrong sign. At rest it shows the present
// growth of the force. Growth beyond that before and after is suspicious; the next retreat then shows whether
// the sign is wrong.
void ForceAnswer::check(const Point& now, const ForceAnswerInput& in) {
  if (!seen_enough(now) && checked_s_ < kCheckMax_s) return;
  if (!in.still) begun_ = now;
  const Trend after = trend(begun_, now);
  const Deviation d = deviation(begun_, std::max({given_.n_per_s, after.n_per_s, 0.0}));
  const bool suspicious = decides(-d.fell_n, d.way_m, kOfAnswer), again = suspicious && suspected_;
  const bool comes = now.force_n - begun_.force_n >= std::max(kComes_n, kComesNoise * limits_.noise_n);
  const bool follows = std::exchange(follows_, false) && comes;
  const bool tries = std::exchange(tries_, false) || suspicious || follows;
  trend_ = after;
  suspected_ = suspicious;
  state_ = again ? State::kWrongSign : State::kGrowing;
  if (tries && !again) begin_to_give_way(now, in.reaction);
}

void ForceAnswer::drive(const Point& now, const ForceAnswerInput& in) {
  if (state_ == State::kGivingWay) {
    const double haste = std::clamp(given_.n_per_s / kHaste_n_per_s, kLeastHaste, 1.0);
    retreat_m_per_s_ += haste * limits_.acceleration_m_per_s2 * in.dt;
  } else {
    const Deviation d = deviation(now, given_.n_per_s);
    if (answered_s_ < kRefined_s && decides(d.fell_n, d.way_m)) {
      stiffness_n_per_m_ = std::clamp(d.fell_n / d.way_m, kAnswer_n_per_m, kHardest_n_per_m);
      wall_m_per_s_ = given_.n_per_s / stiffness_n_per_m_;
    } else {
      const double comes_m =
          along_.dot(now.p_m - before_.p_m) + (now.force_n - before_.force_n) / stiffness_n_per_m_;
      const double seen_m_per_s = std::clamp(comes_m / in.dt, -kFastest_m_per_s, kFastest_m_per_s);
      wall_m_per_s_ += -std::expm1(-in.dt / kWall_s) * (seen_m_per_s - wall_m_per_s_);
    }
    const double above_n = in.force_n - in.bound_n;
    retreat_m_per_s_ = wall_m_per_s_ + above_n / (stiffness_n_per_m_ * kRetreat_s);
  }
  retreat_m_per_s_ = std::clamp(retreat_m_per_s_, 0.0, limits_.speed_m_per_s);
}

}  // namespace longreach
