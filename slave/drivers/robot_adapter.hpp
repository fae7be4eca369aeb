#pragma once
// A real robot behind its adapter: the program that speaks to its controller
// (common/link/adapter_datagram.hpp). Its own watchdog stops the robot when this side is silent; silence of
// the adapter, or its word that the robot has failed, is a fault here. No setpoint leaves before the robot
// has said where it is, nor while it is not ok.
//   F_F_W = R_WE(q) F_E: the adapter tells the wrench along the axes of the tool

#include "common/link/adapter_config.hpp"
#include "common/wire/adapter_port.hpp"
#include "slave/kinematics/kinematics.hpp"

namespace longreach {

class RobotAdapter : public Robot {
 public:
  /// `channel` must outlive it. `session`: drawn anew at each start, not 0.
  RobotAdapter(Channel& channel, const AdapterConfig& config, const RobotConfig& robot, std::uint64_t session)
      : port_(channel, session, config.silence_s), kinematics_(robot) {}

  /// What the newest datagram says, at the time when it has come. Before the first: a robot that has failed.
  RobotState read(Time now) override;
  /// A setpoint that is not finite is ignored and counted: the joints rest.
  void write(const std::optional<JointVector>& joint_setpoint_rad) override;
  void grip(bool closed) override { grip_ = closed; }
  /// Tells the adapter that somebody is there, before the first setpoint.
  void greet() { port_.send({}); }

  [[nodiscard]] const AdapterFigures& figures() const { return port_.figures(); }
  /// Though it has been sent setpoints for a while.
  [[nodiscard]] bool watchdog_stopped() const {
    return moved_ == kLong && (port_.newest().flags & adapter::RobotDatagram::kStopped) != 0;
  }
  [[nodiscard]] std::uint64_t rejected_setpoints() const { return rejected_; }

 private:
  AdapterPort<adapter::SetpointDatagram, adapter::RobotDatagram> port_;
  Kinematics kinematics_;
  RobotState measured_{.ok = false};
  std::optional<bool> grip_{};  // none: nobody has asked
  static constexpr int kLong = 50;
  int moved_ = 0;  // setpoints on end, kLong at most
  std::uint64_t rejected_ = 0;
};

}  // namespace longreach
