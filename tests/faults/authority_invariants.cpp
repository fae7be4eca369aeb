// I8, I9, I10, I28: nothing moves without the right to. The right follows from what the slave was given
// (sent_log.hpp): the newest command asks for this engagement, it came within the gap timer, and nothing has
// ended the engagement.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/faults/invariant.hpp"

namespace longreach {
namespace {

constexpr double kStill_m_per_s = 2e-3;
constexpr double kFree_m = 1e-3;     // without contact
constexpr double kRetreat_m = 0.02;  // without the answer that a contact gives
constexpr double kAnswer_n_per_m = 100.0;
constexpr double kFreshAgain_s = 2.0;
constexpr double kSoon_s = 0.01, kLate_s = 0.1, kEased_n = 2.0, kMost_n = 1e3;  // of the force that is told

/// Seconds since there was the right to move; 0 while there is. A slave that was frozen goes after that what
/// was left of its braking way.
class RightClock {
 public:
  explicit RightClock(const Scenario& s) : gap_s_(gap_s(s.slave.safety, sent_hz(s.master.link))) {}
  double since(const Moment& m) {
    const MotionAuthority& authority = m.sent_log->authority();
    const bool thawed = m.slave_ran && m.slave_gap_s > gap_s_ && !stood_;
    if (thawed || (authority.engaged && m.t_s - authority.received_s <= gap_s_)) last_s_ = m.t_s;
    if (m.slave_ran) stood_ = (m.setpoint_rad - setpoint_rad_).isZero(0.0), setpoint_rad_ = m.setpoint_rad;
    return m.t_s - last_s_;
  }

 private:
  double gap_s_;
  double last_s_ = 0.0;
  JointVector setpoint_rad_ = JointVector::Zero();
  bool stood_ = false;  // in the slave's tick before
};

/// Until the robot stands: it brakes, its setpoint lags by its jerk, its joints by their servos.
double stopping_s(const Scenario& s) {
  const CommandConfig& c = s.slave.command;
  const double brake_s = std::max(c.speed_max_m_per_s / c.acceleration_max_m_per_s2,
                                  c.speed_max_rad_per_s / c.acceleration_max_rad_per_s2);
  double joints_s = 0.0;
  for (const JointConfig& j : s.slave.robot.joint)
    joints_s = std::max(joints_s, j.speed_max_rad_per_s / j.acceleration_max_rad_per_s2 +
                                      2.0 * j.acceleration_max_rad_per_s2 / j.jerk_max_rad_per_s3);
  const double servo_hz = s.slave.robot.servo_hz;
  const double servo_s = servo_hz > 0.0 ? 1.0 / (2.0 * std::numbers::pi * servo_hz) : 0.0;
  return brake_s + joints_s + 6.0 * servo_s + 0.1;
}

class Standstill : public Invariant {
 public:
  explicit Standstill(const Scenario& s)
      : Invariant("I8", "no motion without the right to, but for a bounded relief of what presses"),
        authority_(s),
        stopping_s_(stopping_s(s)) {}
  void see(const Moment& m) override {
    const double since_s = authority_.since(m);
    // While both sides stand still the robot, too, is as it was: a fault of it ends when they go on.
    recovered_s_ =
        m.since(AffectedSignal::kRobot) == 0.0 ? 0.0 : recovered_s_ + (m.slave_ran ? m.period_s : 0.0);
    const bool judged = since_s > stopping_s_ && recovered_s_ > kFreshAgain_s &&
                        m.since(AffectedSignal::kScene) > kFreshAgain_s;
    if (!judged) {
      begun_ = false;
      return;
    }
    const double force_n = m.F_E_W.force.norm();
    if (eases(m)) begun_ = false;
    if (!begun_) begin(m);
    const double way_m = (m.X_WE.p - last_m_).norm();
    if (last_n_ - force_n >= kAnswer_n_per_m * way_m) answered_m_ += way_m;
    pressed_ = pressed_ || force_n > 0.0 || m.since(AffectedSignal::kSensor) < kFreshAgain_s;
    last_m_ = m.X_WE.p;
    last_n_ = force_n;
    at_most(m, (m.X_WE.p - at_.p).norm(), kFree_m + (pressed_ ? kRetreat_m + answered_m_ : 0.0),
            "m off where it stood, without the right to move");
    if (!pressed_) at_most(m, m.X_WE.q.angularDistance(at_.q), 2e-3, "rad off where it stood");
  }

 private:
  /// A lie that eases has answered; noise has not.
  bool eases(const Moment& m) {
    const double reported_n = std::min(kMost_n, m.reported.F_F_W.force.norm());
    soon_n_ += m.period_s / kSoon_s * (reported_n - soon_n_);
    late_n_ += m.period_s / kLate_s * (reported_n - late_n_);
    return late_n_ - soon_n_ > kEased_n;
  }
  void begin(const Moment& m) {
    begun_ = true;
    pressed_ = false;
    at_ = m.X_WE;
    last_m_ = m.X_WE.p;
    last_n_ = m.F_E_W.force.norm();
    answered_m_ = 0.0;
  }
  RightClock authority_;
  double stopping_s_;
  bool begun_ = false, pressed_ = false;
  double recovered_s_ = 1e9;
  Pose at_{};
  Vector3 last_m_ = Vector3::Zero();
  double last_n_ = 0.0, answered_m_ = 0.0;
  double soon_n_ = 0.0, late_n_ = 0.0;
};

class StopsInTime : public Invariant {
 public:
  explicit StopsInTime(const Scenario& s)
      : Invariant("I9", "what stops stands within the documented time"),
        authority_(s),
        stopping_s_(stopping_s(s)) {}
  void see(const Moment& m) override {
    const double since_s = authority_.since(m);
    const bool free = m.F_E_W.force.isZero() && m.since(AffectedSignal::kScene) > kFreshAgain_s &&
                      m.since(AffectedSignal::kSensor) > kFreshAgain_s &&
                      m.since(AffectedSignal::kRobot) > kFreshAgain_s;
    touched_s_ = free ? touched_s_ : m.t_s;
    if (since_s > stopping_s_ && since_s < stopping_s_ + 1.0 && m.t_s - touched_s_ > 1.0 + stopping_s_)
      at_most(m, m.v_WE.norm(), kStill_m_per_s, "m/s after the time to stop");
  }

 private:
  RightClock authority_;
  double stopping_s_;
  double touched_s_ = -1e9;
};

/// A slave that does not run any more: the robot's own watchdog.
class OwnWatchdog : public Invariant {
 public:
  explicit OwnWatchdog(const Scenario& s)
      : Invariant("I28", "a robot whose slave is dead stops by its own watchdog"),
        servo_hz_(s.slave.robot.servo_hz) {}
  void see(const Moment& m) override {
    if (m.slave_ran) ran_s_ = m.t_s;
    const double servo_s = servo_hz_ > 0.0 ? 1.0 / (2.0 * std::numbers::pi * servo_hz_) : 0.0;
    if (m.t_s - ran_s_ > 0.2 + 6.0 * servo_s && m.since(AffectedSignal::kScene) > kFreshAgain_s &&
        m.F_E_W.force.isZero())
      at_most(m, m.v_WE.norm(), kStill_m_per_s, "m/s of a robot without a slave");
  }

 private:
  double servo_hz_;
  double ran_s_ = 0.0;
};

}  // namespace

void add_authority_invariants(const Scenario& s, Invariants& all) {
  all.push_back(std::make_unique<Standstill>(s));
  all.push_back(std::make_unique<StopsInTime>(s));
  all.push_back(std::make_unique<OwnWatchdog>(s));
}

}  // namespace longreach
