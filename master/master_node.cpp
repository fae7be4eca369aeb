#include "master/master_node.hpp"

#include <algorithm>
#include <cmath>

#include "common/link/protection.hpp"
#include "common/safety/time_watch.hpp"
#include "master/devices/button_press.hpp"
#include "master/devices/handle_behaviour.hpp"
#include "master/devices/handle_plausibility.hpp"
#include "master/devices/quantized_motion_filter.hpp"
#include "master/far_picture.hpp"
#include "master/mapping/gain_steps.hpp"
#include "master/mapping/goal_interleaver.hpp"
#include "master/mapping/goal_speed_limit.hpp"
#include "master/mapping/lead_bound.hpp"
#include "master/mapping/mapping.hpp"
#include "master/mapping/resume_gate.hpp"
#include "master/rendering/goal_history.hpp"
#include "master/rendering/rendered_device.hpp"
#include "master/rendering/renderer.hpp"
#include "master/rendering/withheld_force.hpp"
#include "master/safety/master_safety.hpp"

namespace longreach {
struct MasterNode::State {
  explicit State(const MasterConfig& c)
      : config(c),
        safety(c.safety),
        time(c.loop.rate_hz),
        behaviour(c.device),
        mapping(c.mapping),
        device(rendered_device(c)),
        motion(device.cell, c.device.velocity_filter_s),
        handle_watch(c.device),
        renderer(c.rendering, device),
        history(history_capacity(c.link.send_hz)),
        period_s(1.0 / c.loop.rate_hz) {
    view.mode = c.mapping.mode;
    view.scale = c.mapping.scale;
    view.kv_per_s = c.mapping.kv_per_s;
    view.kv_rotation_per_s = c.mapping.kv_rotation_per_s;
    view.stiffness_max_n_per_m = renderer.stiffness_max_n_per_m();
    view.rotational_stiffness_max_nm_per_rad = renderer.stiffness_max_nm_per_rad();
  }

  void decide(const MasterInput& input);
  void take_handle(HandleState h, Time now);
  void take_requests(const OperatorRequests& r, Time now);
  void ask_gripper(bool closed, Time now);
  void take_gripper(const Received<StiffnessReport>& reported);
  void take_buttons(const Buttons& now);
  void change_kv(double kv_per_s, int steps);
  void configure_mapping();
  RendererInput renderer_input();
  void take_reports(const MasterInput& input, const RendererInput& at);
  MotionCommand command();
  void book_lead(std::uint64_t sent);
  void publish(const Wrench& F);
  void publish_ages(const MasterInput& input);

