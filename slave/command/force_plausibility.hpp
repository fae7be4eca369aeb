#pragma once
// Checks whether the measured force is plausible while the tool is in contact. If the force grows while the
// setpoint is at rest, the robot retreats, and the response of the force is evaluated (force_answer.hpp). If
// the force is close to its limit and grows unexpectedly (growth_watch.hpp), a test starts, during which the
// robot stays at rest (force_sign_test.hpp). Growth during motion perpendicular to the force starts no test
// if a surface stiffer than command.guard_stiffness_n_per_m could cause it; the guard still limits the speed
// in that direction (contact_guard.hpp).

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
    bool let_go = false;  // the operator has released the handle
    bool still = false;   // the setpoint is at rest, and the tool has reached it
  };

  ForcePlausibility(const SensingConfig& sensing, const CommandConfig& command)
      : limits_(command), growth_(bounds(sensing, command)), answer_(limits(sensing, command)) {}
  void configure(const SensingConfig& sensing, const CommandConfig& command) {
    limits_ = command;
    growth_.configure(bounds(sensing, command));
    answer_.configure(limits(sensing, command));
  }
  /// Discards all observations at the start of an engagement.
  void reset() {
    growth_.reset();
    sign_test_.reset();
    answer_.reset();
  }

  /// Processes one tick; `felt` is the measured force, and `force` is the force that the guard uses.
  void step(GrowthSample felt, const ContactForce& force, const Robot& robot) {
    felt.trend_n_per_s = answer_.trend_n_per_s();
    growth_.step(felt);
    const bool holds = robot.state == SafetyState::kHolding;
    const bool moves = holds || robot.state == SafetyState::kEngaged;
    const double guard_n = holds || robot.let_go ? hold_limit_n(limits_) : limits_.force_guard_n;
    const bool known = force.stiffness_n_per_m > 0.0 || holds || robot.let_go;
    answer_.step({growth_.place_m(), growth_.size_n(), force.reaction, felt.in_contact, robot.still,
                  moves && sign_test_.verdict() == ForceSignTest::Verdict::kNone, kGiveWay * guard_n, guard_n,
                  felt.dt, known});
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

  /// True if the robot must stay at rest because the force is being tested or was found to be wrong.
  [[nodiscard]] bool rests() const {
    return answer_.rests() || sign_test_.verdict() != ForceSignTest::Verdict::kNone;
  }
  /// True if the force grows during a motion that should reduce it, because the sign or the frame of the
  /// sensor is wrong.
  [[nodiscard]] bool wrong_sign() const {
    return answer_.state() == ForceAnswer::State::kWrongSign ||
           sign_test_.verdict() == ForceSignTest::Verdict::kSign;
  }
  /// Returns the reason for an approaching surface, with the axis of the retreat, if the force has responded
  /// to a retreat. Otherwise returns no reason.
  [[nodiscard]] Reason comes(const Vector3& reaction) const {
    if (!answer_.answered()) return {};
    Eigen::Index axis = 0;
    reaction.cwiseAbs().maxCoeff(&axis);
    const double along = static_cast<double>(axis + 1);
    return {HoldCause::kSurfaceApproaching, 0, reaction[axis] < 0.0 ? -along : along, 0.0};
  }
  /// Returns the stiffness of an approaching surface, N/m; 0: none approaches, or it is unknown.
  [[nodiscard]] double coming_n_per_m() const { return answer_.coming_n_per_m(); }
  /// True if the test showed that the force grows independently of the motion of the robot.
  [[nodiscard]] bool force_persists() const {
    return sign_test_.verdict() == ForceSignTest::Verdict::kForcePersists;
  }
  /// Adds the results to `force`, the input of the guard; `lead_m` is the lead of the setpoint over the tool.
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
  /// Fraction of the guard limit, or of the hold limit, at which the tool starts to retreat from a force that
  /// grows while the robot is at rest.
  static constexpr double kGiveWay = 0.8;
  /// Fraction of the guard limit above which unexpected growth starts a test while the robot is engaged.
  static constexpr double kNear = 0.9;
  /// Maximum age of a force growth that still counts as ongoing.
  static constexpr double kLately_s = 0.05;
  /// The same limit in a hold, where the robot is at rest and no new growth can be observed.
  static constexpr double kHeld_s = 1.0;

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
