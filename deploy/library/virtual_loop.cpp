#include "deploy/library/include/longreach/virtual_loop.hpp"

#include <cmath>
#include <stdexcept>

#include "common/config/config.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/laboratory.hpp"
#include "deploy/library/files.hpp"

namespace longreach {
namespace {

proto::LabConfig config_of(const std::vector<std::string>& settings, const std::string& files) {
  return configure(settings, files.empty() ? library_files() : std::filesystem::path(files));
}

LoopPhase phase_of(SafetyState state) {
  switch (state) {
    case SafetyState::kIdle:
      return LoopPhase::kIdle;
    case SafetyState::kObserving:
      return LoopPhase::kObserving;
    case SafetyState::kEngaged:
      return LoopPhase::kEngaged;
    case SafetyState::kHolding:
      return LoopPhase::kHolding;
    case SafetyState::kStopped:
      return LoopPhase::kStopped;
    case SafetyState::kFault:
      break;
  }
  return LoopPhase::kFault;
}

}  // namespace

struct VirtualLoop::State {
  State(const proto::LabConfig& config, std::uint64_t seed)
      : laboratory(to_struct(config.master()), to_struct(config.slave()), seed) {}
  Laboratory laboratory;
};

VirtualLoop::VirtualLoop(const std::vector<std::string>& settings, std::uint64_t seed,
                         const std::string& files)
    : state_(with_input_errors([&] {
        try {
          return std::make_unique<State>(config_of(settings, files), seed);
        } catch (const std::invalid_argument& error) {  // a law for comparison
          throw InputError(error.what());
        }
      })) {}
VirtualLoop::~VirtualLoop() = default;
VirtualLoop::VirtualLoop(VirtualLoop&&) noexcept = default;
VirtualLoop& VirtualLoop::operator=(VirtualLoop&&) noexcept = default;

void VirtualLoop::step() { state_->laboratory.step(); }

void VirtualLoop::run(double seconds) {
  require_range("seconds", seconds, 0.0, 1e9);
  const double until_s = state_->laboratory.now_s() + seconds - 0.5 * period_s();
  while (state_->laboratory.now_s() < until_s) step();
}

double VirtualLoop::period_s() const { return state_->laboratory.period_s(); }

LoopState VirtualLoop::state() const {
  const Laboratory& lab = state_->laboratory;
  const MasterView& m = lab.master();
  const SlaveView& s = lab.slave();
  LoopState now;
  now.time_s = lab.now_s();
  now.engaged = m.state == SafetyState::kEngaged;
  now.phase = phase_of(m.state);
  now.handle_m = m.p_MH;
  now.handle_force_n = m.F_H_M.force;
  now.handle_moment_nm = m.F_H_M.moment;
  now.goal_m = m.goal_m;
  now.X_WE.linear() = s.X_WE.q.toRotationMatrix();
  now.X_WE.translation() = s.X_WE.p;
  now.tool_force_n = s.F_E_W.force;
  now.in_contact = s.in_contact;
  now.estimated_stiffness_n_per_m = s.estimate.stiffness_n_per_m;
  now.estimated_stiffness_sd_n_per_m = s.estimate.stiffness_sd_n_per_m;
  now.reported_stiffness_n_per_m = s.reported_stiffness_n_per_m;
  now.rendered_stiffness_n_per_m = m.stiffness_n_per_m;
  now.true_stiffness_n_per_m = lab.arm().material_stiffness(lab.rendered_at_m());
  now.port_energy_j = m.port_energy_j;
  now.round_trip_s = m.rtt_s;
  return now;
}

void VirtualLoop::drive(const LoopHand& hand) {
  if (!hand.position_m.allFinite() || !hand.velocity_m_per_s.allFinite() || !hand.rotation_rad.allFinite())
    throw InputError("the target of the hand is not finite");
  state_->laboratory.drive({.position_m = hand.position_m,
                            .velocity_m_per_s = hand.velocity_m_per_s,
                            .rotation_rad = hand.rotation_rad,
                            .grip = hand.held ? Grip::kLight : Grip::kReleased});
}

void VirtualLoop::engage() { state_->laboratory.requests().engage = true; }
void VirtualLoop::stop() { state_->laboratory.requests().stop = true; }

}  // namespace longreach
