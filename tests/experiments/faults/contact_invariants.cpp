// I21: the force at the plant, and what becomes of it when the robot stops.

#include <algorithm>
#include <cmath>

#include "slave/command/guard_config.hpp"
#include "tests/experiments/faults/invariant.hpp"

namespace longreach {
namespace {

constexpr double kCalm_s = 3.0;  // after what the guard cannot reckon with

bool as_reckoned(const Moment& m) {
  for (const Spoils what :
       {Spoils::kSensor, Spoils::kJoints, Spoils::kRobot, Spoils::kScene, Spoils::kSlaveTime})
    if (m.since(what) < kCalm_s) return false;
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
    beyond_ = beyond_ && (force_n > 0.0 && settled_s_ < kRelief_s);
    if (!as_reckoned(m) || beyond_) {
      pressed_n_ = force_n;
      engaged_s_ = 0.0;
      return;
    }
    if (force_n <= bound_n_) pressed_n_ = 0.0;
    if (engaged) engaged_s_ += m.period_s;
    const double most_n = pressed_n_ > 0.0 && engaged_s_ < kRelief_s ? kRise * pressed_n_ : bound_n_;
    if (force_n > 0.0) at_most(m, force_n, most_n, "N at the tool");
  }

 private:
  static constexpr double kRelief_s = 3.0, kRise = 1.05, kSwift = 1.05;

  double bound_n_;
  bool stiff_;
  bool beyond_ = false;
  double last_n_ = 0.0, settled_s_ = 0.0;
  // Somebody has pressed the robot in: it may stay so till it is engaged, and is then relieved.
  double pressed_n_ = 0.0, engaged_s_ = 0.0;
};

/// A second and a half after the last right to move what presses has come down to the hold limit. A hold in
/// which the sensor has lied may have spent its way of relief on that.
class Relieved : public Invariant {
 public:
  explicit Relieved(const Scenario& s)
      : Invariant("I21b", "in a hold the force comes down to the hold limit"),
        limit_n_(hold_limit_n(s.slave.command)) {}
  void see(const Moment& m) override {
    if (m.ghost->right().engaged || m.claimed != SafetyState::kHolding) {
      held_s_ = m.t_s;
      lied_ = false;
    }
    lied_ = lied_ || !as_reckoned(m);
    if (m.t_s - held_s_ > 1.5 && !lied_)
      at_most(m, m.F_E_W.force.norm(), 1.05 * limit_n_ + 0.3, "N in a hold");
  }

 private:
  double limit_n_;
  double held_s_ = 0.0;
  bool lied_ = false;
};

}  // namespace

void add_contact_invariants(const Scenario& s, Invariants& all) {
  all.push_back(std::make_unique<Guarded>(s));
  all.push_back(std::make_unique<Relieved>(s));
}

}  // namespace longreach
