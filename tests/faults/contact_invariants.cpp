// I21: force and moment at the plant, and what becomes of it, and of the tool, when the robot stops.

#include <algorithm>
#include <cmath>

#include "slave/config/guard_config.hpp"
#include "tests/faults/invariant.hpp"

namespace longreach {
namespace {

constexpr double kQuiet_s = 3.0;  // after what the guard cannot reckon with

bool as_reckoned(const Moment& m) {
  for (const AffectedSignal what : {AffectedSignal::kSensor, AffectedSignal::kJoints, AffectedSignal::kRobot,
                                    AffectedSignal::kScene, AffectedSignal::kSlaveTime})
    if (m.since(what) < kQuiet_s) return false;
  return true;
}

/// dF/dp of the stiffest material at this force.
double stiffest_n_per_m(const SceneConfig& scene, double force_n) {
  double most = 0.0;
  for (const MaterialConfig& m : scene.material) {
    const double k = m.stiffness_n_per_m / std::pow(m.reference_depth_m, m.exponent - 1.0);
    most = std::max(most, m.exponent * force_n / std::pow(force_n / k, 1.0 / m.exponent));
  }
  return most;
}

/// Within the envelope that is published: a touch at FirstTouch's speed on its stiffness (guard_config.hpp).
class Guarded : public Invariant {
 public:
  explicit Guarded(const Scenario& s)
      : Invariant("I21", "within its envelope the force is at most 1.35 times the guard"),
        bound_n_(kGuardOvershoot * s.slave.command.force_guard_n),
        stiff_(stiffest_n_per_m(s.slave.scene, bound_n_) > FirstTouch{}.stiffness_n_per_m) {}
  void see(const Moment& m) override {
    const double force_n = m.F_E_W.force.norm();
    const bool engaged = m.claimed == SafetyState::kEngaged;
    const bool touched = force_n > 0.0 && last_n_ == 0.0;
    if (touched)
      beyond_ = stiff_ || -m.v_WE.dot(m.F_E_W.force) > kSwift * FirstTouch{}.speed_m_per_s * force_n;
    last_n_ = force_n;
    settled_s_ = touched || force_n > bound_n_ ? 0.0 : settled_s_ + m.period_s;
    beyond_ = beyond_ && (force_n > 0.0 && settled_s_ < kRetreat_s);
    if (!as_reckoned(m) || beyond_) {
      pressed_n_ = force_n;
      engaged_s_ = 0.0;
      return;
    }
    if (force_n <= bound_n_) pressed_n_ = 0.0;
    if (engaged) engaged_s_ += m.period_s;
    if (force_n < kFall * pressed_n_) {
      pressed_n_ = force_n;
      engaged_s_ = std::min(engaged_s_, kRetreat_s - kNext_s);
    }
    const double most_n = pressed_n_ > 0.0 && engaged_s_ < kRetreat_s ? kRise * pressed_n_ : bound_n_;
    if (force_n > 0.0) at_most(m, force_n, most_n, "N at the tool");
  }

 private:
  static constexpr double kRetreat_s = 3.0, kRise = 1.05, kSwift = 1.05;
  static constexpr double kFall = 0.9, kNext_s = 1.0;  // an arm that is stretched goes back slowly

  double bound_n_;
  bool stiff_;
  bool beyond_ = false;
  double last_n_ = 0.0, settled_s_ = 0.0;
  // The robot was pressed in: it may stay so till it is engaged, is then relieved, and never goes in deeper.
  double pressed_n_ = 0.0, engaged_s_ = 0.0;
};

/// A second and a half after the last right to move what presses or turns has come down to the hold limit. A
/// hold in which the sensor has lied may have spent its way of relief on that.
class ForceComesDown : public Invariant {
 public:
  struct Of {
    const char* name;
    const char* says;
    const char* unit;
    Vector3 Wrench::*part;
    double most;  // with what a servo and noise leave
  };
  explicit ForceComesDown(const Of& of) : Invariant(of.name, of.says), of_(of) {}
  void see(const Moment& m) override {
    if (m.sent_log->authority().engaged || m.claimed != SafetyState::kHolding) {
      held_s_ = m.t_s;
      was_faulty_ = false;
    }
    was_faulty_ = was_faulty_ || !as_reckoned(m);
    if (m.t_s - held_s_ > 1.5 && !was_faulty_) at_most(m, (m.F_E_W.*of_.part).norm(), of_.most, of_.unit);
  }

