// A side that does not run when it should, and clocks that do not go alike. What comes meanwhile lies in its
// socket; robot, hand and the other side go on.

#include "tests/faults/world.hpp"

namespace longreach {
namespace {

void freeze_slave(World& world, Active&) { world.levels.slave_skips_tick = true; }
void freeze_master(World& world, Active&) { world.levels.master_skips_tick = true; }
void freeze_both(World& world, Active& fault) {
  freeze_slave(world, fault);
  freeze_master(world, fault);
}

/// One tick after the other is late by up to 5 periods: single ones, or half of all.
bool late(Active& fault) {
  if (fault.count > 0) {
    --fault.count;
    return true;
  }
  if (fault.random.chance(0.02 + 0.48 * fault.fault.size)) fault.count = 1 + fault.random.next() % 5;
  return false;
}
void late_slave(World& world, Active& fault) {
  world.levels.slave_skips_tick = late(fault) || world.levels.slave_skips_tick;
}
void late_master(World& world, Active& fault) {
  world.levels.master_skips_tick = late(fault) || world.levels.master_skips_tick;
}
/// Every tick comes late, so that there are half, a third ... of them.
void slow_slave(World& world, Active& fault) {
  const std::uint64_t of = 2 + static_cast<std::uint64_t>(3.0 * fault.fault.size);
  if (fault.count++ % of != 0) world.levels.slave_skips_tick = true;
}
void slow_master(World& world, Active& fault) {
  const std::uint64_t of = 2 + static_cast<std::uint64_t>(3.0 * fault.fault.size);
  if (fault.count++ % of != 0) world.levels.master_skips_tick = true;
}
void drift_slave(World& world, Active& fault) {
  world.levels.slave_ppm += 500.0 * (2.0 * fault.fault.size - 1.0);
}
void drift_master(World& world, Active& fault) {
  world.levels.master_ppm += 500.0 * (2.0 * fault.fault.size - 1.0);
}

constexpr std::string_view kGroup = "time";
constexpr auto kSlave = only(AffectedSignal::kSlaveTime);
constexpr auto kMaster = only(AffectedSignal::kMasterTime);

const FaultKind kKinds[] = {
    {.name = "slave-frozen", .group = kGroup, .affects = kSlave, .longest_s = 10.0, .act = freeze_slave},
    {.name = "master-frozen", .group = kGroup, .affects = kMaster, .longest_s = 10.0, .act = freeze_master},
    {.name = "both-frozen",
     .group = kGroup,
     .affects = AffectedSignal::kSlaveTime | AffectedSignal::kMasterTime,
     .longest_s = 10.0,
     .act = freeze_both},
    {.name = "slave-ticks-late", .group = kGroup, .affects = kSlave, .act = late_slave},
    {.name = "master-ticks-late", .group = kGroup, .affects = kMaster, .act = late_master},
    {.name = "slave-slow", .group = kGroup, .affects = kSlave, .act = slow_slave},
    {.name = "master-slow", .group = kGroup, .affects = kMaster, .act = slow_master},
    {.name = "slave-clock-drifts", .group = kGroup, .longest_s = 15.0, .act = drift_slave},
    {.name = "master-clock-drifts", .group = kGroup, .longest_s = 15.0, .act = drift_master},
};

}  // namespace

std::span<const FaultKind> time_kinds() { return kKinds; }

}  // namespace longreach
