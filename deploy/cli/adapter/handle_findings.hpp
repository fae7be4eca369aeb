#pragma once
// Evaluates the handle states that a device adapter reported during the check: jumps, and with a device file
// the distance from home, compared with the workspace. Pure function.

#include <cstdint>
#include <optional>
#include <vector>

#include "common/link/adapter_datagram.hpp"
#include "deploy/cli/finding.hpp"
#include "schema/config_master.hpp"

namespace longreach {

struct SeenHandle {
  std::int64_t at_ns = 0;
  adapter::HandleDatagram handle{};
};

/// Returns one finding about jumps and, if `device` is given, one about the workspace. `seen` is in the order of
/// arrival.
std::vector<Finding> handle_findings(const std::vector<SeenHandle>& seen,
                                     const std::optional<DeviceConfig>& device);

/// Reads a device file. Throws UsageError.
DeviceConfig described_device(const std::string& file);

}  // namespace longreach
