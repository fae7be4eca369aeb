#include "deploy/lab/laboratory.hpp"

#include <stdexcept>
#include <utility>

#include "deploy/lab/comparison/comparison_law.hpp"
#include "deploy/lab/comparison/naive_law.hpp"
#include "deploy/lab/mjcf_robots.hpp"
#include "deploy/lab/recording/lab_recording.hpp"
#include "slave/simulation/simulated_arm.hpp"

namespace longreach {

namespace {

constexpr Duration kLate = std::chrono::milliseconds(100);
/// Fewer than in the programs: each time the samples of the last seconds are sorted.
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
      master_(master, channels_.a(), random_.child("down"), SideObserver(kFigures)),
      slave_(slave, channels_.b(), random_.child("up"), SideObserver(kFigures)),
      arm_(make_robot(slave, random_.child("arm"))),
      devices_(master.device),
      script_(master.operator_, master.mapping, master.hand.grip) {
  if (is_comparison(master.rendering.law)) {
    throw std::invalid_argument(
        "this experiment accepts only rendering.law = STIFFNESS or NAIVE; the comparison laws run in "
        "the experiments press-wall and delay-sweep");
  }
  master_.node().render_by(contact_law(master.rendering.law));
  const Session session = session_of(random_.child("session"));
  master_.follow(session);
  slave_.follow(session, send_hz_);
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
  if (elapsed_ == Duration{} && of_all != nullptr)
    of_all->begins(master_config_, slave_config_, driven_.has_value());
  elapsed_ += period_;
  step_slave();
  fault_hooks_->on_wire(channels_);
  step_master();
  fault_hooks_->on_wire(channels_);
}

/// Adds what a loop counts of the ticks that it skipped before this one.
void Laboratory::count_skipped(LoopFigures& loop, std::uint64_t& skipped) const {
  if (static_cast<std::int64_t>(skipped) * period_ > kLate) ++loop.ticks_late_100ms;
  ++loop.ticks;
  skipped = 0;
}

void Laboratory::step_slave() {
  const Time now = slave_now();
  if (!slave_lives_ || elapsed_ <= slave_thaws_ || fault_hooks_->slave_skips_tick()) {
    ++slave_skipped_, ++slave_loop_.overdue_ticks;
    arm_->read(now);
    return;
  }
  count_skipped(slave_loop_, slave_skipped_);
  slave_.tick(now, *arm_, slave_loop_, std::exchange(stop_slave_, false), fault_hooks_);
  const SlaveOutput& out = slave_.output();
  if (recording_) recording_->add_slave_tick(slave_);
  if (!out.report) return;
  report_places_.push(slave().reported_at_m);
  last_report_ = out.report_sequence;
  ++haptic_return_.datagrams;
  haptic_return_.bytes += slave_.report_bytes() - kOverheadBytes;
}

HandTarget Laboratory::operate(const HandleState& handle, OperatorRequests& requests) {
  const MasterView& view = master();
  const ScriptOutput script = script_.step({.now = master_now(),
                                            .handle_m = handle.p_MH,
                                            .felt_n = view.spring_force_n.norm(),
                                            .goal_m = view.goal_m,
                                            .scale = view.scale,
                                            .engaged = view.state == SafetyState::kEngaged,
                                            .engagement = view.engagement,
                                            .surface_known = view.surface_known,
                                            .depth_m = view.inward.dot(handle.p_MH) - view.surface_m,
                                            .bring_home = view.bring_home});
  requests = std::exchange(requests_, {});
  if (script.mode && !driven_) requests.mode = script.mode;
  HandTarget target = driven_.value_or(script.target);
  if (let_go_) target.grip = Grip::kReleased;
  return target;
}

void Laboratory::step_master() {
  if (!master_lives_) return;
  const Time now = master_now();
  if (elapsed_ <= master_thaws_ || fault_hooks_->master_skips_tick()) {
    ++master_skipped_, ++master_loop_.overdue_ticks;
    if (driven_) devices_.set_target(*driven_);
    devices_.read(now);
    return;
  }
  count_skipped(master_loop_, master_skipped_);
  OperatorSays operator_says;
  devices_.set_target(operate(master_.read(now, devices_, fault_hooks_), operator_says.requests));
  master_.step(devices_, master_loop_, operator_says, fault_hooks_);
  if (recording_) recording_->add_master_tick(master_);
  for (const auto& received : master_.input().reports) {
    const std::uint64_t back = last_report_ - received.sequence;
    if (!received.newest || !received.message.translation.in_contact() || back >= report_places_.size())
      continue;
    rendered_at_m_ = report_places_[report_places_.size() - 1 - back];
  }
}

}  // namespace longreach
