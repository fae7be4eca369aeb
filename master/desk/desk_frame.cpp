#include "master/desk/desk_frame.hpp"

#include "common/messages/conversion.hpp"
#include "common/rpc/status_fields.hpp"
#include "master/console/words.hpp"

namespace longreach {

proto::Frame to_frame(const ConsoleSnapshot& s, double workspace_m) {
  proto::Frame out;
  out.set_seconds(s.seconds);
  out.set_state(std::string(to_string(s.view.state)));
  out.set_situation(std::string(text_of(s.shown.situation).key));
  out.set_happening(s.shown.sentence);
  for (const std::string& words : s.shown.limits) out.add_clamped(words);
  add_reduced(*out.mutable_reduced_protection(), s.view.reduced | s.view.far.reduced);
  out.set_hand_outside(s.hand_outside);
  out.set_force_max_n(s.force_max_n);
  out.set_workspace_m(workspace_m);
  *out.mutable_link() = to_message(s.link);
  out.set_missed_ticks(s.missed_ticks);
  out.set_ticks_late_100ms(s.late_ticks);
  if (const auto age_s = age_of_news_s(s)) out.set_far_age_s(*age_s);
  to_shown_message(s.view, *out.mutable_view());
  return out;
}

}  // namespace longreach
