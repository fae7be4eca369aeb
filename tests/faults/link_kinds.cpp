// What a link does to datagrams without meaning it.

#include <algorithm>
#include <cmath>

#include "tests/faults/world.hpp"

namespace longreach {
namespace {

/// Both ways, or the one of them that was drawn.
template <class Change>
void ways(World& world, const Active& fault, Change&& change) {
  const std::uint64_t which = fault.fault.seed % 3;
  if (which != 1) change(world.levels.up);
  if (which != 2) change(world.levels.down);
}

void lose(World& world, Active& fault) {
  ways(world, fault, [&](ImpairmentConfig& direction) {
    direction.loss = std::max(direction.loss, 0.5 * fault.fault.size);
  });
}
void lose_bursts(World& world, Active& fault) {
  ways(world, fault, [&](ImpairmentConfig& direction) {
    direction.loss = std::max(direction.loss, 0.3 * fault.fault.size);
    direction.loss_burst = std::max(direction.loss_burst, log_scale(fault.fault.size, 2.0, 50.0));
  });
}
void jitter(World& world, Active& fault) {
  ways(world, fault,
       [&](ImpairmentConfig& direction) { direction.jitter_s += log_scale(fault.fault.size, 1e-3, 0.1); });
}
void reorder(World& world, Active& fault) {
  ways(world, fault, [&](ImpairmentConfig& direction) {
    direction.reorder = std::max(direction.reorder, 0.5 * fault.fault.size);
  });
}
void duplicate(World& world, Active& fault) {
  ways(world, fault, [&](ImpairmentConfig& direction) {
    direction.duplicate = std::max(direction.duplicate, 0.2 * fault.fault.size);
  });
}
void corrupt(World& world, Active& fault) {
  ways(world, fault, [&](ImpairmentConfig& direction) {
    direction.corrupt = std::max(direction.corrupt, 0.2 * fault.fault.size);
  });
}
void black_out(World& world, Active&) { world.levels.wire_up.cut = world.levels.wire_down.cut = true; }
void cut_up(World& world, Active&) { world.levels.wire_up.cut = true; }
void cut_down(World& world, Active&) { world.levels.wire_down.cut = true; }
void flicker(World& world, Active& fault) {
  const double period_s = log_scale(fault.fault.size, 0.02, 1.0);
  if (std::fmod(fault.age_s, period_s) < 0.5 * period_s) black_out(world, fault);
}
void step_delay(World& world, Active& fault) {
  ways(world, fault,
       [&](ImpairmentConfig& direction) { direction.delay_s += log_scale(fault.fault.size, 0.5, 3.0); });
}
void narrow(World& world, Active& fault) {
  ways(world, fault, [](ImpairmentConfig& direction) {
    direction.rate_bit_per_s = 64e3;
    direction.queue_s = 2.0;
  });
}
void old_ones_later(World& world, Active& fault) {
  if (fault.fault.seed % 2 == 0) world.levels.wire_up.late = true;
  if (fault.fault.seed % 2 == 1) world.levels.wire_down.late = true;
}

constexpr std::string_view kGroup = "link";
constexpr auto kLink = only(AffectedSignal::kLink);

const FaultKind kKinds[] = {
    {.name = "loss", .group = kGroup, .affects = kLink, .act = lose},
    {.name = "loss-bursts", .group = kGroup, .affects = kLink, .act = lose_bursts},
    {.name = "jitter", .group = kGroup, .affects = kLink, .act = jitter},
    {.name = "reordering", .group = kGroup, .affects = kLink, .act = reorder},
    {.name = "duplication", .group = kGroup, .affects = kLink, .act = duplicate},
    {.name = "corruption", .group = kGroup, .affects = kLink, .act = corrupt},
    {.name = "blackout", .group = kGroup, .affects = kLink, .longest_s = 10.0, .act = black_out},
    {.name = "half-open-up", .group = kGroup, .affects = kLink, .act = cut_up},
    {.name = "half-open-down", .group = kGroup, .affects = kLink, .act = cut_down},
    {.name = "flickering", .group = kGroup, .affects = kLink, .act = flicker},
    {.name = "delay-step", .group = kGroup, .affects = kLink, .longest_s = 10.0, .act = step_delay},
    {.name = "narrow", .group = kGroup, .affects = kLink, .act = narrow},
    {.name = "old-after-outage", .group = kGroup, .affects = kLink, .act = old_ones_later},
};

}  // namespace

std::span<const FaultKind> link_kinds() { return kKinds; }

}  // namespace longreach
