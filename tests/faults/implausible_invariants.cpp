// I34 to I36: what no handle and no sensor can report is not followed, and what a fault has refused does not come
// about by itself.

#include <algorithm>

#include "tests/faults/invariant.hpp"

namespace longreach {
namespace {

/// A step that no hand makes, even after a pause of the device's adapter, and a place that no handle reaches.
class HandleImplausible : public Invariant {
 public:
  explicit HandleImplausible(const Scenario& s)
      : Invariant("I34", "a handle that jumps or is far outside its workspace is not followed"),
        outside_m_(kOutside * s.master.device.delta.workspace_m) {}
  void see(const Moment& m) override {
    if (!m.master_ran) return;
    const bool ok = m.handle.ok;
    const bool jumped = ok && before_ok_ && (m.handle.p_MH - before_m_).norm() > kJump_m &&
                        m.master_gap_s < kGap_s && shown_ == SafetyState::kEngaged;
    if (jumped) ended_ = std::max(ended_, m.engaged_in);
    const bool follows = m.shown == SafetyState::kEngaged && m.engaged_in <= ended_;
    if (ended_ > 0) that(m, !follows, "the handle has jumped, and its engagement continues");
    if (jumped)
      at_most(m, (m.goal_m - last_goal_m_).norm(), kGoal_m, "m of a jump of the handle are followed");
    const bool outside = ok && m.handle.p_MH.norm() > outside_m_;
    if (outside) that(m, m.shown != SafetyState::kEngaged, "the handle is far outside, and it is engaged");
    before_ok_ = ok;
    before_m_ = m.handle.p_MH;
    last_goal_m_ = m.goal_m;
    shown_ = m.shown;
  }

 private:
  static constexpr double kJump_m = 0.15, kGap_s = 0.01, kOutside = 3.0, kGoal_m = 1e-3;
  double outside_m_;
  bool before_ok_ = false;
  Vector3 before_m_ = Vector3::Zero(), last_goal_m_ = Vector3::Zero();
  SafetyState shown_ = SafetyState::kIdle;
  std::uint32_t ended_ = 0;
};

/// As the table of the sensor's checks says it (slave/sensing/sensor_watch.hpp), with room for an adapter that
/// stalls: a channel of a sensor with noise that stays the same to the last digit.
class SensorStandsStill : public Invariant {
 public:
  explicit SensorStandsStill(const Scenario& s)
      : Invariant("I35", "a force that stops varying is a fault"),
        noisy_(s.slave.sensing.force && s.slave.sensing.force_noise_n > s.slave.sensing.force_resolution_n) {}
  void see(const Moment& m) override {
    if (!m.slave_ran) return;
    const bool same = m.reported.ok && m.reported.F_F_W.force == before_n_ && m.slave_gap_s < kGap_s;
    same_s_ = same ? same_s_ + m.slave_gap_s : 0.0;
    varied_ = varied_ || !same;
    before_n_ = m.reported.F_F_W.force;
    if (noisy_ && varied_ && same_s_ > kStill_s && m.report)
      that(m, m.claimed == SafetyState::kFault, "the force has not varied for long, and no fault is claimed");
  }

 private:
  static constexpr double kStill_s = 0.5, kGap_s = 0.01;
  bool noisy_;
  bool varied_ = false;
  Vector3 before_n_ = Vector3::Zero();
  double same_s_ = 0.0;
};

/// A request that reached the slave while the robot had failed.
class RefusedForGood : public Invariant {
 public:
  explicit RefusedForGood(const Scenario&)
      : Invariant("I36", "an engagement that was refused for a fault does not begin when the fault ends") {}
  void see(const Moment& m) override {
    const bool disturbed = m.since(AffectedSignal::kLease) < kQuiet_s ||
                           m.since(AffectedSignal::kMaster) < kQuiet_s ||
                           m.since(AffectedSignal::kSlave) < kQuiet_s;
    if (disturbed) refused_ = 0;
    const MotionAuthority& authority = m.sent_log->authority();
    const bool asks = authority.received_s == m.t_s && authority.request == Request::kEngage;
    if (m.slave_ran && !disturbed && asks && !m.reported.ok && m.slave_gap_s < kGap_s)
      refused_ = std::max(refused_, authority.engagement);
    if (m.report && refused_ > 0)
      that(m, m.claimed != SafetyState::kEngaged || m.engagement > refused_,
           "it was asked for while the robot had failed, and has begun");
  }

 private:
  static constexpr double kQuiet_s = 1.0, kGap_s = 0.01;
  std::uint32_t refused_ = 0;
};

}  // namespace

void add_implausible_invariants(const Scenario& s, Invariants& all) {
  all.push_back(std::make_unique<HandleImplausible>(s));
  all.push_back(std::make_unique<SensorStandsStill>(s));
  all.push_back(std::make_unique<RefusedForGood>(s));
}

}  // namespace longreach
