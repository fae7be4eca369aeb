#include "tests/faults/kind.hpp"

#include <algorithm>
#include <cmath>

#include "common/config/config.hpp"

namespace longreach {

double log_scale(double size, double low, double high) { return low * std::pow(high / low, size); }

const std::vector<FaultKind>& fault_kinds() {
  static const std::vector<FaultKind> all = [] {
    std::vector<FaultKind> kinds;
    for (const auto& group : {datagram_kinds, link_kinds, time_kinds, value_kinds, operator_kinds,
                              sensor_kinds, robot_kinds, device_kinds, contact_kinds}) {
      kinds.insert(kinds.end(), group().begin(), group().end());
    }
    return kinds;
  }();
  return all;
}

std::size_t fault_kind(std::string_view name) {
  const auto& all = fault_kinds();
  const auto at = std::ranges::find(all, name, &FaultKind::name);
  if (at == all.end()) throw ConfigError("there is no kind of fault '" + std::string(name) + "'");
  return static_cast<std::size_t>(at - all.begin());
}

}  // namespace longreach
