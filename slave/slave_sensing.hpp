#pragma once
// What the robot's force sensor says: each sample is judged (sensor_watch.hpp), tool, load and bias are taken
// out (tool_load.hpp), contacts are found in what is left (contact.hpp), and the force is doubted where it
// does not behave like one (force_plausibility.hpp). What a sensor that was found to lie has made of surfaces is
// forgotten.

#include <optional>

#include "slave/command/force_plausibility.hpp"
#include "slave/command/setpoint_lead.hpp"
#include "slave/config/slave_config.hpp"
#include "slave/estimation/contact.hpp"
#include "slave/kinematics/kinematics.hpp"
#include "slave/sensing/sensor_watch.hpp"
#include "slave/sensing/tool_load.hpp"

namespace longreach {

/// What is done while it is felt.
struct SensingInput {
  SafetyState state = SafetyState::kIdle;
  bool let_go = false;  // nobody holds the handle
  bool still = false;   // the setpoint stands, and the tool is there
  double scale = 1.0;   // k_scale as last sent
  double played_sequence = 0.0, played_turn_sequence = 0.0;
  double news_age_s = 0.0;  // of what the operator knew of this side when the goal was commanded
  Clamps clamps{};          // of the last step
  Quaternion q_anchor = Quaternion::Identity();
  double dt = 0.0;  // s
};

class SlaveSensing {
 public:
  explicit SlaveSensing(const SlaveConfig& config);
  void configure(const SlaveConfig& config);

  /// Judges what the robot says, before anything believes it. A sample that repeats the one before while the
  /// arm moves is none.
  void update(const RobotState& robot, const Kinematics& arm, bool may_hold, Time now);
  void step(const SensingInput& input);
  /// Of an engagement that begins, from where the rotations were counted before.
  void begin(const Quaternion& q_before, const Quaternion& q_anchor);
  void zero() { load_.zero(); }

  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] bool ready() const { return load_.ready(); }
  [[nodiscard]] bool free() const { return !contact_.in_contact() && !turn_contact_.in_contact(); }
  [[nodiscard]] const Pose& X_WE() const { return tool_.X_WE; }  // measured
  [[nodiscard]] const Wrench& F_E_W() const { return F_E_W_; }   // without tool, load and bias
  [[nodiscard]] const LoadIdentifier& load() const { return load_.load(); }
  [[nodiscard]] const ForcePlausibility& plausibility() const { return plausibility_; }
  SlaveContact& contact() { return contact_; }
  SlaveContact& turn_contact() { return turn_contact_; }  // places are rotation vectors from the anchor, in W

  /// What the guards know, of the force and of the moment. `moves`: the reflexes may move the robot; else
  /// there is no force for them.
  [[nodiscard]] ContactForce pressed(const SetpointLead& lead, bool moves) const;
  [[nodiscard]] ContactForce turned(const SetpointLead& lead, bool moves) const;

 private:
  [[nodiscard]] bool plausible(const RobotState& robot, bool may_hold, double elapsed_s);
  void forget_lies();

  double loop_hz_;
  NeedsConfig needs_;  // what is not needed of contact, sensor and estimator is not there
  SensorWatch watch_;
  ForcePlausibility plausibility_;
  ToolCompensation load_;
  SlaveContact contact_;
  SlaveContact turn_contact_;

  RobotState before_{};  // its last sample that was a new one
  std::optional<Time> sampled_at_{};
  ToolKinematics tool_{};
  Twist V_WE_{};
  Wrench F_E_W_{};
  bool ok_ = true;
};

}  // namespace longreach
