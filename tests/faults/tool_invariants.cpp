// I6, I7, I12: the tool, by its true pose and by that of the setpoints.

#include "slave/kinematics/kinematics.hpp"
#include "tests/faults/invariant.hpp"

namespace longreach {
namespace {

constexpr double kSlack = 1.02;      // documented: 1 % (slave/command/motion.hpp); and a mean over a tick
constexpr double kRecovers_s = 2.0;  // a robot that did not do what it was asked for

class ToolSpeed : public Invariant {
 public:
  explicit ToolSpeed(const Scenario& s)
      : Invariant("I6", "the tool keeps its speed"), command_(s.slave.command), arm_(s.slave.robot) {}
  void see(const Moment& m) override {
    // A robot that nobody commands brakes by its joints' own limits.
    if (!m.moves) rested_s_ = m.t_s;
    if (m.t_s - rested_s_ > 1.0 && m.since(AffectedSignal::kRobot) > kRecovers_s &&
        m.since(AffectedSignal::kJoints) > kRecovers_s && m.since(AffectedSignal::kScene) > kRecovers_s)
      at_most(m, m.v_WE.norm(), 1.1 * command_.speed_max_m_per_s, "m/s of the tool");
    if (!m.moves) {
      known_ = known_ && !m.slave_ran;
      return;
    }
    const Pose X = arm_.forward(m.setpoint_rad);
    if (known_) {
      at_most(m, (X.p - X_.p).norm() / m.period_s, kSlack * command_.speed_max_m_per_s,
              "m/s of the setpoint");
      at_most(m, X.q.angularDistance(X_.q) / m.period_s, kSlack * command_.speed_max_rad_per_s,
              "rad/s of the setpoint");
    }
    X_ = X;
    known_ = true;
  }

 private:
  CommandConfig command_;
  Kinematics arm_;
  Pose X_{};
  bool known_ = false;
  double rested_s_ = 0.0;
};

class Workspace : public Invariant {
 public:
  explicit Workspace(const Scenario& s)
      : Invariant("I7", "the tool stays in its workspace"),
        centre_m_(start_pose(s).p),
        bound_m_(s.slave.command.workspace_m + 1e-3) {}
  void see(const Moment& m) override {
    if (m.since(AffectedSignal::kRobot) < kRecovers_s) outside_ = true;  // others may have carried it off
    const double off_m = (m.X_WE.p - centre_m_).norm();
    outside_ = outside_ && off_m > bound_m_;
    if (!outside_) at_most(m, off_m, bound_m_, "m from the centre");
  }

 private:
  Vector3 centre_m_;
  double bound_m_;
  bool outside_ = false;
};

/// At the tick in which an engagement begins. A setpoint that moved before, as in a hold, may go on with its
/// speed.
class NoJump : public Invariant {
 public:
  explicit NoJump(const Scenario& s)
      : Invariant("I12", "an engagement begins without a jump"), arm_(s.slave.robot) {}
  void see(const Moment& m) override {
    if (!m.slave_ran) return;
    const bool engaged = m.claimed == SafetyState::kEngaged;
    if (m.report && engaged && !engaged_ && m.engagement != engagement_ && m.moves)
      judge(m, known_ ? JointVector(2.0 * last_rad_ - before_last_rad_) : m.reported.joint_rad);
    if (engaged) engagement_ = m.engagement;
    engaged_ = engaged;
    before_last_rad_ = known_ ? last_rad_ : m.setpoint_rad;
    last_rad_ = m.setpoint_rad;
    known_ = m.moves;
  }

 private:
  /// From the setpoint before, or from what was measured where there was none.
  void judge(const Moment& m, const JointVector& before_rad) {
    const Pose X = arm_.forward(m.setpoint_rad), before = arm_.forward(before_rad);
    at_most(m, (X.p - before.p).norm(), 1e-4, "m at an engagement");
    at_most(m, X.q.angularDistance(before.q), 1e-4, "rad at an engagement");
  }
  Kinematics arm_;
  std::uint32_t engagement_ = 0;
  JointVector last_rad_ = JointVector::Zero(), before_last_rad_ = JointVector::Zero();
  bool known_ = false, engaged_ = false;
};

}  // namespace

void add_tool_invariants(const Scenario& s, Invariants& all) {
  all.push_back(std::make_unique<ToolSpeed>(s));
  all.push_back(std::make_unique<Workspace>(s));
  all.push_back(std::make_unique<NoJump>(s));
}

}  // namespace longreach
