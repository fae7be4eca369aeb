// Operators, masters and clients that ask for things at any time.

#include <array>
#include <limits>
#include <span>
#include <string>

#include "common/text/number_text.hpp"
#include "tests/faults/looseness.hpp"
#include "tests/faults/world.hpp"

namespace longreach {
namespace {

bool often(World& world, Active& fault) {
  return fault.begins ||
         fault.random.chance(log_scale(fault.fault.size, 0.1, 10.0) * world.moment().period_s);
}

void hold(World& world, Active& fault) { world.requests.hold = often(world, fault); }
void stop(World& world, Active& fault) { world.requests.stop = often(world, fault); }
void stop_here(World& world, Active& fault) { world.stop_slave = often(world, fault); }
void engage(World& world, Active& fault) {
  world.requests.engage = often(world, fault) || world.requests.engage;
}
void impatience(World& world, Active&) { world.levels.impatient = true; }
void all_at_once(World& world, Active& fault) {
  if (!often(world, fault)) return;
  world.requests.hold = fault.random.chance(0.5);
  world.requests.stop = fault.random.chance(0.5);
  world.requests.engage = fault.random.chance(0.5);
  world.stop_slave = fault.random.chance(0.3);
}
void change_mode(World& world, Active& fault) {
  if (often(world, fault))
    world.requests.mode = fault.random.chance(0.5) ? MotionMode::kRate : MotionMode::kPosition;
}
void change_scale(World& world, Active& fault) {
  if (often(world, fault)) world.requests.scale = fault.random.uniform(0.05, 1.0);
}
void impossible_scale(World& world, Active& fault) {
  constexpr std::array kScales = {0.0, -1.0, 1e300, 2.0, 0.049999, std::numeric_limits<double>::quiet_NaN()};
  if (often(world, fault)) world.requests.scale = kScales[fault.random.next() % kScales.size()];
}
void clutch(World& world, Active&) { world.levels.clutch = true; }
void let_go(World& world, Active&) { world.levels.let_go = true; }
void load(World& world, Active& fault) {
  if (often(world, fault)) world.requests.grip = fault.random.chance(0.5);
}
/// Another master takes the robot, and returns it.
void take(World& world, Active& fault) {
  if (fault.begins) world.lease(false);
}
void give_back(World& world, Active&) { world.lease(true); }
/// The master has begun anew, and has a new session.
void renew(World& world, Active& fault) {
  if (fault.begins) world.lease(true);
}

std::string wild_value(Random& random) {
  constexpr std::array kValues = {"0",      "-1",   "nan",     "inf",  "1,0,0",
                                  "IGNORE", "HOLD", "ARRIVAL", "true", "NAIVE"};
  return random.chance(0.2) ? kValues[random.next() % kValues.size()]
                            : format_number(log_scale(random.uniform(), 1e-3, 1e6));
}
/// A limit, or what is none and still not for clients.
const char* any(Random& random, std::span<const GuardedField> limits, std::span<const char* const> more) {
  const std::size_t at = random.next() % (limits.size() + more.size());
  return at < limits.size() ? limits[at].path.c_str() : more[at - limits.size()];
}
/// A client asks for everything that would loosen a limit, of whoever runs.
void loosen_slave(World& world, Active& fault) {
  constexpr std::array kMore = {"robot.servo_hz", "playout.quantile"};
  if (often(world, fault))
    world.set_slave(any(fault.random, slave_limits(), kMore), wild_value(fault.random));
}
void loosen_hand(World& world, Active& fault) {
  constexpr std::array kMore = {"mapping.kv_per_s", "mapping.radius_max_m"};
  if (often(world, fault))
    world.set_master(any(fault.random, master_limits(), kMore), wild_value(fault.random));
}
/// Tighter, while it moves.
void tighten(World& world, Active& fault) {
  if (!fault.begins) return;
  const CommandConfig& c = world.scenario().slave.command;
  const double by = fault.random.uniform(0.5, 1.0);
  world.set_slave("command.speed_max_m_per_s", format_number(by * c.speed_max_m_per_s));
  world.set_slave("command.speed_max_rad_per_s", format_number(by * c.speed_max_rad_per_s));
  world.set_slave("command.force_guard_n", format_number(by * c.force_guard_n));
}

constexpr std::string_view kGroup = "operator, session, configuration";
constexpr auto kOperator = only(AffectedSignal::kOperator);
constexpr auto kLease = AffectedSignal::kOperator | AffectedSignal::kLease;

const FaultKind kKinds[] = {
    {.name = "holds", .group = kGroup, .affects = kOperator, .longest_s = 2.0, .act = hold},
    {.name = "stops", .group = kGroup, .affects = kOperator, .longest_s = 2.0, .act = stop},
    {.name = "stops-at-slave", .group = kGroup, .affects = kOperator, .longest_s = 2.0, .act = stop_here},
    {.name = "engages", .group = kGroup, .affects = kOperator, .act = engage},
    {.name = "impatience", .group = kGroup, .affects = kOperator, .act = impatience},
    {.name = "all-requests-at-once",
     .group = kGroup,
     .affects = kOperator,
     .longest_s = 2.0,
     .act = all_at_once},
    {.name = "modes", .group = kGroup, .act = change_mode},
    {.name = "scales", .group = kGroup, .act = change_scale},
    {.name = "impossible-scales", .group = kGroup, .act = impossible_scale},
    {.name = "clutch", .group = kGroup, .act = clutch},
    {.name = "hand-let-go", .group = kGroup, .affects = kOperator, .act = let_go},
    {.name = "load", .group = kGroup, .act = load},
    {.name = "robot-taken",
     .group = kGroup,
     .affects = kLease,
     .longest_s = 3.0,
     .act = take,
     .end = give_back},
    {.name = "session-renewed", .group = kGroup, .affects = kLease, .longest_s = 0.5, .act = renew},
    {.name = "limits-loosened", .group = kGroup, .act = loosen_slave},
    {.name = "hand-limits-loosened", .group = kGroup, .act = loosen_hand},
    {.name = "limits-tightened", .group = kGroup, .act = tighten},
};

}  // namespace

std::span<const FaultKind> operator_kinds() { return kKinds; }

}  // namespace longreach
