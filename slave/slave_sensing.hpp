#pragma once
// Processing of the robot's force sensor: each sample is checked (sensor_watch.hpp), tool, load and bias are
// compensated (tool_load.hpp), contacts are detected in the remainder (contact.hpp), and the plausibility of
// the force is monitored (force_plausibility.hpp). If a sensor fault is detected, the surfaces from its force
// are discarded.

#include <optional>

#include "slave/command/force_plausibility.hpp"
#include "slave/command/setpoint_lead.hpp"
#include "slave/config/slave_config.hpp"
#include "slave/estimation/contact.hpp"
#include "slave/kinematics/kinematics.hpp"
#include "slave/sensing/sensor_watch.hpp"
#include "slave/sensing/tool_load.hpp"
#include "slave/sensing/touch_threshold.hpp"

namespace longreach {

/// Conditions of the measurement.
struct SensingInput {
  SafetyState state = SafetyState::kIdle;
  bool let_go = false;  // no hand is on the handle
  bool still = false;   // the setpoint is at rest, and the tool has reached it
  double scale = 1.0;   // k_scale as last sent
  double played_sequence = 0.0, played_turn_sequence = 0.0;
  double news_age_s = 0.0;  // age of the operator's information about this side when the goal was commanded
  Clamps clamps{};          // of the last step
  Quaternion q_anchor = Quaternion::Identity();
  double dt = 0.0;  // s
};

class SlaveSensing {
 public:
  explicit SlaveSensing(const SlaveConfig& config);
  void configure(const SlaveConfig& config);

  /// Checks the state of the robot before it is used. A sample that repeats the previous one while the arm
  /// moves is ignored.
  void update(const RobotState& robot, const Kinematics& arm, bool may_hold, Time now);
  void step(const SensingInput& input);
  /// Starts an engagement; `q_before` is the previous reference of rotations.
  void begin(const Quaternion& q_before, const Quaternion& q_anchor);
  void zero() { load_.zero(); }
  /// Zeros and thresholds, for status and log.
  [[nodiscard]] SensorZero sensor_zero() const;

  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] bool ready() const { return load_.ready(); }
  [[nodiscard]] bool free() const { return !contact_.in_contact() && !turn_contact_.in_contact(); }
  [[nodiscard]] const Pose& X_WE() const { return tool_.X_WE; }  // measured
  [[nodiscard]] const Wrench& F_E_W() const { return F_E_W_; }   // without tool, load and bias
  [[nodiscard]] const LoadIdentifier& load() const { return load_.load(); }
  [[nodiscard]] const ForcePlausibility& plausibility() const { return plausibility_; }
  SlaveContact& contact() { return contact_; }
  /// positions are rotation vectors from the anchor, in W
  SlaveContact& turn_contact() { return turn_contact_; }

  /// Information for the guards about force and moment. `moves`: the guards may move the robot; otherwise
  /// they receive no force.
  [[nodiscard]] ContactForce pressed(const SetpointLead& lead, bool moves) const;
  [[nodiscard]] ContactForce turned(const SetpointLead& lead, bool moves) const;

 private:
  [[nodiscard]] bool plausible(const RobotState& robot, bool may_hold, double elapsed_s);
  void forget_lies();
  void derive(double elapsed_s);

  double loop_hz_;
  double touch_bound_n_;  // that the checks of the guards use
  NeedsConfig needs_;     // components of contact, sensor and estimator that are not needed are absent
  SensorWatch watch_;
  ForcePlausibility plausibility_;
  ToolCompensation load_;
  TouchThreshold threshold_;
  SlaveContact contact_;
  SlaveContact turn_contact_;

  RobotState before_{};  // its last new sample
  std::optional<Time> sampled_at_{};
  ToolKinematics tool_{};
  Twist V_WE_{};
  Wrench F_E_W_{};
  bool ok_ = true;
  bool zeroed_ = false;  // the contact knows of the first zero
};

}  // namespace longreach
