// I22 to I24: the wrench on the hand, the energy that it does at the handle's true motion, and what becomes
// of a stiffness that is old.

#include <algorithm>
#include <cmath>

#include "master/config/rendering_config.hpp"
#include "master/simulation/simulated_devices.hpp"
#include "tests/faults/invariant.hpp"

namespace longreach {
namespace {

/// Only the rise is limited: a force that falls gives no energy away. What the device does by itself, where
/// it is let go or at its edge, stays (master/devices/handle_behaviour.hpp).
class HandForce : public Invariant {
 public:
  explicit HandForce(const Scenario& s)
      : Invariant("I22", "the hand is pushed within the limits of force and rise, and not when not engaged"),
        r_(s.master.rendering),
        edge_m_(s.master.device.behaviour.stop_share * s.master.device.delta.workspace_m),
        edge_rad_(s.master.device.behaviour.stop_share * s.master.device.spherical.workspace_rad),
        count_m_per_s_(2.0 * device_figures(s.master.device, 1.0 / s.master.loop.rate_hz).cell.m /
                       (1.0 / s.master.loop.rate_hz + s.master.device.velocity_filter_s)) {}
  void see(const Moment& m) override {
    if (!m.master_ran) return;
    at_most(m, m.F_H_M.force.norm(), r_.force_max_n * kSlack, "N on the hand");
    at_most(m, m.F_H_M.moment.norm(), r_.moment_max_nm * kSlack, "N m on the hand");
    at_most(m, rise(F_.force, m.F_H_M.force), r_.slew_n_per_s * m.period_s * kSlack, "N more on the hand");
    at_most(m, rise(F_.moment, m.F_H_M.moment), r_.slew_nm_per_s * m.period_s * kSlack,
            "N m more on the hand");
    F_ = m.F_H_M;
    see_rest(m);
  }

 private:
  static constexpr double kSlack = 1.0001, kReacts_s = 0.01;
  static double rise(const Vector3& before, const Vector3& now) {
    return now.norm() > before.norm() ? (now - before).norm() : 0.0;
  }
  void see_rest(const Moment& m) {
    const bool live = m.shown == SafetyState::kEngaged || m.shown == SafetyState::kHolding;
    const bool by_itself = !m.handle.held || m.since(AffectedSignal::kHandle) == 0.0 ||
                           m.x_MH.norm() > edge_m_ - kNear_m ||
                           log_rotation(m.q_MH).norm() > edge_rad_ - kNear_rad;
    rests_s_ = live || by_itself ? 0.0 : rests_s_ + m.period_s;
    // A hand that has just been freed is let down by damping, which the motion of the last moments bounds.
    const double speed = (m.x_MH - x_m_).norm() / m.period_s;
    x_m_ = m.x_MH;
    fast_m_per_s_ = std::max(speed, fast_m_per_s_ * std::exp(-m.period_s / kMoments_s));
    if (rests_s_ < r_.ramp_s + kReacts_s) return;
    const double damped_n = rests_s_ < kFreed_s ? kFreed_n_s_per_m * (fast_m_per_s_ + count_m_per_s_) : 0.0;
    at_most(m, m.F_H_M.force.norm(), damped_n, "N on a hand that is not engaged");
    at_most(m, m.F_H_M.moment.norm(), 0.0, "N m on a hand that is not engaged");
  }