  MasterConfig config;
  MasterSafety safety;
  TimeWatch time;
  HandleBehaviour behaviour;
  Mapping mapping;
  LeadBound lead{Mapping::kLead_m}, turn_lead{Mapping::kLead_rad};
  RenderedDevice device;
  QuantizedMotionFilter motion;
  HandlePlausibility handle_watch;
  Reason implausible{};  // why the state of the handle in this tick is not plausible
  bool outside = false;  // the reported pose of the handle is not used
  Renderer renderer;
  GoalHistories history;
  double period_s;
  HandleState handle{};  // last plausible state, with filtered velocities
  ResumeGate resume;
  ButtonPress mode_button, scale_up_button, scale_down_button, kv_up_button, kv_down_button;
  std::uint64_t sequence = 0;
  GoalInterleaver interleaver;
  double one_way_s = 0.0;   // half the round-trip time
  double send_phase = 1.0;  // phase within the send period, 0 to 1
  FarPicture far;
  GoalSpeedLimit goal_speed;
  Time grip_asked{};  // time of the last request for view.grip
  MasterView view;
};

MasterNode::MasterNode(const MasterConfig& config) : state_(std::make_unique<State>(config)) {}
MasterNode::~MasterNode() = default;

void MasterNode::render_by(const ContactLaw* law) { state_->renderer.render_by(law); }

void MasterNode::State::take_handle(HandleState h, Time now) {
  if (!config.device.turns) h.q_MH.setIdentity(), h.angular_rad_per_s.setZero();
  implausible = {};
  if (!is_possible(h)) {
    handle_watch.forget();
    handle.ok = false;
    return;
  }
  const bool was_outside = outside;
  if (h.ok) implausible = handle_watch.check(h, now);
  if (!h.ok) handle_watch.forget();
  const HoldCause cause = safety.cause();
  const bool distrusted = safety.state() == SafetyState::kFault &&
                          (cause == HoldCause::kHandleOutside || cause == HoldCause::kHandleJumped);
  outside = distrusted || implausible == HoldCause::kHandleOutside;
  // A handle that may not be where it is reported counts as being at home, where the device exerts no force,
  // until the next engagement is requested.
  if (outside) h.p_MH.setZero(), h.q_MH.setIdentity();
  // A jump has no speed.
  if (implausible != HoldCause::kNone || was_outside)
    motion = QuantizedMotionFilter(device.cell, config.device.velocity_filter_s);
  // The tick after a late one comes sooner: with one time for both, speed and damping would jump by a third.
  const double passed_s = std::clamp(time.passed_s().value_or(period_s), 0.1 * period_s, 3.0 * period_s);
  handle = motion.step(h, passed_s);
}

void MasterNode::State::take_requests(const OperatorRequests& r, Time now) {
  if (r.mode) view.mode = *r.mode;
  double scale = r.scale.value_or(view.scale);
  if (!is_scale(scale)) scale = view.scale, ++view.rejected_values;
  view.scale = stepped_scale(scale, r.scale_steps);
  double kv_per_s = r.kv_per_s.value_or(view.kv_per_s);
  if (!is_kv(kv_per_s)) kv_per_s = view.kv_per_s, ++view.rejected_values;
  change_kv(kv_per_s, r.kv_steps);
  view.clutched = r.clutch;
  if (r.grip) ask_gripper(*r.grip, now);
  if (r.turns_gripper) ask_gripper(!view.grip.value_or(view.far_gripper_closed), now);
}

void MasterNode::State::ask_gripper(bool closed, Time now) { view.grip = closed, grip_asked = now; }

/// A gripper request is repeated until a report that was sent after the slave received it contains the requested
/// state.
void MasterNode::State::take_gripper(const Received<StiffnessReport>& reported) {
  view.far_gripper_closed = reported.message.gripper_closed;
  view.far_load = reported.message.load;
  const bool knows = reported.echo_sent && *reported.echo_sent > grip_asked;
  if (knows && view.grip == view.far_gripper_closed) view.grip.reset();
}

/// kv of the rotation changes by the same factor.
void MasterNode::State::change_kv(double kv_per_s, int steps) {
  kv_per_s = stepped_kv(kv_per_s, steps);
  if (kv_per_s == view.kv_per_s) return;
  view.kv_rotation_per_s =
      std::clamp(kv_per_s / view.kv_per_s * view.kv_rotation_per_s, kKvMin_per_s, kKvMax_per_s);
  view.kv_per_s = kv_per_s;
  configure_mapping();
}

void MasterNode::State::configure_mapping() {
  MappingConfig present = config.mapping;
  present.kv_per_s = view.kv_per_s;
  present.kv_rotation_per_s = view.kv_rotation_per_s;
  mapping.configure(present);
}

/// Buttons act when they are pressed; the clutch acts while it is pressed.
void MasterNode::State::take_buttons(const Buttons& now) {
  if (!handle.ok) {
    for (ButtonPress* button :
         {&mode_button, &scale_up_button, &scale_down_button, &kv_up_button, &kv_down_button})
      button->forget();
    return;
  }
  if (mode_button.step(now.mode, period_s))
    view.mode = view.mode == MotionMode::kRate ? MotionMode::kPosition : MotionMode::kRate;
  const bool up = scale_up_button.step(now.scale_up, period_s);
  const bool down = scale_down_button.step(now.scale_down, period_s);
  if (up != down) view.scale = stepped_scale(view.scale, up ? 1 : -1);
  const bool faster = kv_up_button.step(now.kv_up, period_s);
  const bool slower = kv_down_button.step(now.kv_down, period_s);
  if (faster != slower) change_kv(view.kv_per_s, faster ? 1 : -1);
  view.clutched = view.clutched || now.clutch;
}

RendererInput MasterNode::State::renderer_input() {
  const SafetyState state = safety.state();
  RendererInput at;
  at.handle = handle;
  const Wrench by_itself = behaviour.step(handle, period_s);
  const HandleSprings &linear = behaviour.translation(), &angular = behaviour.rotation();
  at.translation = {by_itself.force, linear.energy_j(), linear.supplied_j()};
  at.rotation = {by_itself.moment, angular.energy_j(), angular.supplied_j()};
  at.mode = view.mode;
  at.scale = view.scale;
  at.live = state == SafetyState::kEngaged || state == SafetyState::kHolding;
  at.stale = safety.stale();
  at.load = view.far_load;
  at.clutched = view.clutched;
  return at;
}

void MasterNode::State::take_reports(const MasterInput& input, const RendererInput& at) {
  for (const auto& received : input.reports) {
    if (!received.newest) continue;
    const StiffnessReport& report = received.message;
    if (time.stalled_since() && report.state == SafetyState::kEngaged) continue;
    take_gripper(received);
    view.approach_m_per_s = report.approach_m_per_s;
    goal_speed.on_report(report.approach_m_per_s);
    safety.on_report(report);
    view.in_contact = report.translation.in_contact() || report.rotation.in_contact();
    if (report.engagement != safety.engagement() || safety.state() != SafetyState::kEngaged) continue;
    lead.on_report(report.translation, report.reached_sequence);
    turn_lead.on_report(report.rotation, report.reached_sequence);
    ++(renderer.on_report(report, history, at, mapping) ? view.reports : view.rejected_values);
  }
  far.receive(input, view);
}

void MasterNode::State::book_lead(std::uint64_t sent) {
  const GoalBound &bound = lead.bound(), &turn_bound = turn_lead.bound();
  lead.on_command(sent, bound.direction.dot(mapping.goal().position_m - bound.place));
  turn_lead.on_command(sent, turn_bound.direction.dot(log_rotation(
                                 mapping.goal().rotation * exp_rotation(turn_bound.place).conjugate())));
}

MotionCommand MasterNode::State::command() {
  const Goal& goal = mapping.goal();
  MotionCommand c;
  c.engagement = safety.engagement();
  c.request = safety.request();
  c.mode = view.mode;
  c.scale = view.scale;
  c.grip = view.grip;
  c.let_go = !handle.held;
  c.position_m = goal.position_m;
  c.rotation_rad = goal.rotation_rad;
  c.goal_kind = interleaver.next(goal, view.scale);
  return c;
}

bool MasterNode::stalled(Time now) const { return state_->time.stalls(now, state_->safety.config().gap_s); }

void MasterNode::State::decide(const MasterInput& input) {
  if (input.taken) view.grip.reset();  // another master also controls the gripper
  const std::uint32_t engagement = safety.engagement();
  const MasterSafetyInput in{.now = input.now,
                             .last_heard = input.last_heard,
                             .peer_restarts = input.peer_restarts,
                             .taken = input.taken,
                             .device_ok = handle.ok,
                             .handle = implausible,
                             .held = handle.held,
                             .hand_stale = input.hand_stale,
                             .engage = input.requests.engage,
                             .hold = input.requests.hold,
                             .stop = input.requests.stop,
                             .rtt_s = input.rtt_s,
                             .stalled_since = time.stalled_since(),
                             .delay_rose = time.delay().rose(safety.config().delay_rise_max_s),
                             .overrun = time.overrun()};
  const bool begun = safety.step(in);
  view.answer_in_s = safety.answer_in_s(in);
  // The goals of an engagement start with the first command that requests it.
  if (safety.engagement() != engagement || begun) {
    mapping.reset(handle);
    lead.reset();
    turn_lead.reset();
    history.clear();
  }
  if (begun) {
    renderer.reset(handle);
    time.rebase();
  }
}

MasterOutput MasterNode::step(const MasterInput& input) {
  State& s = *state_;
  s.time.receive(input.now, input.reports);
  s.time.receive(input.now, input.telemetry);
  s.time.step(input.now, s.safety.config().gap_s, input.overdue_ticks);
  // The operator: handle, requests and buttons; then the state of safety that they ask for and the slave permits.
  s.take_handle(input.handle, input.now);
  s.one_way_s = 0.5 * input.rtt_s.value_or(0.0);
  s.take_requests(input.requests, input.now);
  s.take_buttons(s.handle.buttons);
  s.decide(input);
  const bool engaged = s.safety.state() == SafetyState::kEngaged;
  // The goal: the motion of the handle, limited to what the robot can follow. A released handle does not move it.
  const bool settles = s.resume.step(engaged, s.view.in_contact, s.renderer.felt(), s.handle, s.period_s);
  MappingInput moved{s.handle, s.view.mode, s.view.scale,
                     !engaged || settles || s.view.clutched || !s.handle.held};
  moved.speed_max_m_per_s = s.goal_speed.max_m_per_s(s.view.mode, input.rtt_s);
  if (engaged) moved.translation_bound = s.lead.bound(), moved.rotation_bound = s.turn_lead.bound();
  moved.surfaces = s.renderer.translation().contact.pressed();
  moved.stops = s.renderer.rotation().contact.pressed();
  s.mapping.step(moved, s.period_s);
  s.view.moved_out_m = engaged && s.view.in_contact ? s.view.moved_out_m + s.mapping.carried_m() : 0.0;
  // The force: the newest report, rendered around the handle of this tick.
  const RendererInput at = s.renderer_input();
  s.take_reports(input, at);
  MasterOutput out;
  out.F_H_M = s.renderer.step(at, s.mapping);
  // The command, at the rate of sending and if the link has room; a report later refers to its goal.
  s.send_phase += s.config.link.send_hz * s.period_s;
  if (s.send_phase >= 1.0 && input.may_send) {
    s.send_phase = std::min(s.send_phase - 1.0, 1.0);
    out.sequence = ++s.sequence;
    out.command = s.command();
    s.book_lead(out.sequence);
    s.history.translation.push(out.sequence, s.mapping.goal().position_m);
    s.history.rotation.push(out.sequence, s.mapping.goal().rotation_rad);
  }
  s.publish(out.F_H_M);
  s.publish_ages(input);
  return out;
}

void MasterNode::State::publish_ages(const MasterInput& input) {
  const double silence_s = input.last_heard ? to_seconds(input.now - *input.last_heard) : 0.0;
  far.publish_ages(input.now, view);
  view.silent = safety.stale();
  if (view.state == SafetyState::kEngaged) view.hold_silence_s = 0.0;
  if (view.state == SafetyState::kHolding) view.hold_silence_s = std::max(view.hold_silence_s, silence_s);
  view.resumes = view.state == SafetyState::kHolding && safety.request() != Request::kHold;
}

void MasterNode::State::publish(const Wrench& F) {
  const bool left = view.state == SafetyState::kEngaged && safety.state() != SafetyState::kEngaged;
  view.state = safety.state();
  view.cause = safety.cause();
  view.cause_is_far = safety.cause_is_far();
  view.gripper_closed = view.grip.value_or(view.far_gripper_closed);
  if (left) ++view.holds, view.last_hold = safety.cause();
  view.refusal = safety.refusal();
  const MasterSafetyConfig& limits = safety.config();
  view.reduced = with(0, Protection::kDelayRise, limits.delay_rise_max_s > kDelayRiseNoticed_s);
  view.reduced = with(view.reduced, Protection::kHandPresence,
                      limits.presence == Presence::kIgnore && !config.device_adapter.address.empty());
  view.refusal_is_far = safety.refusal_is_far();
  view.far_state = safety.far_state();
  view.engagement = safety.engagement();
  view.hand_missing = safety.hand_missing();
  view.engaging = safety.pending();
  view.rtt_s = time.delay().median_s();
  view.rtt_least_s = time.delay().least_s();
  view.p_MH = handle.p_MH;
  view.goal_m = mapping.goal().position_m;
  view.goal_rad = mapping.goal().rotation_rad;
  view.forecast = mapping.forecast(one_way_s);
  view.bring_home = mapping.bring_home();
  view.turn_home = mapping.turn_home();
  view.at_boundary = view.mode == MotionMode::kPosition && !mapping.frozen() &&
                     (behaviour.translation().at_stop() || behaviour.rotation().at_stop());
  view.F_H_M = F;
  const HandPort &linear = renderer.translation(), &angular = renderer.rotation();
  const ContactAxis &surface = linear.contact.foremost(), &stop = angular.contact.foremost();
  // Only the part of the force that the ramp passes reaches the operator.
  view.spring_force_n = linear.guard.gain() * linear.contact.spring_force();
  view.held = handle.held;
  view.withheld_n = view.clutched ? 0.0 : withheld_force(linear, handle);
  view.surface_n_per_m = surface.known ? surface.stiffness : 0.0;
  view.stop_nm_per_rad = stop.known ? stop.stiffness : 0.0;
  view.surface_known = linear.contact.known();
  view.surface_m = surface.surface - surface.foot / mapping.scale();
  view.inward = surface.n_M;
  view.stiffness_max_n_per_m = renderer.stiffness_max_n_per_m();
  view.stiffness_n_per_m = linear.guard.gain() * renderer.stiffness(linear);
  view.spring_moment_nm = angular.guard.gain() * angular.contact.spring_force();
  view.rotational_stiffness_nm_per_rad = angular.guard.gain() * renderer.stiffness(angular);
  view.force_step_n = renderer.force_step_n();
  view.port_energy_j = renderer.port_energy_j();
  view.port_energy_min_j = renderer.port_energy_min_j(), view.stored_energy_j = renderer.stored_energy_j();
  view.energy_drawdown_j = linear.guard.deficit_max_j() + angular.guard.deficit_max_j();
  view.tank_j = linear.tank.level_j();
  view.force_clamped = linear.guard.clamped() || linear.contact.yielding();
  view.stiffness_clamped = linear.contact.clamped();
  view.rotational_stiffness_clamped = angular.contact.clamped();
  view.rotational_stiffness_max_nm_per_rad = renderer.stiffness_max_nm_per_rad();
  view.damping_injected = linear.guard.injecting() || angular.guard.injecting();
  view.false_holds = safety.false_holds();
}

void MasterNode::configure(const MasterConfig& config) {
  State& s = *state_;
  s.safety.configure(config.safety);
  s.behaviour.configure(config.device);
  s.renderer.configure(config.rendering);
  const MappingConfig &wanted = config.mapping, &before = s.config.mapping;
  if (wanted.mode != before.mode) s.view.mode = wanted.mode;
  if (wanted.scale != before.scale) s.view.scale = wanted.scale;
  if (wanted.kv_per_s != before.kv_per_s) s.view.kv_per_s = wanted.kv_per_s;
  if (wanted.kv_rotation_per_s != before.kv_rotation_per_s)
    s.view.kv_rotation_per_s = wanted.kv_rotation_per_s;
  s.config = config;
  s.configure_mapping();
}

const MasterView& MasterNode::view() const { return state_->view; }
bool MasterNode::engaged() const { return state_->safety.state() == SafetyState::kEngaged; }

}  // namespace longreach
