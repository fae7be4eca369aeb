// I1 to I5: the setpoints as they were written, from tick to tick, across all changes of state.

#include <cmath>

#include "tests/faults/invariant.hpp"

namespace longreach {
namespace {

constexpr double kJointSlack = 1.01;  // documented: slave/command/limit_watch.hpp

class Finite : public Invariant {
 public:
  Finite() : Invariant("I1", "all that is written to robot, device and wire is finite") {}
  void see(const Moment& m) override {
    if (m.moves) that(m, m.setpoint_rad.allFinite(), "a setpoint is not finite");
    if (m.master_ran)
      that(m, m.F_H_M.force.allFinite() && m.F_H_M.moment.allFinite(), "a wrench is not finite");
    if (m.telemetry)
      that(m, std::abs(m.telemetry->X_WE.q.norm() - 1.0) < 1e-6, "a told quaternion is not unit");
  }
};

class JointPosition : public Invariant {
 public:
  explicit JointPosition(const Scenario& s)
      : Invariant("I2", "no joint leaves its range"), robot_(s.slave.robot) {}
  void see(const Moment& m) override {
    if (m.moves) at_most(m, beyond(m.setpoint_rad), 1e-12, "setpoint beyond a joint's limit by rad");
    if (m.slave_ran && m.since(AffectedSignal::kRobot) > 2.0)
      at_most(m, beyond(m.truth.joint_rad), kGives, "joint beyond its limit by rad");
  }

 private:
  static constexpr double kGives = 0.02;  // a joint on a spring swings
  [[nodiscard]] double beyond(const JointVector& q) const {
    double most = 0.0;
    for (int i = 0; i < kMaxJoints; ++i) {
      const JointConfig& j = robot_.joint[static_cast<std::size_t>(i)];
      if (!(q[i] >= j.min_rad && q[i] <= j.max_rad))
        most = std::max(most, std::max(j.min_rad - q[i], q[i] - j.max_rad));
    }
    return most;
  }
  RobotConfig robot_;
};

/// What `order` differences of the setpoints are at most, as share of the limit.
class JointDifference : public Invariant {
 public:
  JointDifference(const Scenario& s, std::string_view name, std::string_view says, int order,
                  double JointConfig::*limit)
      : Invariant(name, says), order_(order) {
    for (int i = 0; i < kMaxJoints; ++i) limit_[i] = s.slave.robot.joint[static_cast<std::size_t>(i)].*limit;
  }
  void see(const Moment& m) override {
    if (!m.moves) {
      if (m.slave_ran) known_ = 0;  // not asked for a motion: what comes next begins at rest
      return;
    }
    JointVector difference = m.setpoint_rad;
    for (int k = 0; k < order_; ++k) {
      const JointVector before = last_[k];
      last_[k] = difference;
      difference = (known_ > k ? JointVector((difference - before) / m.period_s) : JointVector::Zero());
    }
    if (known_ >= order_)
      at_most(m, (difference.cwiseAbs().array() / limit_.array()).maxCoeff(), kJointSlack,
              "share of the limit");
    known_ = std::min(known_ + 1, order_);
  }

 private:
  int order_;
  int known_ = 0;
  JointVector limit_;
  std::array<JointVector, 3> last_{};
};

}  // namespace

void add_joint_invariants(const Scenario& s, Invariants& all) {
  all.push_back(std::make_unique<Finite>());
  all.push_back(std::make_unique<JointPosition>(s));
  all.push_back(std::make_unique<JointDifference>(s, "I3", "a joint's setpoint keeps its speed", 1,
                                                  &JointConfig::speed_max_rad_per_s));
  all.push_back(std::make_unique<JointDifference>(s, "I4", "a joint's setpoint keeps its acceleration", 2,
                                                  &JointConfig::acceleration_max_rad_per_s2));
  all.push_back(std::make_unique<JointDifference>(s, "I5", "a joint's setpoint keeps its jerk", 3,
                                                  &JointConfig::jerk_max_rad_per_s3));
}

}  // namespace longreach