  static constexpr double kNear_m = 1e-3, kNear_rad = 0.02;  // what the encoders and the structure leave open
  static constexpr double kFreed_s = 0.65, kFreed_n_s_per_m = 30.0, kMoments_s = 0.05;
  RenderingConfig r_;
  double edge_m_, edge_rad_;
  double count_m_per_s_;  // what the encoders show of a handle that keeps still
  Vector3 x_m_ = Vector3::Zero();
  double fast_m_per_s_ = 0.0;
  Wrench F_{};
  double rests_s_ = 0.0;
};

/// What the master says that it renders, along what is felt; a hand that returns to the handle finds again
/// what it has let go. Its honesty is I23's: a spring that is stiffer than it says gives back what nobody put
/// in.
class StaleStiffness : public Invariant {
 public:
  explicit StaleStiffness(const Scenario& s)
      : Invariant("I24", "without a report the stiffness does not rise"),
        silence_s_(s.master.safety.silence_s) {}
  void see(const Moment& m) override {
    if (!m.master_ran) return;
    if (m.report_came) came_s_ = m.t_s;
    const bool same = m.felt && felt_ && m.rendered_along == along_ &&
                      std::abs(m.rendered_from_m - from_m_) < kFar_m && m.handle.held == held_;
    const bool stale = m.t_s - came_s_ > silence_s_;
    if (stale && known_ && same)
      at_most(m, m.rendered_n_per_m, (1.0 + 1e-12) * rendered_n_per_m_, "N/m of the past");
    rendered_n_per_m_ = m.rendered_n_per_m;
    along_ = m.rendered_along;
    held_ = m.handle.held;
    felt_ = m.felt;
    from_m_ = m.rendered_from_m;
    known_ = stale;
  }

 private:
  double silence_s_;
  double came_s_ = 0.0, rendered_n_per_m_ = 0.0;
  static constexpr double kFar_m = 2e-4;  // another surface
  Vector3 along_ = Vector3::Zero();
  double from_m_ = 0.0;
  bool known_ = false, held_ = false, felt_ = false;
};

/// What the hand has put in and not got back, by the true motion. A device that lies, that nobody holds, or
/// whose master stands still does work that no law at the master can bound: what a spring shall give back is
/// told by the place that is measured, and a handle without a hand is moved by its motors. The balance rests
/// meanwhile, and goes on when the port rests: the springs that such a time leaves stretched were loaded by
/// what was not booked, and give back no more than that. A port at rest stores nothing but what its tanks
/// hold; after such a time they may be full.
class PortEnergy : public Invariant {
 public:
  explicit PortEnergy(const Scenario& s)
      : Invariant("I23", "no more energy comes out of the handle than went in and the store"),
        tanks_j_(2.0 * s.master.rendering.tank_max_j),
        most_j_(returned_most_j(s.master.rendering)) {}
  void see(const Moment& m) override {
    const Vector3 moved_m = m.x_MH - x_m_;
    const Vector3 turned_rad = log_rotation(m.q_MH * q_.conjugate());
    const bool honest =
        m.handle.held && m.since(AffectedSignal::kHandle) > 0.1 && m.since(AffectedSignal::kMasterTime) > 0.1;
    const bool rests = F_.force.norm() < kRest_n && F_.moment.norm() < kRest_nm &&
                       moved_m.norm() < kRest_m_per_s * m.period_s &&
                       turned_rad.norm() < kRest_rad_per_s * m.period_s;
    const bool begins = honest && rests && !books_;
    books_ = honest && (books_ || rests);
    if (begins) energy_j_ = tanks_j_;
    if (books_) energy_j_ -= F_.force.dot(moved_m) + F_.moment.dot(turned_rad);
    if (books_ && rests) energy_j_ = std::min(energy_j_, tanks_j_);
    // Each engagement begins with a full store.
    const bool engaged = m.shown == SafetyState::kEngaged;
    if (engaged && m.engaged_in != engaged_in_) energy_j_ = std::max(energy_j_, 0.0);
    if (engaged) engaged_in_ = m.engaged_in;
    if (books_) at_most(m, -energy_j_, most_j_, "J out of the handle");
    x_m_ = m.x_MH;
    q_ = m.q_MH;
    F_ = m.F_H_M;
  }

 private:
  // Springs of 60 N/m and 0.46 N m/rad store 0.1 mJ at that.
  static constexpr double kRest_n = 0.1, kRest_nm = 5e-3;
  static constexpr double kRest_m_per_s = 5e-3, kRest_rad_per_s = 0.05;

  double tanks_j_, most_j_;
  std::uint32_t engaged_in_ = 0;
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
  all.push_back(std::make_unique<StaleStiffness>(s));
}

}  // namespace longreach
