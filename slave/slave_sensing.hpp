#pragma once
// Processes the samples of the robot's force sensor. Each sample is checked (sensor_watch.hpp). The effects
// of tool, load and bias are compensated (tool_load.hpp), contacts are detected in the remainder
// (contact.hpp), and the plausibility of the force is monitored (force_plausibility.hpp). If a sensor fault
// is detected, the surfaces that were identified from its force are discarded.

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

/// Conditions under which the force is measured.
struct SensingInput {
  SafetyState state = SafetyState::kIdle;
  bool let_go = false;  // the operator has released the handle
  bool still = false;   // the setpoint is at rest, and the tool has reached it
  double scale = 1.0;   // the last received k_scale
  double played_sequence = 0.0, played_turn_sequence = 0.0;
  /// Age of the operator's information about the slave when the goal was commanded, s.
  double news_age_s = 0.0;
  Clamps clamps{};  // limits that were active in the last step
  Quaternion q_anchor = Quaternion::Identity();
  double dt = 0.0;  // s
};

class SlaveSensing {
 public:
  explicit SlaveSensing(const SlaveConfig& config);
  void configure(const SlaveConfig& config);

  /// Checks the state of the robot before it is used. A sample that repeats the previous one while the arm
  /// moves is ignored. `may_hold` is true if the gripper may hold a load.
  void update(const RobotState& robot, const Kinematics& arm, bool may_hold, Time now);
  void step(const SensingInput& input);
  /// Starts an engagement. `q_before` is the previous reference for rotations, and `q_anchor` the new one.
  void begin(const Quaternion& q_before, const Quaternion& q_anchor);
  /// Starts zeroing the sensor.
  void zero() { load_.zero(); }
  /// Returns the zeroing state and the thresholds, for status and log.
  [[nodiscard]] SensorZero sensor_zero() const;

  [[nodiscard]] bool ok() const { return ok_; }
  /// Returns why the sensor is not used: it has reported a single value since the start. No reason if it has
  /// reported two values, or may repeat them.
  [[nodiscard]] Reason constant() const { return watch_.constant(); }
  /// True if the first zeroing is complete.
  [[nodiscard]] bool ready() const { return load_.ready(); }
  [[nodiscard]] bool free() const { return !contact_.in_contact() && !turn_contact_.in_contact(); }
  [[nodiscard]] const Pose& X_WE() const { return tool_.X_WE; }  // measured
  /// Measured wrench without the effect of tool, load and bias.
  [[nodiscard]] const Wrench& F_E_W() const { return F_E_W_; }
  [[nodiscard]] const LoadIdentifier& load() const { return load_.load(); }
  [[nodiscard]] const ForcePlausibility& plausibility() const { return plausibility_; }
  SlaveContact& contact() { return contact_; }
  /// Rotational contact; its positions are rotation vectors from the anchor, in W.
  SlaveContact& turn_contact() { return turn_contact_; }

  /// These functions return the inputs of the force guard and of the moment guard. If `moves` is true, the
  /// guards may move the robot; otherwise the force is set to zero.
  [[nodiscard]] ContactForce pressed(const SetpointLead& lead, bool moves) const;
  [[nodiscard]] ContactForce turned(const SetpointLead& lead, bool moves) const;

 private:
  [[nodiscard]] bool plausible(const RobotState& robot, bool may_hold, double elapsed_s);
  void forget_lies();
  void derive(double elapsed_s);
  void derive_moment(double elapsed_s, bool quiet);
  [[nodiscard]] double touch_nm() const;

  double loop_hz_;
  /// Touch threshold that the guard checks use.
  double touch_bound_n_;
  double touch_nm_, release_nm_;  // minima
  // The robot has a force sensor, and it also measures moments.
  bool force_, moment_;
  SensorWatch watch_;
  ForcePlausibility plausibility_;
  ToolCompensation load_;
  TouchThreshold threshold_;
  TouchThreshold moment_threshold_;  // of the moment as a force at kMomentLever_m
  SlaveContact contact_;
  SlaveContact turn_contact_;

  RobotState before_{};  // last new sample
  std::optional<Time> sampled_at_{};
  ToolKinematics tool_{};
  Twist V_WE_{};
  Wrench F_E_W_{};
  bool ok_ = true;
  // The bias found by the first zeroing was subtracted from the contact force, and from the contact moment.
  bool zeroed_ = false, moment_zeroed_ = false;
};

}  // namespace longreach
