#pragma once
// A real robot, connected by its adapter, the program that drives its controller
// (common/link/adapter_datagram.hpp). The watchdog of the adapter stops the robot when this side is silent;
// silence of the adapter, or a reported failure of the robot, is a fault of this side. No setpoint is sent
// before the robot has reported its position, nor while it is not ok.
//   F_F_W = R_WE(q) F_E: the adapter reports the wrench along the axes of the tool

#include "common/link/adapter_config.hpp"
#include "common/wire/adapter_port.hpp"
#include "slave/kinematics/kinematics.hpp"

namespace longreach {

class RobotAdapter : public Robot {
 public:
  /// `channel` must outlive it. `session`: random at each start, not 0.
  RobotAdapter(Channel& channel, const AdapterConfig& config, const RobotConfig& robot, std::uint64_t session)
      : port_(channel, session, config.silence_s), kinematics_(robot) {}

  /// Returns the content of the newest datagram, with its time of arrival. Before the first datagram: a
  /// failed robot.
  RobotState read(Time now) override;
  /// A setpoint that is not finite is ignored and counted: the joints rest.
  void write(const std::optional<JointVector>& joint_setpoint_rad) override;
  void grip(bool closed) override { grip_ = closed; }
  /// Contacts the adapter before the first setpoint.
  void greet() { port_.send({}); }

  [[nodiscard]] const AdapterFigures& figures() const { return port_.figures(); }
  /// Although setpoints have been sent for a while.
  [[nodiscard]] bool watchdog_stopped() const {
    return moved_ == kLong && (port_.newest().flags & adapter::RobotDatagram::kStopped) != 0;
  }
  [[nodiscard]] std::uint64_t rejected_setpoints() const { return rejected_; }

 private:
  AdapterPort<adapter::SetpointDatagram, adapter::RobotDatagram> port_;
  Kinematics kinematics_;
  RobotState measured_{.ok = false};
  std::optional<bool> grip_{};  // none: not requested
  static constexpr int kLong = 50;
  int moved_ = 0;  // consecutive setpoints, at most kLong
  std::uint64_t rejected_ = 0;
};

}  // namespace longreach
