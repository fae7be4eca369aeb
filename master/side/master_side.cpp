#include "master/side/master_side.hpp"

namespace longreach {

MasterSide::MasterSide(const MasterConfig& config, Channel& channel, Random random, SideObserver observer)
    : port_(channel, config.link.impairment, random), node_(config), observer_(observer) {
  port_.limit(config.link.budget_kbit_per_s);
}

void MasterSide::follow(const Session& session) {
  port_.follow(session);
  preempted_ = false;
}

void MasterSide::configure(const MasterConfig& config) {
  node_.configure(config);
  port_.limit(config.link.budget_kbit_per_s);
}

const HandleState& MasterSide::read(Time now, HapticDevice& device, MasterHook* hook) {
  port_.receive(now, node_.stalled(now));
  input_ = {};
  input_.now = now;
  input_.handle = device.read(now);
  if (hook != nullptr) hook->handle_reported(input_.handle);
  return input_.handle;
}

void MasterSide::step(HapticDevice& device, const LoopFigures& loop, const OperatorSays& operator_says,
                      MasterHook* hook) {
  const Time now = input_.now;
  const Endpoint& endpoint = port_.endpoint();
  if (operator_says.lost) input_.handle.ok = false;
  input_.reports = port_.reports();
  input_.telemetry = port_.telemetry();
  input_.bodies = port_.bodies();
  input_.requests = operator_says.requests;
  input_.last_heard = endpoint.monitor().last_heard();
  input_.peer_restarts = endpoint.restarts();
  input_.taken = preempted_;
  input_.hand_stale = operator_says.hand_stale;
  input_.rtt_s = observer_.observe(now, port_, loop).link.rtt_s;
  input_.may_send = port_.may_send(now);
  input_.overdue_ticks = loop.overdue_ticks;

  if (hook != nullptr) hook->before_master_step(input_);
  output_ = node_.step(input_);
  if (hook != nullptr) hook->after_master_step(output_);

  device.write(output_.F_H_M);
  if (output_.command) port_.send(now, output_.sequence, *output_.command);
}

}  // namespace longreach
