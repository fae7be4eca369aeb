#pragma once
// Whether the force is believed where the tool presses. One that grows while the setpoint stands still is
// given way to, and its answer decides (force_answer.hpp). One near its bound that grows where it should not
// (growth_watch.hpp) begins a trial (force_sign_test.hpp): the robot rests till it is clear why. A growth across
// the force that a surface stiffer than command.guard_stiffness_n_per_m could make begins none; the guard
// bounds the speed along it all the same (goal_limiter.hpp).

#include "common/link/stiffness_report.hpp"
#include "slave/command/goal_limiter.hpp"
#include "slave/config/guard_config.hpp"
#include "slave/config/sensing_config.hpp"
#include "slave/sensing/force_answer.hpp"
#include "slave/sensing/force_sign_test.hpp"
#include "slave/sensing/growth_watch.hpp"

namespace longreach {

class ForcePlausibility {
 public:
  struct Robot {
    SafetyState state;
    bool let_go = false;  // nobody holds the handle
    bool still = false;   // the setpoint stands, and the tool is there
  };

  ForcePlausibility(const SensingConfig& sensing, const CommandConfig& command)
      : limits_(command), growth_(bounds(sensing, command)), answer_(limits(sensing, command)) {}
  void configure(const SensingConfig& sensing, const CommandConfig& command) {
    limits_ = command;
    growth_.configure(bounds(sensing, command));
    answer_.configure(limits(sensing, command));
  }
  /// An engagement begins.
  void reset() {
    growth_.reset();
    sign_test_.reset();
    answer_.reset();
  }

  /// A tick: what is felt, and the force that the reflexes reckon with.
  void step(GrowthSample felt, const ContactForce& force, const Robot& robot) {
    felt.trend_n_per_s = answer_.trend_n_per_s();
    growth_.step(felt);
    const bool holds = robot.state == SafetyState::kHolding;
    const bool moves = holds || robot.state == SafetyState::kEngaged;
    const double guard_n = holds || robot.let_go ? hold_limit_n(limits_) : limits_.force_guard_n;
    answer_.step({growth_.place_m(), growth_.size_n(), force.reaction, felt.in_contact, robot.still,
                  moves && sign_test_.verdict() == ForceSignTest::Verdict::kNone, kGiveWay * guard_n, guard_n,
                  felt.dt});
    if (answer_.gives_way() || answer_.rests()) return growth_.forget();
    if (!moves) return;
    const double bound_n = holds ? hold_limit_n(limits_) : kNear * limits_.force_guard_n;
    const bool lately = !growth_.direction().isZero(0.0) && growth_.age_s() < (holds ? kHeld_s : kLately_s);
    const bool may_be_stiff = growth_.across() && growth_.slope_n_per_m() > limits_.guard_stiffness_n_per_m;
    if (lately && !may_be_stiff && force.force_n > bound_n) sign_test_.begin(growth_);
    const bool doubted = rests();
    sign_test_.step(growth_, force.reaction, growth_.bounds(), felt.dt, answer_.grows());
    if (doubted && !rests()) growth_.forget();
  }

  [[nodiscard]] bool rests() const {
    return answer_.rests() || sign_test_.verdict() != ForceSignTest::Verdict::kNone;
  }
  [[nodiscard]] bool wrong_sign() const {
    return answer_.state() == ForceAnswer::State::kWrongSign ||
           sign_test_.verdict() == ForceSignTest::Verdict::kSign;
  }
  /// The force has answered to giving way: a wall comes, and this is the way out.
  [[nodiscard]] Reason comes(const Vector3& reaction) const {
    if (!answer_.answered()) return {};
    Eigen::Index axis = 0;
    reaction.cwiseAbs().maxCoeff(&axis);
    const double along = static_cast<double>(axis + 1);
    return {HoldCause::kWallComes, 0, reaction[axis] < 0.0 ? -along : along, 0.0};
  }
  [[nodiscard]] bool force_persists() const {
    return sign_test_.verdict() == ForceSignTest::Verdict::kForcePersists;
  }
  /// What the reflexes must know of it.
  void report(ContactForce& force, const Vector3& lead_m) const {
    force.grows = growth_.direction();
    force.grows_lead_m = force.grows.dot(lead_m);
    force.trusted = !rests();
    force.ease_m_per_s = sign_test_.ease_m_per_s();
    force.gives_way = answer_.gives_way();
    force.gave_way = answer_.gave_way();
    force.retreat_m_per_s = answer_.retreat_m_per_s();
    force.trend_n_per_s = answer_.trend_n_per_s();
  }

 private:
  static constexpr double kGiveWay = 0.8;    // of the guard or hold limit: to what grows at rest
  static constexpr double kNear = 0.9;       // of the guard, or of what a hold comes down to
  static constexpr double kLately_s = 0.05;  // a growth that is still going on
  static constexpr double kHeld_s = 1.0;     // likewise, before the hold in which the robot rests

  static GrowthBounds bounds(const SensingConfig& sensing, const CommandConfig& command) {
    return {command.guard_stiffness_n_per_m, sensing.force_noise_n, sensing.bandwidth_hz};
  }

  static ForceAnswerLimits limits(const SensingConfig& sensing, const CommandConfig& command) {
    return {sensing.force_noise_n, command.guard_stiffness_n_per_m, command.speed_max_m_per_s,
            command.acceleration_max_m_per_s2};
  }

  CommandConfig limits_;
  GrowthWatch growth_;
  ForceAnswer answer_;
  ForceSignTest sign_test_{};
};

}  // namespace longreach