 private:
  Of of_;
  double held_s_ = 0.0;
  bool was_faulty_ = false;
};

/// By the formula that is published: k (w t_d + w²/(2 a)) above the guard, and 0.35 of it at least.
class TurnGuarded : public Invariant {
 public:
  explicit TurnGuarded(const Scenario& s)
      : Invariant("I21c", "the moment is at most what the moment guard allows"),
        guard_nm_(s.slave.command.moment_guard_nm) {
    double k = 0.0;
    for (const SurfaceConfig& surface : s.slave.scene.surface)
      if (surface.hinge)
        k = std::max(k, surface.hinge->arm_m * surface.hinge->arm_m *
                            stiffest_n_per_m(s.slave.scene, guard_nm_ / surface.hinge->arm_m));
    const double w = kSwift * s.slave.command.speed_max_rad_per_s;
    const double over_nm = k * (w * kReact_s + 0.5 * w * w / s.slave.command.acceleration_max_rad_per_s2);
    bound_nm_ = guard_nm_ + std::max((kGuardOvershoot - 1.0) * guard_nm_, over_nm);
    turns_ = k > 0.0;
  }
  void see(const Moment& m) override {
    const double moment_nm = m.F_E_W.moment.norm();
    if (!turns_ || moment_nm == 0.0) return;
    if (!as_reckoned(m)) pressed_nm_ = moment_nm;
    if (moment_nm <= guard_nm_) pressed_nm_ = 0.0;
    at_most(m, moment_nm, std::max(bound_nm_, kRise * pressed_nm_), "N m at the tool");
  }

 private:
  static constexpr double kReact_s = 0.02, kSwift = 1.05, kRise = 1.05;

  double guard_nm_, bound_nm_ = 0.0;
  bool turns_ = false;
  double pressed_nm_ = 0.0;  // turned in while the guard could not reckon
};

/// Whatever presses or lies: no further from where the hold began than giving way may lead, and braking.
class HeldPlace : public Invariant {
 public:
  explicit HeldPlace(const Scenario& s)
      : Invariant("I21e", "in a hold the tool gives way no further than command.give_way_m"),
        way_m_(s.slave.command.give_way_m),
        a_(s.slave.command.acceleration_max_m_per_s2) {}
  void see(const Moment& m) override {
    const bool moved = m.since(AffectedSignal::kRobot) < kQuiet_s ||
                       m.since(AffectedSignal::kJoints) < kQuiet_s ||
                       m.since(AffectedSignal::kSlaveTime) < kQuiet_s;
    const bool holds = m.claimed == SafetyState::kHolding && !m.sent_log->authority().engaged;
    if (!holds || moved) {
      place_m_ = m.X_WE.p;
      braking_m_ = m.v_WE.norm() * (kReact_s + 0.5 * m.v_WE.norm() / a_);
      return;
    }
    at_most(m, (m.X_WE.p - place_m_).norm(), way_m_ + braking_m_ + kSlack_m, "m in a hold");
  }

 private:
  static constexpr double kReact_s = 0.3, kSlack_m = 2e-3;

  double way_m_, a_;
  Vector3 place_m_ = Vector3::Zero();
  double braking_m_ = 0.0;
};

}  // namespace

void add_contact_invariants(const Scenario& s, Invariants& all) {
  all.push_back(std::make_unique<Guarded>(s));
  const double hold_n = hold_limit_n(s.slave.command), hold_nm = hold_limit_nm(s.slave.command);
  all.push_back(std::make_unique<ForceComesDown>(
      ForceComesDown::Of{"I21b", "in a hold the force comes down to the hold limit", "N in a hold",
                         &Wrench::force, 1.05 * hold_n + 0.3}));
  all.push_back(std::make_unique<TurnGuarded>(s));
  all.push_back(std::make_unique<ForceComesDown>(
      ForceComesDown::Of{"I21d", "in a hold the moment comes down to the hold limit", "N m in a hold",
                         &Wrench::moment, 1.05 * hold_nm + 0.03}));
  all.push_back(std::make_unique<HeldPlace>(s));
}

}  // namespace longreach
