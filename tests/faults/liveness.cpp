// L1 to L3: once nothing goes wrong any more, it works again when it is asked to.

#include <algorithm>

#include "slave/kinematics/kinematics.hpp"
#include "tests/faults/invariant.hpp"

namespace longreach {
namespace {

/// Seconds since the faults ended.
class Calm {
 public:
  double since(const Moment& m) {
    if (!m.faults_over) over_s_ = m.t_s;
    return m.t_s - over_s_;
  }

 private:
  double over_s_ = 0.0;
};

class Hears : public Invariant {
 public:
  explicit Hears(const Scenario& s)
      : Invariant("L1", "both sides hear each other again"), bound_s_(s.round_trip_s + 1.5) {}
  void see(const Moment& m) override {
    if (stable_.since(m) < bound_s_) return;
    that(m, m.shown != SafetyState::kIdle && m.claimed != SafetyState::kIdle,
         "a side is idle though both run");
  }

 private:
  Calm stable_;
  double bound_s_;
};

class Engages : public Invariant {
 public:
  explicit Engages(const Scenario& s)
      : Invariant("L2", "an engagement that is asked for comes about"),
        round_trip_s_(s.round_trip_s),
        centre_m_(start_pose(s).p),
        workspace_m_(s.slave.command.workspace_m) {}
  void see(const Moment& m) override {
    // Somebody may have carried the tool out of its workspace: an engagement waits till it is back. A client
    // may have tightened how old news may be.
    tightened_ = tightened_ || m.configured;
    if (tightened_ || (m.X_WE.p - centre_m_).norm() > workspace_m_) {
      asked_s_ = 0.0;
      return;
    }
    const bool stable = stable_.since(m) > kSettles_s + round_trip_s_;
    if (m.shown == SafetyState::kEngaged) {
      if (asked_s_ > 0.0) at_most(m, m.t_s - asked_s_, bound_s(), "s from asking to being engaged");
      asked_s_ = 0.0;
    } else if (stable && m.engage_asked && asked_s_ == 0.0) {
      asked_s_ = m.t_s;
    }
    if (asked_s_ > 0.0) at_most(m, m.t_s - asked_s_, bound_s(), "s after asking not engaged");
  }

 private:
  static constexpr double kSettles_s = 1.0;  // both sides hear each other again: L1
  [[nodiscard]] double bound_s() const { return round_trip_s_ + 0.5 + 0.005; }
  Calm stable_;
  double round_trip_s_;
  Vector3 centre_m_;
  double workspace_m_;
  bool tightened_ = false;
  double asked_s_ = 0.0;
};

/// The hand rests then: the robot is where it is asked to be, where nothing keeps it from there. An
/// engagement is anchored where the robot was asked to be then; somebody may have moved it off there.
class Tracks : public Invariant {
 public:
  explicit Tracks(const Scenario& s)
      : Invariant("L3", "the robot follows the hand again"),
        arm_(s.slave.robot),
        round_trip_s_(s.round_trip_s) {}
  void see(const Moment& m) override {
    const MotionAuthority& authority = m.sent_log->authority();
    const bool engaged = authority.engaged && m.claimed == SafetyState::kEngaged;
    if (engaged && m.engagement != engagement_) {
      engagement_ = m.engagement;
      anchor_m_ = arm_.forward(m.setpoint_rad).p;
      goal_m_.setZero();
    }
    if (!engaged) begun_s_ = m.t_s;
    if (engaged && authority.newest->command.goal_kind == GoalKind::kGoalPosition)
      goal_m_ = authority.newest->command.position_m;
    const bool limited = m.telemetry && limits(m.telemetry->clamps);
    if (limited || !m.F_E_W.force.isZero() || !m.F_E_W.moment.isZero()) kept_s_ = m.t_s;
    const double settles_s = kSettles_s + round_trip_s_;
    if (stable_.since(m) > settles_s && m.t_s - begun_s_ > settles_s && m.t_s - kept_s_ > 1.0)
      at_most(m, (m.X_WE.p - anchor_m_ - goal_m_).norm(), kOff_m, "m off the goal");
  }

 private:
  static constexpr double kSettles_s = 4.0, kOff_m = 2e-3;
  static bool limits(const Clamps& c) {
    return c.joint_position || c.workspace || c.force_guard || c.singularity || c.unreachable ||
           c.tool_speed || c.joint_speed || c.acceleration || c.moment_guard;
  }
  Kinematics arm_;
  Calm stable_;
  double round_trip_s_;
  std::uint32_t engagement_ = 0;
  Vector3 anchor_m_ = Vector3::Zero(), goal_m_ = Vector3::Zero();
  double begun_s_ = 0.0, kept_s_ = 0.0;
};

}  // namespace

void add_liveness(const Scenario& s, Invariants& all) {
  all.push_back(std::make_unique<Hears>(s));
  all.push_back(std::make_unique<Engages>(s));
  all.push_back(std::make_unique<Tracks>(s));
}

}  // namespace longreach
