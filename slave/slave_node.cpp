#include "slave/slave_node.hpp"

#include <algorithm>
#include <cmath>

#include "common/link/playout.hpp"
#include "common/safety/time_watch.hpp"
#include "slave/command/motion.hpp"
#include "slave/config/first_touch.hpp"
#include "slave/config/reduced_protection.hpp"
#include "slave/safety/command_authority.hpp"
#include "slave/safety/joint_plausibility.hpp"
#include "slave/safety/joint_speed_check.hpp"
#include "slave/safety/plausible.hpp"
#include "slave/safety/robot_watch.hpp"
#include "slave/safety/slave_safety.hpp"
#include "slave/sensing/gripper.hpp"
#include "slave/slave_reports.hpp"
#include "slave/slave_sensing.hpp"
#include "slave/tool_held_back.hpp"

namespace longreach {
namespace {

constexpr double kDtMax = 0.02;  // a later tick does not move farther than a tick of this duration
constexpr double kReachedM = 1e-3, kReachedRad = 0.01;  // distance within which a goal counts as reached

}  // namespace

struct SlaveNode::State {
  explicit State(const SlaveConfig& config)
      : reports(config),
        loop_hz(config.loop.rate_hz),
        safety(config.safety),
        time(config.loop.rate_hz),
        motion(config.command, config.robot, first_touch(config)),
        joints(config.robot),
        watch(config.robot),
        authority(config.robot),
        lead(config.robot.servo_hz),
        reduced(reduced_protection(config)),
        sensing(config),
        playout(config.playout),
        turn_playout(config.playout) {}

  void accept_robot(const RobotState& robot, Time now);
  void watch_robot(const RobotState& robot);
  void follow(const RobotState& robot);
  Clamps move(const std::optional<Pose>& X_WE_goal);
  bool decide(const SlaveInput& input);
  [[nodiscard]] Reason unready(const RobotState& robot) const;
  void begin_engagement();
  void take_goals(std::span<const Received<MotionCommand>> commands);
  Pose play(Time now);
  void update(const RobotState& robot, Time now);
  void sense(Time now, double dt);
  [[nodiscard]] bool reflexes_move() const;
  void book_reached();
  void book_held_back(const Clamps& clamps, double dt);
  void show(const Clamps& clamps, std::uint64_t rejected_values);

  SlaveReports reports;
  double loop_hz;
  SlaveSafety safety;
  TimeWatch time;
  SlaveMotion motion;
  JointPlausibility joints;
  RobotWatch watch;
  CommandAuthority authority;
  SetpointLead lead;
  JointSpeedCheck joint_speeds;
  std::uint32_t reduced;  // bits of Protection that the configuration determines
  SlaveSensing sensing;
  Playout playout;       // of position goals
  Playout turn_playout;  // of orientation goals: each datagram carries one of the two
  SlaveView view;

