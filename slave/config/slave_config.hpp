#pragma once
// Parameters of the slave, and values that follow from them.

#include <algorithm>

#include "slave/config/command_config.hpp"
#include "slave/config/sensing_config.hpp"

namespace longreach {

/// Returns the timeout of the gap timer for a master that sends `send_hz` times per second, s.
inline double gap_s(const SlaveSafetyConfig& c, double send_hz) {
  return c.gap_s > 0.0 ? c.gap_s : std::clamp(30.0 / send_hz, 0.1, 2.0);
}

}  // namespace longreach
