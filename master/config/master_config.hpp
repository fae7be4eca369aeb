#pragma once
// Parameters of the master, and values that follow from them.

#include <algorithm>

#include "master/config/rendering_config.hpp"

namespace longreach {

/// Returns the rate at which commands are sent, Hz: the requested rate, limited by the bandwidth budget. A
/// datagram counts as 128 bytes, headers included.
inline double sent_hz(const MasterLinkConfig& link) {
  constexpr double kbit = 1e-3 * 8.0 * 128.0;
  return link.budget_kbit_per_s > 0.0 ? std::min(link.send_hz, link.budget_kbit_per_s / kbit) : link.send_hz;
}

}  // namespace longreach
