// I22, I23: the wrench on the hand, and the energy that it does at the handle's true motion.

#include <algorithm>

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

/// What the hand has put in and not got back, by the true motion. A device that lies, that nobody holds, or
/// whose master stands still does work that no law at the master can bound: what a spring shall give back is
/// told by the place that is measured, and a handle without a hand is moved by its motors. The balance rests
/// meanwhile, and goes on when the port rests: the springs that such a time leaves stretched were loaded by
/// what was not booked, and give back no more than that. A port at rest stores nothing but what its tanks
/// hold.
class PortEnergy : public Invariant {
 public:
  explicit PortEnergy(const Scenario& s)
      : Invariant("I23", "no energy comes out of the handle"),
        tanks_j_(2.0 * s.master.rendering.tank_max_j) {}
  void see(const Moment& m) override {
    const Vector3 moved_m = m.x_MH - x_m_;
    const Vector3 turned_rad = log_rotation(m.q_MH * q_.conjugate());
    const bool honest = m.handle.held && m.since(Spoils::kHandle) > 0.1 && m.since(Spoils::kMasterTime) > 0.1;
    const bool rests = F_.force.norm() < kRest_n && F_.moment.norm() < kRest_nm &&
                       moved_m.norm() < kRest_m_per_s * m.period_s &&
                       turned_rad.norm() < kRest_rad_per_s * m.period_s;
    books_ = honest && (books_ || rests);
    if (books_) energy_j_ -= F_.force.dot(moved_m) + F_.moment.dot(turned_rad);
    if (books_ && rests) energy_j_ = std::min(energy_j_, tanks_j_);
    if (books_) at_most(m, -energy_j_, 1e-3, "J out of the handle");
    x_m_ = m.x_MH;
    q_ = m.q_MH;
    F_ = m.F_H_M;
  }

 private:
  // Springs of 60 N/m and 0.46 N m/rad store 0.1 mJ at that.
  static constexpr double kRest_n = 0.1, kRest_nm = 5e-3;
  static constexpr double kRest_m_per_s = 5e-3, kRest_rad_per_s = 0.05;

  double tanks_j_;
  Vector3 x_m_ = Vector3::Zero();
  Quaternion q_ = Quaternion::Identity();
  Wrench F_{};
  bool books_ = true;
  double energy_j_ = 0.0;
};

}  // namespace

void add_hand_invariants(const Scenario& s, Invariants& all) {
  all.push_back(std::make_unique<HandForce>(s));
  all.push_back(std::make_unique<PortEnergy>(s));
}

}  // namespace longreach
