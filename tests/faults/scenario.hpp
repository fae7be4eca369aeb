#pragma once
// Scenario of a run, drawn from the seed: robot, scene, device, link, limits and behaviour of the operator.

#include <cstdint>
#include <string>
#include <vector>

#include "common/core/time.hpp"
#include "common/spatial/spatial.hpp"
#include "master/config/master_config.hpp"
#include "proto/config.pb.h"
#include "slave/config/slave_config.hpp"

namespace longreach {

struct Scenario {
  proto::LabConfig config{};  // complete configuration
  MasterConfig master{};
  SlaveConfig slave{};
  /// Settings of the scenario, in the form accepted by `longreach-lab run --set`.
  std::vector<std::string> settings;
  /// The configuration of the slave has no scene; the plant has that of `slave`.
  bool empty_scene = false;
  double round_trip_s = 0.0;  // round-trip time of the link without faults
  bool metamorphic = false;   // the link has no random jitter, loss or reordering
};

/// Offsets of the two clocks at the start of a run.
struct Clocks {
  Duration slave_ahead{0}, master_ahead{0};
};

Scenario draw_scenario(std::uint64_t seed);

/// Returns the pose of the tool in W at the start.
Pose start_pose(const Scenario& scenario);

}  // namespace longreach
