#pragma once
// Robots in MJCF files (robot.mjcf) for programs that contain MuJoCo: longreach-lab, and tests that call use_mujoco().
// The library and the Python package do not contain it and reject robot.mjcf.

#include <memory>
#include <string>

#include "common/core/random.hpp"
#include "deploy/mujoco/surfaces.hpp"
#include "proto/config_slave.pb.h"
#include "slave/simulation/simulated_robot.hpp"

namespace longreach {

struct MjcfRobots {
  /// Returns the description of the robot in a file. Throws ConfigError with the file and the cause.
  proto::Robot (*describe)(const std::string& file) = nullptr;
  /// Throws ConfigError if the robot of the file robot.mjcf is not the described one, or if the file and the settings do
  /// not fit together. Identifies the contents of the file in robot.basis, so that the hash of the configuration does.
  /// `servo_set`: a person set robot.servo_hz.
  void (*check)(proto::SlaveConfig& config, bool servo_set) = nullptr;
  /// Returns the simulated robot. `random` is for the noise of its sensor. The planes and boxes of config.scene, which an
  /// experiment may add to the surroundings of the file, become MuJoCo's blocks on springs. Throws std::invalid_argument,
  /// UnsuitableScene for other surfaces.
  std::unique_ptr<SimulatedRobot> (*make)(const SlaveConfig& config, Random random) = nullptr;
};

/// Null: the program does not contain MuJoCo.
inline const MjcfRobots* mjcf_robots = nullptr;

/// Sets mjcf_robots. Call it before the first configuration; in the library longreach_laboratory.
void use_mujoco();

}  // namespace longreach
