#pragma once
// The draws of the campaign `idle`: devices, poses, grips, modes, delays, walls.

#include <vector>

#include "deploy/lab/rendering/idle_draw.hpp"
#include "proto/config.pb.h"

namespace longreach {

/// The complete master configurations of the device files.
std::vector<MasterConfig> idle_masters(const proto::LabConfig& config);

/// The draw with this number: equal for equal seed and number.
IdleDraw draw_idle(const std::vector<MasterConfig>& masters, std::uint64_t seed, std::size_t number);

}  // namespace longreach
