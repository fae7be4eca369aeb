// I21: the force at the plant, and what becomes of it when the robot stops.

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

class Guarded : public Invariant {
 public:
  explicit Guarded(const Scenario& s)
      : Invariant("I21", "the force is at most 1.35 times the guard"),
        bound_n_(kGuardOvershoot * s.slave.command.force_guard_n) {}
  void see(const Moment& m) override {
    if (as_reckoned(m) && !m.F_E_W.force.isZero())
      at_most(m, m.F_E_W.force.norm(), bound_n_, "N at the tool");
  }

 private:
  double bound_n_;
};

/// A second and a half after the last right to move what presses has come down to the hold limit.
class Relieved : public Invariant {
 public:
  explicit Relieved(const Scenario& s)
      : Invariant("I21b", "in a hold the force comes down to the hold limit"),
        limit_n_(hold_limit_n(s.slave.command)) {}
  void see(const Moment& m) override {
    if (m.ghost->right().engaged || !as_reckoned(m) || m.claimed != SafetyState::kHolding) held_s_ = m.t_s;
    if (m.t_s - held_s_ > 1.5) at_most(m, m.F_E_W.force.norm(), 1.05 * limit_n_ + 0.3, "N in a hold");
  }

 private:
  double limit_n_;
  double held_s_ = 0.0;
};

}  // namespace

void add_contact_invariants(const Scenario& s, Invariants& all) {
  all.push_back(std::make_unique<Guarded>(s));
  all.push_back(std::make_unique<Relieved>(s));
}

}  // namespace longreach
