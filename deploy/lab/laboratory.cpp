#include "deploy/lab/laboratory.hpp"

#include <stdexcept>

#include "deploy/lab/mjcf_robots.hpp"
#include "deploy/lab/recording/lab_recording.hpp"
#include "master/rendering/comparison/comparison_law.hpp"
#include "slave/simulation/simulated_arm.hpp"

namespace longreach {

namespace {

constexpr Duration kFigures = std::chrono::milliseconds(250);

/// Not a real secret: it is derived from the seed of the run.
Session session_of(Random random) {
  Session session{.number = 1};
  for (auto& b : session.secret) b = static_cast<std::byte>(random.next());
  return session;
}

std::unique_ptr<SimulatedRobot> make_robot(const SlaveConfig& slave, Random random) {
  if (slave.robot.mjcf.empty()) return std::make_unique<SimulatedArm>(slave, random);
  if (mjcf_robots == nullptr)
    throw std::invalid_argument("robot.mjcf = " + slave.robot.mjcf +
                                ": this program does not contain MuJoCo; use longreach-lab");
  return mjcf_robots->make(slave, random);
}

}  // namespace

Laboratory::Laboratory(const MasterConfig& master, const SlaveConfig& slave, std::uint64_t seed)
    : period_(from_seconds(1.0 / master.loop.rate_hz)),
      send_hz_(sent_hz(master.link)),
      master_config_(master),
      slave_config_(slave),
      seed_(seed),
      random_(seed),
      master_port_(channels_.a(), master.link.impairment, random_.child("down")),
      slave_port_(channels_.b(), slave.link.impairment, random_.child("up")),
      slave_node_(slave),
      master_node_(master),
      arm_(make_robot(slave, random_.child("arm"))),
      devices_(master.device),
      script_(master.operator_, master.mapping, master.hand.grip) {
  if (is_comparison(master.rendering.law)) {
    throw std::invalid_argument(
        "this experiment accepts only rendering.law = STIFFNESS or NAIVE; the comparison laws run in "
        "the experiments press-wall and delay-sweep");
  }
  master_port_.limit(master.link.budget_kbit_per_s);
  slave_port_.limit(slave.link.budget_kbit_per_s);
  const Session session = session_of(random_.child("session"));
  master_port_.follow(session);
  slave_port_.follow(session);
}

Laboratory::~Laboratory() = default;

void Laboratory::record(const std::filesystem::path& file) {
  recording_ = std::make_unique<LabRecording>(file, master_config_, slave_config_, seed_,
                                              LabRecording::Clocks{master_now(), slave_now()});
}

void Laboratory::end_recording() {
  if (recording_) recording_->finish();
  recording_.reset();
}

void Laboratory::step() {
  if (on_first_step && elapsed_ == Duration{})
    on_first_step({master_config_, slave_config_, driven_.has_value()});
  elapsed_ += period_;
  step_slave();
  if (intruder_) intruder_(channels_);
  step_master();
  if (intruder_) intruder_(channels_);
}

void Laboratory::step_slave() {
  const Time now = slave_now();
  if (!slave_lives_ || elapsed_ <= slave_thaws_ || (fault_hooks_ && fault_hooks_->slave_skips_tick())) {
    ++slave_overdue_;
    arm_->read(now);
    return;
  }
  slave_port_.receive(now, slave_node_.stalled(now, send_hz_));
  const Endpoint& endpoint = slave_port_.endpoint();
  SlaveInput in;
  in.now = now;
  in.robot = arm_->read(now);
  if (tamperer_) tamperer_(now, in.robot);
  if (fault_hooks_) fault_hooks_->robot_reported(in.robot);
  in.commands = slave_port_.commands();
  in.last_heard = endpoint.monitor().last_heard();
  in.peer_session_count = endpoint.sessions();
  in.send_hz = send_hz_;
  in.rejected = slave_port_.rejected_total();
  in.may_send = slave_port_.may_send(now);
  in.overdue_ticks = slave_overdue_;
  if (fault_hooks_) fault_hooks_->before_slave_step(in);
  SlaveOutput out = slave_node_.step(in);
  if (fault_hooks_) fault_hooks_->after_slave_step(out);
  if (recording_) recording_->add_slave_tick(in, out, slave_node_.view());
  setpoint_rad_ = out.joint_setpoint_rad;
  arm_->write(out.joint_setpoint_rad);
  if (out.grip) arm_->grip(*out.grip);
  if (out.report) {
    report_places_.push(slave_node_.view().reported_at_m);
    last_report_ = out.report_sequence;
    ++haptic_return_.datagrams;
    haptic_return_.bytes += slave_port_.send(now, out.report_sequence, *out.report) - kOverheadBytes;
  }
  if (out.telemetry) slave_port_.send(now, out.telemetry_sequence, *out.telemetry);
}

void Laboratory::step_master() {
  if (!master_lives_) return;
  const Time now = master_now();
  if (elapsed_ <= master_thaws_ || (fault_hooks_ && fault_hooks_->master_skips_tick())) {
    ++master_overdue_;
    if (driven_) devices_.set_target(*driven_);
    devices_.read(now);
    return;
  }
  master_port_.receive(now, master_node_.stalled(now));
  const Endpoint& endpoint = master_port_.endpoint();
  HandleState handle = devices_.read(now);
  if (fault_hooks_) fault_hooks_->handle_reported(handle);
  const MasterView& view = master_node_.view();
  const ScriptOutput script = script_.step({.now = now,
                                            .handle_m = handle.p_MH,
                                            .felt_n = view.spring_force_n.norm(),
                                            .goal_m = view.goal_m,
                                            .scale = view.scale,
                                            .engaged = view.state == SafetyState::kEngaged,
                                            .engagement = view.engagement,
                                            .surface_known = view.surface_known,
                                            .depth_m = view.inward.dot(handle.p_MH) - view.surface_m});
  HandTarget target = driven_.value_or(script.target);
  if (let_go_) target.grip = Grip::kReleased;
  devices_.set_target(target);
  MasterInput in;
  in.now = now;
  in.handle = handle;
  in.reports = master_port_.reports();
  in.telemetry = master_port_.telemetry();
  in.requests = requests_;
  if (script.mode && !driven_) in.requests.mode = script.mode;
  in.last_heard = endpoint.monitor().last_heard();
  in.peer_restarts = endpoint.restarts();
  // As in the programs, this is not computed in every tick, because it sorts the samples of the last seconds.
  if (elapsed_ % kFigures < period_) rtt_s_ = link().rtt_s;
  in.rtt_s = rtt_s_;
  in.may_send = master_port_.may_send(now);
  in.overdue_ticks = master_overdue_;
  if (fault_hooks_) fault_hooks_->before_master_step(in);
  MasterOutput out = master_node_.step(in);
  if (fault_hooks_) fault_hooks_->after_master_step(out);
  if (recording_) recording_->add_master_tick(in, out, master_node_.view(), rtt_s_);
  devices_.write(out.F_H_M);
  if (out.command) master_port_.send(now, out.sequence, *out.command);
  requests_ = OperatorRequests{};
  for (const auto& received : in.reports) {
    const std::uint64_t back = last_report_ - received.sequence;
    if (!received.newest || !received.message.translation.in_contact() || back >= report_places_.size())
      continue;
    rendered_at_m_ = report_places_[report_places_.size() - 1 - back];
  }
}

}  // namespace longreach