  bool robot_ok = true;
  Pose X_WE_anchor{};
  double scale = 1.0;   // k_scale as last sent
  bool let_go = false;  // as last sent
  Gripper gripper;
  double played_sequence = 0.0, played_turn_sequence = 0.0;
  std::uint64_t reached_sequence = 0;
  ToolHeldBack held_back;
  std::uint64_t rejected_values = 0;
};

SlaveNode::SlaveNode(const SlaveConfig& config) : state_(std::make_unique<State>(config)) {}
SlaveNode::~SlaveNode() = default;

const SlaveView& SlaveNode::view() const { return state_->view; }
bool SlaveNode::engaged() const { return state_->safety.state() == SafetyState::kEngaged; }

void SlaveNode::configure(const SlaveConfig& config) {
  State& s = *state_;
  s.reports.configure(config);
  s.safety.configure(config.safety);
  s.motion.configure(config.command, first_touch(config));
  s.reduced = reduced_protection(config);
  s.sensing.configure(config);
  s.playout.configure(config.playout);
  s.turn_playout.configure(config.playout);
}

SlaveOutput SlaveNode::step(const SlaveInput& input) {
  State& s = *state_;
  // Time: how long the tick is, and whether the commands are too old to be followed.
  s.time.receive(input.now, input.commands);
  s.time.step(input.now, gap_s(s.safety.config(), input.send_hz), input.overdue_ticks);
  const double dt = std::clamp(s.time.passed_s().value_or(1.0 / s.loop_hz), 0.0, kDtMax);

  // The robot: a state that is not possible is not used; an arm without commands is followed.
  s.accept_robot(input.robot, input.now);
  s.watch_robot(input.robot);
  if (s.robot_ok) s.update(input.robot, input.now);
  if (s.robot_ok && !s.authority.commands()) s.follow(input.robot);

  // Safety first: state and authority are those of this tick before a goal is looked at.
  if (s.decide(input)) s.begin_engagement();
  s.authority.step({s.safety.state(), s.robot_ok && !s.watch.tracking_lost(), s.motion.at_rest(), dt});

  // The goal, one playout delay after it has arrived.
  if (!s.time.stalled_since()) s.take_goals(input.commands);
  std::optional<Pose> X_WE_goal;
  if (s.safety.state() == SafetyState::kEngaged) X_WE_goal = s.play(input.now);

  // The contact is measured before the motion, whose force guard needs it.
  if (s.robot_ok) s.sense(input.now, dt);
  const Clamps clamps = s.authority.commands() && dt > 0.0 ? s.move(X_WE_goal) : Clamps{};

  // What is shown and reported is what this tick has done.
  s.view.X_WE_goal = X_WE_goal ? *X_WE_goal : s.motion.X_WE();
  s.show(clamps, s.rejected_values);
  s.book_reached();
  s.book_held_back(clamps, dt);

  SlaveOutput output;
  if (s.authority.commands()) output.joint_setpoint_rad = s.motion.joint_setpoint_rad();
  output.grip = s.gripper.asked();
  s.reports.report(
      input, s.view, s.reached_sequence,
      {s.playout, s.turn_playout, s.X_WE_anchor.p, s.played_sequence, s.played_turn_sequence},
      {s.sensing.contact(), s.view.X_WE.p - s.X_WE_anchor.p, s.held_back.place(), s.X_WE_anchor.p},
      {s.sensing.turn_contact(), log_rotation(s.view.X_WE.q * s.X_WE_anchor.q.conjugate()),
       s.held_back.turn(), Vector3::Zero()},
      output);
  s.reports.telemetry(input, s.view, s.robot_ok, s.sensing.contact().foremost().depth_m(), output);
  s.view.touch_sequence = s.sensing.contact().foremost().touch_sequence();
  return output;
}

bool SlaveNode::stalled(Time now, double send_hz) const {
  return state_->time.stalls(now, gap_s(state_->safety.config(), send_hz));
}

// Returns true if a new engagement starts.
bool SlaveNode::State::decide(const SlaveInput& input) {
  SlaveSafetyInput in;
  in.now = input.now;
  in.last_heard = input.last_heard;
  in.peer_session_count = input.peer_session_count;
  in.taken = input.taken;
  if (!robot_ok) in.robot = view.unready;
  if (robot_ok) in.unready = view.unready = unready(input.robot);
  in.robot_uncommanded_motion = watch.uncommanded_motion();
  in.robot_tracking_lost = watch.tracking_lost();
  in.sensor_fault = robot_ok && !sensing.ok();
  in.sensor_sign = sensing.plausibility().wrong_sign();
  in.force_persists = motion.force_persists() || sensing.plausibility().force_persists();
  in.comes = sensing.plausibility().comes(sensing.contact().normal());
  in.stop = input.stop;
  in.send_hz = input.send_hz;
  in.lag_s = motion.lag_s();
  in.stalled_since = time.stalled_since();
  in.delay_rose = time.delay().rose(safety.config().delay_rise_max_s);
  in.overrun = time.overrun();
  for (const Received<MotionCommand>& received : input.commands) {
    const MotionCommand& command = received.message;
    const bool valid = possible(command);
    if (!valid) ++rejected_values;
    // A stop is obeyed even if the rest of the command is invalid.
    if (!received.newest || ((!valid || in.stalled_since) && command.request != Request::kStop)) continue;
    in.commanded = true;
    in.engagement = command.engagement;
    in.request = command.request;
    in.echo_sent = received.echo_sent;
  }
  return safety.step(in);
}

Reason SlaveNode::State::unready(const RobotState& robot) const {
  if (!motion.in_workspace()) return motion.outside();
  const Reason why = authority.why_not(robot, motion.joint_setpoint_rad());
  if (why != HoldCause::kNone) return why;
  if (const Reason constant = sensing.constant(); constant != HoldCause::kNone) return constant;
  return sensing.ready() ? Reason() : Reason(HoldCause::kSensorZeroing);
}

void SlaveNode::State::accept_robot(const RobotState& robot, Time now) {
  if (!robot.ok) joints.forget();
  view.unready = robot.ok && finite(robot) ? joints.check(robot, now) : Reason(HoldCause::kRobotFault);
  robot_ok = view.unready == HoldCause::kNone;
  if (robot_ok) gripper.see(robot);
  if (robot_ok) joint_speeds.step(robot);
  if (robot_ok && !view.robot_seen) sensing.zero();
  view.robot_seen = view.robot_seen || robot_ok;
}

// Compares the measured state with the setpoint of the previous tick.
void SlaveNode::State::watch_robot(const RobotState& robot) {
  if (robot_ok)
    watch.step(robot, motion.joint_setpoint_rad(), authority.commands(), motion.at_rest(), 1.0 / loop_hz,
               time.stalled_since().has_value());
}

// The robot is not commanded, so the setpoint follows its measured position.
void SlaveNode::State::follow(const RobotState& robot) {
  motion.reset(robot.joint_rad);
  lead.reset(motion.X_WE());
}

// Moves by the nominal period even if the tick is late, so the limits hold from setpoint to setpoint, and the
// missed motion is caught up within them.
Clamps SlaveNode::State::move(const std::optional<Pose>& X_WE_goal) {
  const double dt = 1.0 / loop_hz;
  const bool brakes = safety.brakes() || sensing.plausibility().rests();
  const bool reflexes = reflexes_move();
  const Clamps clamps =
      motion.step({brakes ? std::nullopt : X_WE_goal, sensing.pressed(lead, reflexes), dt, let_go,
                   sensing.turned(lead, reflexes), view.X_WE.p, sensing.load().bound_kg()});
  lead.step(motion.X_WE(), dt);
  return clamps;
}

void SlaveNode::State::begin_engagement() {
  const Quaternion q_before = X_WE_anchor.q;
  X_WE_anchor = motion.X_WE();
  sensing.begin(q_before, X_WE_anchor.q);
  motion.renew();
  playout.clear();
  turn_playout.clear();
  time.rebase();
  reached_sequence = 0, played_sequence = played_turn_sequence = 0.0;
}

void SlaveNode::State::take_goals(std::span<const Received<MotionCommand>> commands) {
  if (!safety.follows()) return;
  for (const Received<MotionCommand>& received : commands) {
    const MotionCommand& command = received.message;
    if (command.engagement != safety.engagement() || command.request != Request::kEngage ||
        !possible(command)) {
      continue;
    }
    if (received.newest) {
      scale = command.scale;
      gripper.ask(command.grip);
      let_go = command.let_go;
    }
    const bool turns = command.goal_kind == GoalKind::kGoalOrientation;
    (turns ? turn_playout : playout)
        .push(received.received, received.sent, received.sequence,
              turns ? command.rotation_rad : command.position_m);
  }
}

Pose SlaveNode::State::play(Time now) {
  Pose X_WE = X_WE_anchor;
  if (const auto played = playout.play(now)) {
    played_sequence = played->sequence;
    X_WE.p += played->goal;
  }
  if (const auto played = turn_playout.play(now)) {
    played_turn_sequence = played->sequence;
    X_WE.q = (exp_rotation(played->goal) * X_WE.q).normalized();
  }
  return X_WE;
}

void SlaveNode::State::update(const RobotState& robot, Time now) {
  sensing.update(robot, motion.kinematics(), gripper.may_hold(), now);
  view.X_WE = sensing.X_WE();
  view.F_E_W = sensing.F_E_W();
}

void SlaveNode::State::sense(Time now, double dt) {
  SensingInput in{safety.state(), let_go, lead.still(), scale};
  if (safety.follows()) in.played_sequence = played_sequence, in.played_turn_sequence = played_turn_sequence;
  in.news_age_s = safety.news_age_s(now) + playout.delay_s();
  in.clamps = view.clamps;
  in.q_anchor = X_WE_anchor.q;
  in.dt = dt;
  sensing.step(in);
}

// The guards may not move a robot that is stopped or not ok, or whose force sensor is faulty.
bool SlaveNode::State::reflexes_move() const { return safety.follows() && robot_ok && sensing.ok(); }

void SlaveNode::State::book_reached() {
  if (safety.state() != SafetyState::kEngaged || played_sequence < 1.0) return;
  if ((view.X_WE.p - view.X_WE_goal.p).norm() > kReachedM ||
      log_rotation(view.X_WE_goal.q * view.X_WE.q.conjugate()).norm() > kReachedRad)
    return;
  reached_sequence = std::max(reached_sequence, static_cast<std::uint64_t>(played_sequence));
}

void SlaveNode::State::book_held_back(const Clamps& clamps, double dt) {
  if (safety.state() != SafetyState::kEngaged || !robot_ok) return held_back.reset();
  held_back.step({clamps, view.X_WE, view.X_WE_goal, X_WE_anchor, motion.workspace_centre_m(), dt},
                 sensing.contact(), sensing.turn_contact());
}

void SlaveNode::State::show(const Clamps& clamps, std::uint64_t rejected) {
  view.state = safety.state();
  view.cause = safety.cause();
  view.refused = safety.refused();
  view.refusal = safety.refusal();
  view.ended = safety.ended();
  view.ended_because = safety.ended_because();
  view.engagement = safety.engagement();
  view.gripper = gripper.state(sensing.load());
  view.sensor_zero = sensing.sensor_zero();
  view.X_WE_anchor = X_WE_anchor;
  view.in_contact = !sensing.free();
  const SlaveContact& contact = sensing.contact();
  const Surface &surface = contact.foremost(), &stop = sensing.turn_contact().foremost();
  view.estimate = surface.estimate();
  view.reported_stiffness_n_per_m = surface.reported().stiffness_n_per_m();
  view.turn_estimate = stop.estimate();
  view.reported_stiffness_nm_per_rad = stop.reported().stiffness_n_per_m();
  view.reported_at_m = surface.reported_at_m();
  view.touch_sequence = surface.touch_sequence();
  view.touch = contact.touch();
  view.played_sequence = played_sequence;
  view.playout_delay_s = playout.delay_s();
  view.clamps = clamps;
  view.approach_m_per_s = motion.approach_m_per_s();
  view.load_acceleration_m_per_s2 = motion.load_acceleration_m_per_s2();
  view.load_acceleration_rad_per_s2 = motion.load_acceleration_rad_per_s2();
  view.reduced = with(reduced, Protection::kJointSpeed, joint_speeds.missing());
  view.limit_violations = motion.limit_violations();
  view.violations_by_limit = motion.violations_by_limit();
  view.false_holds = safety.false_holds();
  view.rejected_values = rejected;
  view.ik_failures = motion.failures();
}

}  // namespace longreach
