#pragma once
// Whether the force is believed where the tool presses. One near its bound that grows where it should not
// (growth_watch.hpp) begins a trial (sign_trial.hpp): the robot rests till it is clear why. A growth across
// the force that a surface stiffer than command.guard_stiffness_n_per_m could make begins none; the guard
// bounds the speed along it all the same (goal_limiter.hpp).

#include "common/link/stiffness_report.hpp"
#include "slave/command/goal_limiter.hpp"
#include "slave/command/guard_config.hpp"
#include "slave/sensing/growth_watch.hpp"
#include "slave/sensing/sensing_config.hpp"
#include "slave/sensing/sign_trial.hpp"

namespace longreach {

class ForceDoubt {
 public:
  ForceDoubt(const SensingConfig& sensing, const CommandConfig& command)
      : limits_(command), growth_(bounds(sensing, command)) {}
  void configure(const SensingConfig& sensing, const CommandConfig& command) {
    limits_ = command;
    growth_.configure(bounds(sensing, command));
  }
  /// An engagement begins.
  void reset() {
    growth_.reset();
    trial_.reset();
  }

  /// A tick: what is felt, and the force that the reflexes reckon with.
  void step(const GrowthSample& felt, const ContactForce& force, SafetyState state) {
    growth_.step(felt);
    const bool holds = state == SafetyState::kHolding;
    if (!holds && state != SafetyState::kEngaged) return;
    const double bound_n = holds ? hold_limit_n(limits_) : kNear * limits_.force_guard_n;
    const bool lately = !growth_.direction().isZero(0.0) && growth_.age_s() < (holds ? kHeld_s : kLately_s);
    const bool may_be_stiff = growth_.across() && growth_.slope_n_per_m() > limits_.guard_stiffness_n_per_m;
    if (lately && !may_be_stiff && force.force_n > bound_n) trial_.begin(growth_);
    const bool doubted = rests();
    trial_.step(growth_, force.reaction, growth_.bounds(), felt.dt);
    if (doubted && !rests()) growth_.reset();
  }

  [[nodiscard]] bool rests() const { return trial_.verdict() != SignTrial::Verdict::kNone; }
  [[nodiscard]] bool wrong_sign() const { return trial_.verdict() == SignTrial::Verdict::kSign; }
  [[nodiscard]] bool no_relief() const { return trial_.verdict() == SignTrial::Verdict::kNoRelief; }
  /// What the reflexes must know of it.
  void tell(ContactForce& force, const Vector3& lead_m) const {
    force.grows = growth_.direction();
    force.grows_lead_m = force.grows.dot(lead_m);
    force.trusted = !rests();
    force.ease_m_per_s = trial_.ease_m_per_s();
  }

 private:
  static constexpr double kNear = 0.9;       // of the guard, or of what a hold comes down to
  static constexpr double kLately_s = 0.05;  // a growth that is still going on
  static constexpr double kHeld_s = 1.0;     // likewise, before the hold in which the robot rests

  static GrowthBounds bounds(const SensingConfig& sensing, const CommandConfig& command) {
    return {command.guard_stiffness_n_per_m, sensing.force_noise_n, sensing.bandwidth_hz};
  }

  CommandConfig limits_;
  GrowthWatch growth_;
  SignTrial trial_{};
};

}  // namespace longreach
