// I22, I23: the wrench on the hand, and the energy that it does at the handle's true motion.

#include "tests/experiments/faults/invariant.hpp"

namespace longreach {
namespace {

class HandForce : public Invariant {
 public:
  explicit HandForce(const Scenario& s)
      : Invariant("I22", "the hand is pushed within the limits of force and rise"), r_(s.master.rendering) {}
  void see(const Moment& m) override {
    if (!m.master_ran) return;
    at_most(m, m.F_H_M.force.norm(), r_.force_max_n * 1.0001, "N on the hand");
    at_most(m, m.F_H_M.moment.norm(), r_.moment_max_nm * 1.0001, "N m on the hand");
  }

 private:
  RenderingConfig r_;
};

class PortEnergy : public Invariant {
 public:
  explicit PortEnergy(const Scenario&) : Invariant("I23", "no energy comes out of the handle") {}
  void see(const Moment& m) override {
    const Vector3 moved_m = m.x_MH - x_m_;
    const Vector3 turned_rad = log_rotation(m.q_MH * q_.conjugate());
    // A handle that lies, is let go or has no master does not count: what it does by itself is a motor.
    const bool counts = m.handle.held && m.since(Spoils::kHandle) > 0.1 && m.since(Spoils::kMasterTime) > 0.1;
    if (counts) {
      energy_j_ -= F_.force.dot(moved_m) + F_.moment.dot(turned_rad);
    } else {
      energy_j_ = 0.0;
    }
    if (counts) at_most(m, -energy_j_, 1e-3, "J out of the handle");
    x_m_ = m.x_MH;
    q_ = m.q_MH;
    F_ = m.F_H_M;
  }

 private:
  Vector3 x_m_ = Vector3::Zero();
  Quaternion q_ = Quaternion::Identity();
  Wrench F_{};
  double energy_j_ = 0.0;
};

}  // namespace

void add_hand_invariants(const Scenario& s, Invariants& all) {
  all.push_back(std::make_unique<HandForce>(s));
  all.push_back(std::make_unique<PortEnergy>(s));
}

}  // namespace longreach
