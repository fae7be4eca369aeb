#pragma once
// Scenario of a run: robot, scene, device, link, limits and behaviour of the operator, drawn from the seed.

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
  proto::LabConfig config{};  // complete
  MasterConfig master{};
  SlaveConfig slave{};
  std::vector<std::string> settings;  // as accepted by `longreach-lab run --set`
  double round_trip_s = 0.0;          // of the link without faults
  bool metamorphic = false;           // the link of the scenario is not random
};

/// Offsets of the clocks of both sides at the start of a run.
struct Clocks {
  Duration slave_ahead{0}, master_ahead{0};
};

Scenario draw_scenario(std::uint64_t seed);

/// Pose of the tool in W at the start.
Pose start_pose(const Scenario& scenario);

}  // namespace longreach
