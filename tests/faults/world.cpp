#include "tests/faults/world.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <variant>

#include "common/config/ceiling.hpp"
#include "common/config/config.hpp"
#include "tests/faults/looseness.hpp"

namespace longreach {
namespace {

constexpr std::uint64_t kPastSession = 77;
constexpr int kPastDatagrams = 64;
constexpr std::size_t kReports = 8192;  // whose time is kept

Session draw(Random& random, std::uint64_t number) {
  Session session{.number = number};
  for (auto& b : session.secret) b = static_cast<std::byte>(random.next());
  return session;
}

/// The slave of a real robot has no scene.
SlaveConfig known_to_slave(const Scenario& scenario) {
  SlaveConfig known = scenario.slave;
  if (scenario.empty_scene) known.scene = {};
  return known;
}

/// What a master sent to this slave in a session that is over.
std::vector<Bytes> past_life(Random random) {
  MemoryChannelPair wire;
  MasterPort port(wire.a(), {}, random);
  port.follow(draw(random, kPastSession));
  std::vector<Bytes> all;
  for (int i = 1; i <= kPastDatagrams; ++i) {
    MotionCommand command;
    command.engagement = 1;
    command.request = Request::kEngage;
    command.position_m = {0.02 * i, 0.0, 0.0};
    port.send(Time{std::chrono::milliseconds(1000 + 3 * i)}, static_cast<std::uint64_t>(i), command);
  }
  std::array<std::byte, kDatagramMaxBytes> buffer{};
  while (const auto size = wire.b().receive(buffer))
    all.emplace_back(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(*size));
  return all;
}

}  // namespace

World::World(const Scenario& scenario, const Schedule& schedule, InjectedDefect injected_defect,
             const Clocks& clocks)
    : scenario_(scenario),
      schedule_(schedule),
      lab_(scenario.master, known_to_slave(scenario), schedule.seed),
      up_(Random(schedule.seed).child("wire up")),
      down_(Random(schedule.seed).child("wire down")),
      defect_injector_(injected_defect),
      person_(Random(schedule.seed).child("person"), scenario.master, scenario.round_trip_s),
      sent_log_(gap_s(scenario.slave.safety, sent_hz(scenario.master.link)), scenario.slave.safety.resume_s),
      slave_config_(scenario.config.slave()),
      master_config_(scenario.config.master()),
      sessions_(Random(schedule.seed).child("sessions")),
      injected_(fault_kinds().size(), 0),
      past_life_(longreach::past_life(Random(schedule.seed).child("past life"))),
      slave_ahead_(clocks.slave_ahead),
      master_ahead_(clocks.master_ahead),
      up_now_(scenario.slave.link.impairment),
      down_now_(scenario.master.link.impairment) {
  if (scenario.empty_scene) lab_.arm().surround(scenario.slave.scene);
  moment_.sent_log = &sent_log_;
  moment_.period_s = lab_.period_s();
  moment_.affected_s.fill(1e9);
  lab_.set_fault_hooks(*this);
}

const Moment& World::step() {
  const double now_s = lab_.now_s() + lab_.period_s();
  moment_.t_s = now_s;
  moment_.faults_over = now_s >= schedule_.faults_end_s;
  moment_.slave_ran = moment_.master_ran = moment_.moves = moment_.stop_at_slave = false;
  moment_.engage_asked = moment_.hold_asked = moment_.stop_asked = false;
  moment_.number_again = moment_.configured = moment_.report_came = false;
  moment_.datagrams = moment_.given = 0;
  moment_.given_numbers.clear();
  moment_.taken = moment_.renewed = false;
  moment_.report.reset();
  moment_.telemetry.reset();
  moment_.seen.reset();
  levels = {};
  levels.up = scenario_.slave.link.impairment;
  levels.down = scenario_.master.link.impairment;
  requests = {};
  stop_slave = false;
  begin_faults(now_s);
  act();
  apply_levels();
  live_before();
  if (stop_slave) lab_.stop_slave();
  stop_waits_ = stop_waits_ || stop_slave;
  lab_.step();
  finish();
  end_faults();
  return moment_;
}

void World::begin_faults(double now_s) {
  for (; next_fault_ < schedule_.faults.size() && schedule_.faults[next_fault_].start_s <= now_s;
       ++next_fault_) {
    const Fault& fault = schedule_.faults[next_fault_];
    const std::size_t kind = fault_kind(fault.kind);
    ++injected_[kind];
    running_.push_back({&fault_kinds()[kind], {.fault = fault, .random = Random(fault.seed)}});
  }
}

void World::act() {
  for (double& s : moment_.affected_s) s += lab_.period_s();
  for (Running& running : running_) {
    if (running.kind->act != nullptr) running.kind->act(*this, running.active);
    for (unsigned left = running.kind->affects; left != 0; left &= left - 1) mark_affected(left);
  }
  if (up_.keeps_back(moment_.t_s) || down_.keeps_back(moment_.t_s))
    mark_affected(only(AffectedSignal::kLink));
}

void World::mark_affected(unsigned first) {
  moment_.affected_s[static_cast<std::size_t>(std::countr_zero(first))] = 0.0;
}

void World::apply_levels() {
  if (levels.up != up_now_) lab_.impair_slave(up_now_ = levels.up);
  if (levels.down != down_now_) lab_.impair_master(down_now_ = levels.down);
  up_.direction_faults = levels.wire_up;
  down_.direction_faults = levels.wire_down;
  slave_ahead_ += from_seconds(1e-6 * levels.slave_ppm * lab_.period_s());
  master_ahead_ += from_seconds(1e-6 * levels.master_ppm * lab_.period_s());
}

// The hand, the operator, and what lies in the slave's socket.
void World::live_before() {
  if (moment_.faults_over) person_.rest();
  person_.be_impatient(levels.impatient);
  OperatorRequests asked = requests;
  lab_.drive(person_.step(moment_.t_s, lab_.master(), asked));
  lab_.let_go(levels.let_go);
  asked.clutch = asked.clutch || levels.clutch;
  OperatorRequests& waiting = lab_.requests();
  asked.engage = asked.engage || waiting.engage;
  asked.stop = asked.stop || waiting.stop;
  asked.hold = asked.hold || waiting.hold;
  waiting = asked;
  if (moment_.faults_over) {
    up_.release();
    down_.release();
  }
  up_.pass(moment_.t_s);
  if (channels_ != nullptr && !levels.slave_skips_tick)
    up_.empty([this](const Bytes& datagram) { channels_->a().send(datagram); });
}

void World::on_wire(MemoryChannelPair& wire) {
  channels_ = &wire;
  if (slave_turn_) {
    take_all(wire.a(), down_);
    down_.pass(moment_.t_s);
    if (!levels.master_skips_tick) down_.empty([&wire](const Bytes& datagram) { wire.b().send(datagram); });
  } else {
    take_all(wire.b(), up_);
  }
  slave_turn_ = !slave_turn_;
}

void World::take_all(Channel& end, WireDirection& direction) {
  std::array<std::byte, kDatagramMaxBytes> buffer{};
  while (const auto size = end.receive(buffer)) {
    Bytes datagram(buffer.begin(),
                   buffer.begin() + static_cast<std::ptrdiff_t>(std::min(*size, buffer.size())));
    const Header header = std::get<Header>(read_header(datagram));
    std::uint64_t& last = numbers_[{header.session, datagram[1]}];
    moment_.number_again = moment_.number_again || header.sequence <= last;
    last = std::max(last, header.sequence);
    ++moment_.datagrams;
    direction.take(moment_.t_s, std::move(datagram));
  }
}

template <class Hook, class Value>
void World::hook(Hook FaultKind::*which, Value& value) {
  for (Running& running : running_) {
    if (running.kind->*which != nullptr) (running.kind->*which)(*this, running.active, value);
  }
}

void World::robot_reported(Time /*now*/, RobotState& reported) {
  moment_.truth = reported;
  hook(&FaultKind::robot, reported);
  defect_injector_.apply(reported);
  moment_.reported = reported;
}

void World::before_slave_step(SlaveInput& input) {
  hook(&FaultKind::slave, input);
  moment_.slave_ran = true;
  moment_.slave_gap_s = moment_.t_s - slave_ran_s_;
  moment_.stop_at_slave = std::exchange(stop_waits_, false);
  moment_.given = input.commands.size();
  for (const auto& command : input.commands) moment_.given_numbers.push_back(command.sequence);
  if (moment_.stop_at_slave) sent_log_.ended(moment_.t_s);
  defect_injector_.before_sent_log(input);
  moment_.given_badly = !sent_log_.slave_given(moment_.t_s, moment_.slave_gap_s, input.commands);
  defect_injector_.ask(input);
}

void World::after_slave_step(SlaveOutput& out) {
  defect_injector_.answer(out);
  moment_.moves = out.joint_setpoint_rad.has_value();
  moment_.setpoint_rad = out.joint_setpoint_rad.value_or(moment_.setpoint_rad);
  const bool injected =
      std::ranges::any_of(running_, [](const Running& r) { return r.kind->setpoint != nullptr; });
  if (injected) {
    // A robot that goes its own way does so without a setpoint, too.
    JointVector setpoint_rad = out.joint_setpoint_rad.value_or(moment_.truth.joint_rad);
    hook(&FaultKind::setpoint, setpoint_rad);
    out.joint_setpoint_rad = setpoint_rad;
  }
  hook(&FaultKind::report, out);
  if (out.report) {
    moment_.report = out.report;
    moment_.claimed = out.report->state;
    reports_s_[out.report_sequence] = moment_.t_s;
    if (reports_s_.size() > kReports) reports_s_.erase(reports_s_.begin());
    if (moment_.claimed == SafetyState::kEngaged) sent_log_.entered(out.report->engagement);
    moment_.cause = out.report->cause;
    moment_.engagement = out.report->engagement;
  }
  moment_.telemetry = out.telemetry;
}

void World::handle_reported(HandleState& reported) {
  hook(&FaultKind::handle, reported);
  moment_.handle = reported;
}

void World::before_master_step(MasterInput& input) {
  moment_.master_ran = true;
  moment_.master_gap_s = moment_.t_s - master_ran_s_;
  moment_.engage_asked = input.requests.engage;
  moment_.hold_asked = input.requests.hold;
  moment_.stop_asked = input.requests.stop;
  if (input.requests.engage) sent_log_.asked();
  for (const auto& received : input.reports) {
    const auto left = reports_s_.find(received.sequence);
    if (!received.newest || left == reports_s_.end()) continue;
    moment_.report_came = true;
    moment_.report_age_s = moment_.t_s - left->second;
  }
  if (!input.telemetry.empty()) moment_.seen = input.telemetry.back().message;
}

void World::after_master_step(MasterOutput& out) {
  defect_injector_.answer(out);
  moment_.F_H_M = out.F_H_M;
  hook(&FaultKind::command, out);
  if (out.command) sent_log_.master_sent(moment_.t_s, out.sequence, *out.command);
}

void World::finish() {
  const SimulatedRobot& arm = lab_.arm();
  moment_.X_WE = arm.true_pose();
  moment_.v_WE = arm.true_velocity();
  moment_.F_E_W = arm.true_wrench();
  moment_.x_MH = lab_.devices().delta().position_m();
  moment_.q_MH = lab_.devices().spherical().orientation();
  const MasterView& master = lab_.master();
  moment_.shown = master.state;
  const bool refused = master.refusal != HoldCause::kNone;
  moment_.reason = refused ? master.refusal : master.cause;
  moment_.reason_is_far = refused ? master.refusal_is_far : master.cause_is_far;
  moment_.engaged_in = lab_.master().engagement;
  moment_.rendered_n_per_m = lab_.master().stiffness_n_per_m;
  moment_.rendered_along = lab_.master().inward;
  moment_.rendered_from_m = lab_.master().surface_m;
  moment_.contact_n = lab_.master().spring_force_n.norm();
  moment_.felt = moment_.contact_n > 0.0;
  moment_.goal_m = lab_.master().goal_m;
  moment_.anchor_m = lab_.slave().X_WE_anchor.p;
  moment_.received = lab_.arrived() + up_.oversized() + down_.oversized();
  moment_.accounted = 0;
  for (const Port* port :
       {static_cast<const Port*>(&lab_.slave_port()), static_cast<const Port*>(&lab_.master_port())})
    moment_.accounted += port->accepted_total() + port->rejected_total();
  if (moment_.slave_ran) slave_ran_s_ = moment_.t_s;
  if (moment_.master_ran) master_ran_s_ = moment_.t_s;
}

void World::end_faults() {
  for (Running& running : running_) {
    running.active.age_s += lab_.period_s();
    running.active.begins = false;
    if (running.active.age_s >= running.active.fault.duration_s && running.kind->end != nullptr)
      running.kind->end(*this, running.active);
  }
  std::erase_if(running_, [](const Running& r) { return r.active.age_s >= r.active.fault.duration_s; });
}

void World::lease(bool to_master) {
  const Session session = draw(sessions_, ++leases_);
  lab_.hand_slave(session, !to_master);
  (to_master ? moment_.renewed : moment_.taken) = true;
  reports_s_.clear();
  if (to_master) lab_.hand_master(session);
  sent_log_.lease(moment_.t_s, session.number, to_master);
}

// As the services of the programs do (common/rpc/config_change.hpp).
bool World::change(google::protobuf::Message& present, const google::protobuf::Message& start,
                   std::string_view path, const std::string& value, bool engaged) {
  const std::unique_ptr<google::protobuf::Message> after(present.New());
  after->CopyFrom(present);
  try {
    set_field(*after, path, value);
    validate(*after);
  } catch (const ConfigError&) {
    return false;
  }
  const bool beyond = beyond_ceiling(start, *after) && !defect_injector_.frees_limits();
  if (beyond || !longreach::refused_changes(present, *after, engaged).empty()) {
    ++refused_changes_;
    return false;
  }
  present.CopyFrom(*after);
  moment_.configured = true;
  return true;
}

void World::set_slave(std::string_view path, const std::string& value) {
  if (!change(slave_config_, scenario_.config.slave(), path, value,
              lab_.slave().state == SafetyState::kEngaged))
    return;
  lab_.configure_slave(to_struct(slave_config_));
  moment_.loosened = looser(scenario_.config.slave(), slave_config_);
}

void World::set_master(std::string_view path, const std::string& value) {
  if (!change(master_config_, scenario_.config.master(), path, value,
              lab_.master().state == SafetyState::kEngaged))
    return;
  lab_.configure_master(to_struct(master_config_));
  moment_.loosened = looser(scenario_.config.master(), master_config_);
}

}  // namespace longreach
