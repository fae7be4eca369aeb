#include "slave/program/slave_service.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>

#include <cmath>

#include "common/link/estimate_words.hpp"
#include "common/messages/conversion.hpp"
#include "common/net/adapter_channel.hpp"
#include "common/text/number_text.hpp"
#include "slave/sensing/sensor_words.hpp"

namespace longreach {
namespace {

Refusal at_the_master(const std::string& what) {
  return {Refusal::Kind::kPrecondition, what + " is set at the master; the slave only follows"};
}

/// Why the gap timer that is set is too short for a master that sends so often; empty: it is not.
std::string too_short(double gap_s, double send_hz) {
  constexpr double kPeriods = 3.0;
  const double least_s = kPeriods / send_hz;
  if (!(gap_s > 0.0) || gap_s >= least_s) return "";
  return "safety.gap_s = " + format_number(gap_s) +
         " is less than three send periods of a master with "
         "link.send_hz = " +
         format_number(send_hz) + ": set it to at least " + format_number(least_s) +
         " at the slave, or increase link.send_hz at the master";
}

/// limit_violations_LIMIT each, as limit_violations_joint_speed.
void add_limits(proto::Status& out, const LimitViolations& violations) {
  for (std::size_t i = 0; i < violations.ticks.size(); ++i) {
    std::string name = "limit_violations_" + std::string(name_of(static_cast<Limit>(i)));
    std::ranges::replace(name, ' ', '_');
    add_count(out, name, violations.ticks[i]);
  }
}

/// Returns the reason why the robot cannot be engaged, and a remedy; empty if it can be engaged.
std::string robot_trouble(const SlaveView& view) {
  const bool idle = view.state != SafetyState::kEngaged && view.state != SafetyState::kHolding;
  const bool known = view.robot_seen && view.unready != HoldCause::kSensorZeroing;
  const bool bursts =
      view.state == SafetyState::kHolding && view.cause == HoldCause::kLinkSilent && view.cause.limit > 0.0;
  if (bursts) return with_remedy(view.cause);
  return idle && known ? with_remedy(view.unready) : "";
}

}  // namespace

proto::Status SlaveService::status() {
  const SlaveSnapshot s = snapshot();
  const SlaveView& view = s.view;
  proto::Status out = common_status(s);
  out.set_lease(lease());
  assign(view.X_WE.p, *out.mutable_tool_m());
  assign(view.X_WE_goal.p, *out.mutable_goal_m());
  assign(view.X_WE_anchor.p, *out.mutable_anchor_m());
  assign(log_rotation(view.X_WE_anchor.q), *out.mutable_anchor_rad());
  out.set_stiffness_n_per_m(view.reported_stiffness_n_per_m);
  if (view.reported_stiffness_nm_per_rad > 0.0) {
    out.set_rotational_stiffness_nm_per_rad(view.reported_stiffness_nm_per_rad);
  }
  const bool turns = view.turn_estimate.valid;
  const ContactEstimate& estimate = turns ? view.turn_estimate : view.estimate;
  if (estimate.valid) {
    out.set_estimate(stiffness_in_words(estimate, turns ? "N m/rad" : "N/m") + ", " + law_in_words(estimate));
  }
  out.set_force_n(view.F_E_W.force.norm());
  out.set_gripper(in_words(view.gripper));
  out.set_sensor(in_words(view.sensor_zero));
  out.set_sensor_warning(sensor_warning(view.sensor_zero));
  add_clamps(*out.mutable_clamped(), view.clamps, view.X_WE, view.X_WE_goal);
  add_load_limit(*out.mutable_clamped(), view.load_acceleration_m_per_s2, view.load_acceleration_rad_per_s2);
  add_reduced(*out.mutable_reduced_protection(), view.reduced);
  to_shown_message(view, *out.mutable_slave_view());
  out.mutable_slave_view()->set_tick(s.side.loop.ticks);
  if (s.watchdog_stopped) out.add_clamped("robot without setpoints");
  add_count(out, "touches", view.touch);
  add_count(out, "false_holds", view.false_holds);
  add_count(out, "limit_violations", view.limit_violations);
  add_limits(out, view.violations_by_limit);
  add_count(out, "rejected_values", view.rejected_values);
  add_count(out, "ik_failures", view.ik_failures);
  add_count(out, "rejected_setpoints", s.rejected_setpoints);
  add_counts(out, s.adapter);
  out.set_trouble(adapter_trouble(s.adapter, SlaveParts::kDevice, present()->robot_adapter().address()));
  if (out.trouble().empty()) out.set_trouble(robot_trouble(view));
  return out;
}

std::optional<Refusal> SlaveService::check(const Assignments&, Change& change) {
  if (std::string why = too_short(change.config.safety.gap_s, snapshot().send_hz); !why.empty())
    return Refusal{Refusal::Kind::kPrecondition, std::move(why)};
  return std::nullopt;
}

std::variant<std::string, Refusal> SlaveService::act(const proto::Action& action) {
  switch (action.action_case()) {
    case proto::Action::kMode:
      return at_the_master("the mode");
    case proto::Action::kScale:
      return at_the_master("the scale");
    case proto::Action::kKvPerS:
      return at_the_master("kv");
    case proto::Action::kEngage:
      return at_the_master("engagement");
    default:
      return Refusal{Refusal::Kind::kInvalid, "the slave has no such action"};
  }
}

std::variant<proto::OpenSessionResponse, Refusal> SlaveService::open_session(
    const proto::OpenSessionRequest& request, const std::string& caller) {
  proto::OpenSessionResponse response;
  if (request.session() != 0 && request.session() == snapshot().side.session) {
    response.set_session(request.session());
    return response;
  }
  const double send_hz = request.send_hz();
  if (!(send_hz >= 50.0 && send_hz <= 4000.0)) {
    return Refusal{Refusal::Kind::kInvalid, "a master must send 50 to 4000 datagrams per second, not " +
                                                format_number(send_hz) +
                                                "; run the same version of all programs"};
  }
  if (std::string why = too_short(present()->safety().gap_s(), send_hz); !why.empty())
    return Refusal{Refusal::Kind::kPrecondition, std::move(why)};
  const bool aes = request.aes256gcm() && has_aes256gcm();
  const Session session = draw_session(aes ? Cipher::kAes256Gcm : Cipher::kChaCha20Poly1305);
  const std::string before = lease();
  if (auto refusal = post(SlaveLease{session, request.take(), send_hz})) {
    return refusal->kind == Refusal::Kind::kPrecondition ? occupied(caller) : *std::move(refusal);
  }
  spdlog::info("lease holder={} before=\"{}\" taken={}", caller, before, request.take());
  add_event("lease to " + caller + (request.take() ? ", taken" : ""));
  set_lease(caller);
  response.set_session(session.number);
  response.set_secret(session.secret.data(), session.secret.size());
  response.set_aes256gcm(aes);
  return response;
}

Refusal SlaveService::occupied(const std::string& caller) {
  const std::string holder = lease();
  // Who is refused asks again every 2 s.
  if (caller != refused_) spdlog::warn("lease refused={} holder={}", caller, holder);
  refused_ = caller;
  return {Refusal::Kind::kPrecondition,
          "another master has control of the robot (" + holder +
              "); stop that master, wait until it has sent nothing for 1 s, or start this one with --take",
          holder};
}

std::optional<Refusal> SlaveService::close_session(std::uint64_t session) {
  if (post(SlaveReturn{session}))
    return Refusal{Refusal::Kind::kPrecondition, "this master does not have control of the robot"};
  spdlog::info("lease returned by={}", lease());
  add_event("lease returned by " + lease());
  set_lease("");
  return std::nullopt;
}

std::string SlaveService::lease() const {
  const std::lock_guard lock(leasing_);
  return lease_;
}

void SlaveService::set_lease(const std::string& holder) {
  const std::lock_guard lock(leasing_);
  lease_ = holder;
}

}  // namespace longreach
