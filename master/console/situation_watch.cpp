#include "master/console/situation_watch.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "master/console/snapshot.hpp"
#include "master/console/words.hpp"

namespace longreach {
namespace {

constexpr double kShownMin_s = 0.5;
constexpr double kPressing_n = 0.05;

}  // namespace

ContactCourse CourseWatch::step(const ConsoleSnapshot& s) { return {pushed_m(s), unsteady(s)}; }

/// The tool moves out of the contact while a guard acts and the hand does not retreat by as much.
double CourseWatch::pushed_m(const ConsoleSnapshot& s) {
  constexpr double kPushed_m = 2e-3, kOwnShare = 0.5;
  const MasterView& v = s.view;
  const Vector3 force_n = v.far.F_E_W.force;
  const bool presses = v.state == SafetyState::kEngaged && v.in_contact && v.far_known &&
                       v.far.engagement == v.engagement && !v.clutched && force_n.norm() > kPressing_n;
  if (!presses) {
    pressing_ = false;
    return 0.0;
  }
  const Vector3 out = force_n.normalized();
  if (!std::exchange(pressing_, true)) tool_m_ = v.far.X_WE.p, hand_m_ = v.p_MH;
  if (out.dot(v.far.X_WE.p - tool_m_) < 0.0) tool_m_ = v.far.X_WE.p;
  if (v.inward.dot(v.p_MH - hand_m_) > 0.0) hand_m_ = v.p_MH;
  const double retreat_m = out.dot(v.far.X_WE.p - tool_m_);
  const double own_m = v.scale * (hand_m_ - v.p_MH).norm();
  const bool pushed = v.far.clamps.force_guard && retreat_m > kPushed_m && own_m < kOwnShare * retreat_m;
  return pushed ? retreat_m : 0.0;
}

/// A hand does not reverse a force twice a second over a link; a swinging surface does.
bool CourseWatch::unsteady(const ConsoleSnapshot& s) {
  constexpr double kSwing_n = 0.5, kSwing = 0.2, kWithin_s = 1.5;
  const double now_n = s.view.far.F_E_W.force.norm();
  const double change_n = now_n - extreme_n_;
  if (change_n * direction_ >= 0.0 && direction_ != 0) {
    extreme_n_ = now_n;
  } else if (std::fabs(change_n) > std::max(kSwing_n, kSwing * extreme_n_)) {
    extreme_n_ = now_n;
    direction_ = change_n > 0.0 ? 1 : -1;
    reversed_s_[reversals_++ % kReversals] = s.seconds;
  }
  return reversals_ >= kReversals && s.seconds - reversed_s_[reversals_ % kReversals] < kWithin_s;
}

Shown SituationWatch::step(const ConsoleSnapshot& s) {
  const ContactCourse course = course_.step(s);
  choose(s, situation_of(s, course));
  Shown out{shown_, sentence_of(shown_, s, course), limits(s)};
  if (!s.trouble.empty() && !is_motion(shown_)) out.sentence = s.trouble;
  return out;
}

void SituationWatch::choose(const ConsoleSnapshot& s, Situation now) {
  const double seconds = s.seconds;
  if (now == shown_) applied_s_ = seconds;
  const bool urgent = now == Situation::kFault || now == Situation::kStopped;
  // A hold that may end automatically within a moment is treated like a contact.
  const bool other_state = !(is_motion(now) && is_motion(shown_)) && !s.view.resumes;
  const double since_s = other_state ? shown_since_s_ : applied_s_;
  if (now == shown_ || (begun_ && !urgent && seconds - since_s < kShownMin_s)) return;
  begun_ = true;
  shown_ = now;
  shown_since_s_ = applied_s_ = seconds;
}

std::vector<std::string> SituationWatch::limits(const ConsoleSnapshot& s) {
  MasterView view = s.view;
  view.stiffness_clamped = view.stiffness_clamped && view.in_contact;
  view.rotational_stiffness_clamped = view.rotational_stiffness_clamped && view.in_contact;
  Clamps& robot = view.far.clamps;
  const std::array<bool*, 12> flags = {
      &view.force_clamped,   &view.stiffness_clamped, &view.rotational_stiffness_clamped,
      &view.at_boundary,     &robot.tool_speed,       &robot.joint_speed,
      &robot.joint_position, &robot.workspace,        &robot.force_guard,
      &robot.singularity,    &robot.unreachable,      &robot.moment_guard};
  static_assert(std::tuple_size_v<decltype(flags)> <= kLimits);
  for (std::size_t i = 0; i < flags.size(); ++i) {
    Limit& limit = limits_[i];
    if (*flags[i] == limit.listed) limit.same_s = s.seconds;
    if (s.seconds - limit.same_s >= kShownMin_s) limit = {!limit.listed, s.seconds};
    *flags[i] = limit.listed;
  }
  return clamps_in_words(view);
}

}  // namespace longreach
