#include "slave/side/slave_side.hpp"

#include <utility>

namespace longreach {
namespace {

// Poses of bodies per second. Between two datagrams, a body at 0.1 m/s moves by 3 mm. On a link with a budget, this share of
// it is reserved for them if there are bodies.
constexpr double kBodies_hz = 30.0, kBodiesShare = 0.1;

}  // namespace

SlaveSide::SlaveSide(const SlaveConfig& config, Channel& channel, Random random, SideObserver observer)
    : port_(channel, config.link.impairment, random), node_(config), observer_(observer) {
  limit(config.link.budget_kbit_per_s);
}

void SlaveSide::follow(const Session& session, double send_hz, bool taken) {
  port_.follow(session);
  send_hz_ = send_hz;
  taken_ = taken_ || taken;
}

void SlaveSide::configure(const SlaveConfig& config) {
  node_.configure(config);
  limit(config.link.budget_kbit_per_s);
}

void SlaveSide::limit(double kbit_per_s) {
  budget_kbit_per_s_ = kbit_per_s;
  const double share = has_bodies_ ? kBodiesShare : 0.0;
  port_.limit((1.0 - share) * kbit_per_s);
  port_.limit_bodies(share * kbit_per_s);
}

void SlaveSide::tick(Time now, Robot& robot, const LoopFigures& loop, bool stop, SlaveHook* hook) {
  port_.receive(now, node_.stalled(now, send_hz_));
  const SideFigures& figures = observer_.observe(now, port_, loop);
  const Endpoint& endpoint = port_.endpoint();
  input_ = {};
  input_.now = now;
  input_.robot = robot.read(now);
  if (hook != nullptr) hook->robot_reported(now, input_.robot);
  input_.commands = port_.commands();
  input_.last_heard = endpoint.monitor().last_heard();
  input_.peer_session_count = endpoint.sessions();
  input_.taken = std::exchange(taken_, false);
  input_.stop = stop;
  input_.send_hz = send_hz_;
  input_.rejected = port_.rejected_total();
  input_.late_ticks = loop.ticks_late_100ms;
  input_.overdue_ticks = loop.overdue_ticks;
  input_.up_loss = figures.link.loss;
  input_.up_jitter_s = figures.link.jitter_s;
  input_.may_send = port_.may_send(now);

  if (hook != nullptr) hook->before_slave_step(input_);
  output_ = node_.step(input_);
  if (hook != nullptr) hook->after_slave_step(output_);

  if (output_.grip) robot.grip(*output_.grip);
  robot.write(output_.joint_setpoint_rad);
  report_bytes_ = output_.report ? port_.send(now, output_.report_sequence, *output_.report) : 0;
  if (output_.telemetry) port_.send(now, output_.telemetry_sequence, *output_.telemetry);
  send_bodies(now, robot);
}

void SlaveSide::send_bodies(Time now, const Robot& robot) {
  const BodyPoses bodies = robot.tracked_bodies();
  if (bodies.empty()) return;
  if (!std::exchange(has_bodies_, true)) limit(budget_kbit_per_s_);
  if (port_.may_send_bodies(now) && bodies_.due(now, kBodies_hz)) port_.send(now, ++bodies_sequence_, bodies);
}

}  // namespace longreach
