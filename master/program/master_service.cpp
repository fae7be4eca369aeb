#include "master/program/master_service.hpp"

#include "common/link/estimate_words.hpp"
#include "common/messages/conversion.hpp"
#include "master/console/words.hpp"

namespace longreach {
namespace {

void add_view(proto::Status& out, const MasterView& view) {
  if (view.refusal != HoldCause::kNone)
    out.set_refusal((view.refusal_is_far ? "at the slave: " : "") + with_remedy(view.refusal));
  out.set_far_state(std::string(to_string(view.far_state)));
  out.set_mode(view.mode == MotionMode::kRate ? "rate" : "position");
  out.set_scale(view.scale);
  assign(view.p_MH, *out.mutable_hand_m());
  assign(view.goal_m, *out.mutable_goal_m());
  if (view.far_known) {
    assign(view.far.X_WE.p, *out.mutable_tool_m());
    out.set_gripper(in_words(view.far.gripper));
  }
  out.set_stiffness_n_per_m(view.stiffness_n_per_m);
  out.set_force_n(view.F_H_M.force.norm());
  out.set_contact_n(view.spring_force_n.norm());
  out.set_energy_j(view.port_energy_j);
  out.set_energy_min_j(view.port_energy_min_j);
  if (view.force_clamped) out.add_clamped("force at the hand");
  if (view.stiffness_clamped) out.add_clamped("stiffness at the hand");
  if (view.rotational_stiffness_clamped) out.add_clamped("rotational stiffness at the hand");
  if (view.damping_injected) out.add_clamped("energy at the hand");
  if (const std::string moved = moved_out_in_words(view); !moved.empty()) out.add_clamped(moved);
  if (view.far_known) add_clamps(*out.mutable_clamped(), view.far.clamps, view.far.X_WE, view.far.X_WE_goal);
  if (view.far_known)
    add_load_limit(*out.mutable_clamped(), view.far.load_acceleration_m_per_s2,
                   view.far.load_acceleration_rad_per_s2);
  add_reduced(*out.mutable_reduced_protection(), view.reduced | view.far.reduced);
}

void add_view_counts(proto::Status& out, const MasterView& view) {
  add_count(out, "reports", view.reports);
  add_count(out, "rejected_values", view.rejected_values);
  add_count(out, "false_holds", view.false_holds);
  if (view.far_known) add_count(out, "limit_violations", view.far.limit_violations);
}

bool begins_with(const std::string& path, std::string_view group) {
  return std::string_view(path).substr(0, group.size()) == group;
}

/// Returns whether an assignment changes a field that the script uses. It also follows a goal whose kv has changed.
bool moves_script(const Assignments& assignments) {
  for (const auto& [path, value] : assignments) {
    const bool kv = begins_with(path, "mapping.kv_");
    if (begins_with(path, "operator.") || (begins_with(path, "mapping.") && !kv)) return true;
  }
  return false;
}

}  // namespace

proto::Status MasterService::status() {
  const MasterSnapshot s = snapshot();
  proto::Status out = common_status(s);
  add_view(out, s.view);
  to_shown_message(s.view, *out.mutable_master_view());
  out.mutable_master_view()->set_tick(s.side.loop.ticks);
  add_view_counts(out, s.view);
  add_counts(out, s.adapter);
  const std::lock_guard lock(troubling_);
  out.set_trouble(trouble_);
  out.set_situation(std::string(text_of(shown_.situation).key));
  out.set_happening(shown_.sentence);
  out.set_lease(taken_by_);
  return out;
}

std::optional<Refusal> MasterService::check(const Assignments& assignments, Change& change) {
  change.script = moves_script(assignments);
  return std::nullopt;
}

std::variant<std::string, Refusal> MasterService::act(const proto::Action& action) {
  OperatorRequests requests;
  switch (action.action_case()) {
    case proto::Action::kMode:
      requests.mode = action.mode() == proto::RATE ? MotionMode::kRate : MotionMode::kPosition;
      return unless(request(requests),
                    action.mode() == proto::RATE ? "mode set to rate" : "mode set to position");
    case proto::Action::kScale:
      requests.scale = action.scale();
      return unless(request(requests), "the scale was set");
    case proto::Action::kKvPerS:
      requests.kv_per_s = action.kv_per_s();
      return unless(request(requests), "kv was set");
    case proto::Action::kEngage:
      return unless(engage(), "engaging");
    default:
      return Refusal{Refusal::Kind::kInvalid, "the master has no such action"};
  }
}

std::optional<Refusal> MasterService::engage() {
  {
    const std::lock_guard lock(troubling_);
    if (!trouble_.empty()) return Refusal{Refusal::Kind::kPrecondition, trouble_};
  }
  const double silence_s = snapshot().side.link.silence_s;
  if (!(silence_s <= present()->safety().silence_s())) {
    return Refusal{Refusal::Kind::kPrecondition,
                   "no datagrams arrive from the slave; check that longreach-slave is running and that "
                   "link.slave and link.slave_rpc are its addresses; the master's log has details"};
  }
  if (snapshot().view.hand_missing) {
    return Refusal{Refusal::Kind::kPrecondition,
                   "no hand is on the handle; grasp the handle and then engage, or set "
                   "safety.presence to IGNORE"};
  }
  OperatorRequests requests;
  requests.engage = true;
  return request(requests);
}

std::optional<Refusal> MasterService::request(const OperatorRequests& requests) {
  if (requests.stop) return stop();  // other requests made together with a stop are ignored
  return post(requests);
}

std::string MasterService::trouble() {
  const std::lock_guard lock(troubling_);
  return trouble_;
}

Shown MasterService::shown() {
  const std::lock_guard lock(troubling_);
  return shown_;
}

void MasterService::put_shown(const Shown& shown) {
  const std::lock_guard lock(troubling_);
  shown_ = shown;
}

void MasterService::put_trouble(const std::string& trouble, const std::string& taken_by) {
  const bool preempted = !taken_by.empty();
  {
    const std::lock_guard lock(troubling_);
    if (trouble == trouble_ && taken_by == taken_by_) return;
    trouble_ = trouble;
    taken_by_ = taken_by;
  }
  if (preempted) (void)post(MasterPreempted{});
}

bool MasterService::adopt(const Session& session) { return !post(session); }

std::variant<proto::OpenSessionResponse, Refusal> MasterService::open_session(
    const proto::OpenSessionRequest&, const std::string&) {
  return Refusal{Refusal::Kind::kPrecondition, "this is the master; open sessions at the slave"};
}

std::optional<Refusal> MasterService::close_session(std::uint64_t) {
  return Refusal{Refusal::Kind::kPrecondition, "this is the master; close sessions at the slave"};
}

}  // namespace longreach
