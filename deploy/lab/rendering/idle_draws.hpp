#pragma once
// The random cases of the campaign `idle`: device, pose, grip, mode, delay and wall.

#include <vector>

#include "deploy/lab/rendering/idle_draw.hpp"
#include "proto/config.pb.h"

namespace longreach {

/// Returns the complete master configuration for each device file.
std::vector<MasterConfig> idle_masters(const proto::LabConfig& config);

/// Returns the random case with this number. The case depends only on the arguments.
IdleDraw draw_idle(const std::vector<MasterConfig>& masters, std::uint64_t seed, std::size_t number);

}  // namespace longreach
