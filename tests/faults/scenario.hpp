#pragma once
// Where a run takes place: robot, scene, device, link, limits and the operator's habits, drawn from the seed.

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
  std::vector<std::string> settings;  // as `longreach-lab run --set` takes them
  double round_trip_s = 0.0;          // of the link while nothing is wrong
  bool metamorphic = false;           // nothing of its link is drawn
};

/// What the clocks of both sides show when a run begins, beyond what they show otherwise.
struct Clocks {
  Duration slave_ahead{0}, master_ahead{0};
};

Scenario draw_scenario(std::uint64_t seed);

/// Of the tool, in W, where the robot starts.
Pose start_pose(const Scenario& scenario);

}  // namespace longreach
