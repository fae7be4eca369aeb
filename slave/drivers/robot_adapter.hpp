#pragma once
// A real robot, connected by its adapter: a program that drives the controller of the robot
// (common/link/adapter_datagram.hpp). If no setpoint arrives, the watchdog of the adapter stops the robot. If
// no datagram arrives from the adapter, or if the adapter reports a failure of the robot, the robot is
// treated as failed. Setpoints are sent only after the robot has reported its position, and only while the
// robot is ok. The adapter reports the wrench along the axes of the tool; read() rotates it into W:
//   F_F_W = R_WE(q) F_E
// The poses of free bodies that the adapter sends are kept until newer ones arrive; their ages grow meanwhile. When the
// adapter restarts, those of its previous session are forgotten.

#include "common/wire/adapter_port.hpp"
#include "schema/config_common.hpp"
#include "slave/kinematics/kinematics.hpp"

namespace longreach {

class RobotAdapter : public Robot {
 public:
  /// `channel` must outlive the object. `session` is a random nonzero number that differs at each start.
  RobotAdapter(Channel& channel, const AdapterConfig& config, const RobotConfig& robot, std::uint64_t session)
      : port_(channel, session, config.silence_s), kinematics_(robot) {}

  /// Returns the content of the newest datagram, with its age. Before the first datagram, the robot is
  /// treated as failed.
  RobotState read(Time now) override;
  [[nodiscard]] BodyPoses tracked_bodies() const override { return bodies_; }
  /// A setpoint that is not finite is ignored and counted; the robot then receives no setpoint.
  void write(const std::optional<JointVector>& joint_setpoint_rad) override;
  void grip(bool closed) override { grip_ = closed; }
  /// Sends an empty datagram so that the adapter replies before the first setpoint.
  void greet() { port_.send({}); }

  [[nodiscard]] const AdapterFigures& figures() const { return port_.figures(); }
  /// Returns whether the watchdog of the adapter has stopped the robot although kLong consecutive setpoints
  /// were sent.
  [[nodiscard]] bool watchdog_stopped() const {
    return moved_ == kLong && (port_.newest().flags & adapter::RobotDatagram::kStopped) != 0;
  }
  [[nodiscard]] std::uint64_t rejected_setpoints() const { return rejected_; }

 private:
  void take_bodies(Time now);

  AdapterPort<adapter::SetpointDatagram, adapter::RobotDatagram, adapter::BodiesDatagram> port_;
  Kinematics kinematics_;
  RobotState measured_{.ok = false};
  BodyPoses bodies_{};
  std::optional<bool> grip_{};  // none: never requested
  static constexpr int kLong = 50;
  int moved_ = 0;  // number of consecutive setpoints, at most kLong
  std::uint64_t rejected_ = 0;
};

}  // namespace longreach
