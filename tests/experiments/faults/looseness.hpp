#pragma once
// Which limit is looser than at the start, by a list of what weakens a guard that is the oracle's own.

#include <string>

#include "master/master_config.hpp"
#include "slave/slave_config.hpp"

namespace longreach {

/// Empty: none.
std::string looser(const SlaveConfig& start, const SlaveConfig& now);
std::string looser(const MasterConfig& start, const MasterConfig& now);

}  // namespace longreach
