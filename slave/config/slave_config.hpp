#pragma once
// All parameters of the slave as plain values. proto/config.proto documents the meaning, unit, default and
// range of these fields under the same names.

#include <algorithm>
#include <cstdint>
#include <string>

#include "common/core/loop_config.hpp"
#include "common/link/adapter_config.hpp"
#include "common/link/impairment.hpp"
#include "common/link/playout.hpp"
#include "slave/config/command_config.hpp"
#include "slave/config/estimator_config.hpp"
#include "slave/config/robot_config.hpp"
#include "slave/config/scene_config.hpp"
#include "slave/config/sensing_config.hpp"

namespace longreach {

struct SlaveLinkConfig {
  std::string listen = "127.0.0.1:47001";
  double telemetry_hz = 30.0;
  double heartbeat_contact_hz = 4.0;
  double heartbeat_free_hz = 2.0;
  ImpairmentConfig impairment{};
  double budget_kbit_per_s = 0.0;
};

struct SlaveSafetyConfig {
  double gap_s = 0.0;
  double age_max_s = 30.0;
  double resume_s = 1.0;
  double delay_rise_max_s = 1.0;
};

/// Returns the timeout of the gap timer for a master that sends `send_hz` times per second, s.
inline double gap_s(const SlaveSafetyConfig& c, double send_hz) {
  return c.gap_s > 0.0 ? c.gap_s : std::clamp(30.0 / send_hz, 0.1, 2.0);
}

struct SlaveConfig {
  SlaveLinkConfig link{};
  LoopConfig loop{};
  PlayoutConfig playout{};
  CommandConfig command{};
  std::string robot_file = "robots/space_arm.txtpb";
  RobotConfig robot{};
  std::string scene_file = "scenes/wall.txtpb";
  SceneConfig scene{};
  SensingConfig sensing{};
  EstimatorConfig estimator{};
  SlaveSafetyConfig safety{};
  RpcServerConfig rpc{};
  Accuracy accuracy = Accuracy::kBalanced;
  AdapterConfig robot_adapter{};
};

}  // namespace longreach
