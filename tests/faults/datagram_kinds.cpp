// What somebody on the wire can do who knows all but the secret: make datagrams of what was heard, repeat
// them, keep them back.

#include <array>
#include <variant>

#include "common/link/header.hpp"
#include "tests/faults/world.hpp"

namespace longreach {
namespace {

std::size_t below(Random& random, std::size_t end) { return static_cast<std::size_t>(random.next() % end); }

/// One of what went this way.
std::optional<Bytes> heard(const WireDirection& direction, Random& random) {
  if (direction.heard().empty()) return std::nullopt;
  return direction.heard()[below(random, direction.heard().size())];
}

void set_sequence(Bytes& datagram, std::uint64_t ahead) {
  if (datagram.size() < kHeaderBytes) return;
  const auto header = read_header(datagram);
  if (!std::holds_alternative<Header>(header)) return;
  Header changed = std::get<Header>(header);
  changed.sequence += ahead;
  write_header(changed, datagram);
}

/// Makes a datagram of one that was heard, from 1 to 1000 times a second, to either side.
template <void (*Change)(World&, Random&, Bytes&)>
void add(World& world, Active& fault) {
  const double a_tick = log_scale(fault.fault.size, 1.0, 1000.0) * world.moment().period_s;
  if (!fault.random.chance(a_tick)) return;
  WireDirection& direction = fault.random.chance(0.5) ? world.up() : world.down();
  std::optional<Bytes> datagram = heard(direction, fault.random);
  if (!datagram) return;
  Change(world, fault.random, *datagram);
  direction.inject(std::move(*datagram));
}

void forge(World&, Random& random, Bytes& datagram) {
  set_sequence(datagram, 1 + below(random, 100000));
  for (std::size_t i = kHeaderBytes; i < datagram.size(); ++i)
    datagram[i] = static_cast<std::byte>(random.next());
}
void flip(World&, Random& random, Bytes& datagram) {
  datagram[below(random, datagram.size())] ^= std::byte{1} << below(random, 8);
}
void flip_a_new_one(World&, Random& random, Bytes& datagram) {
  set_sequence(datagram, 1 + below(random, 1000));
  datagram[kHeaderBytes + below(random, datagram.size() - kHeaderBytes)] ^= std::byte{1} << below(random, 8);
}
void repeat(World&, Random&, Bytes&) {}
void reflect(World& world, Random& random, Bytes& datagram) {
  // What a side has sent comes back to it, as it is or under the other type.
  const bool to_slave = datagram[1] == static_cast<std::byte>(DatagramType::kMotionCommand);
  const std::optional<Bytes> own = heard(to_slave ? world.down() : world.up(), random);
  const std::byte type = datagram[1];
  if (own) datagram = *own;
  if (random.chance(0.5)) datagram[1] = type;
}
void lead(World&, Random& random, Bytes& datagram) {
  set_sequence(datagram, 1 + below(random, std::size_t{1} << 40));
}
void cut_short(World&, Random& random, Bytes& datagram) { datagram.resize(below(random, datagram.size())); }
void empty(World&, Random&, Bytes& datagram) { datagram.clear(); }
void lengthen(World&, Random& random, Bytes& datagram) {
  datagram.resize(kDatagramMaxBytes + 1 + below(random, 1000), std::byte{0x5a});
}
void of_another_version(World&, Random& random, Bytes& datagram) {
  datagram[0] = static_cast<std::byte>(kWireVersion + 1 + below(random, 200));
}
void of_another_type(World&, Random& random, Bytes& datagram) {
  datagram[1] = static_cast<std::byte>(kDatagramTypes + 1 + below(random, 200));
}
void of_another_session(World&, Random& random, Bytes& datagram) {
  for (std::size_t i = 2; i < 10; ++i) datagram[i] = static_cast<std::byte>(random.next());
}

void from_past_life(World& world, Active& fault) {
  if (!fault.random.chance(0.3)) return;
  Bytes datagram = world.past_life()[below(fault.random, world.past_life().size())];
  // Under the number of the session that is there now, or of the one that it was of.
  const std::optional<Bytes> now = heard(world.up(), fault.random);
  if (now && fault.random.chance(0.5)) std::copy_n(now->begin() + 2, 8, datagram.begin() + 2);
  world.up().inject(std::move(datagram));
}

/// 200,000 a second.
void flood(World& world, Active& fault) {
  const auto a_tick = static_cast<int>(2e5 * world.moment().period_s);
  for (int i = 0; i < a_tick; ++i) {
    std::optional<Bytes> datagram = heard(world.up(), fault.random);
    if (!datagram) return;
    if (i % 2 == 0) forge(world, fault.random, *datagram);
    world.up().inject(std::move(*datagram));
  }
}

void hold_up(World& world, Active&) { world.levels.wire_up.held = true; }
void hold_down(World& world, Active&) { world.levels.wire_down.held = true; }
void hold_both(World& world, Active& fault) {
  hold_up(world, fault);
  hold_down(world, fault);
}
void delay_up(World& world, Active& fault) {
  world.levels.wire_up.delay_s += log_scale(fault.fault.size, 0.05, 25.0);
}
void delay_down(World& world, Active& fault) {
  world.levels.wire_down.delay_s += log_scale(fault.fault.size, 0.05, 25.0);
}
/// Slower than any clock drifts, quicker than any orbit.
void creep_up(World& world, Active& fault) {
  world.levels.wire_up.delay_s += fault.age_s * log_scale(fault.fault.size, 0.01, 0.9);
}
void twice(World& world, Active&) { world.levels.wire_up.copies = world.levels.wire_down.copies = 1; }
void swap(World& world, Active&) { world.levels.wire_up.swapped = world.levels.wire_down.swapped = true; }

constexpr std::string_view kGroup = "datagrams";
constexpr auto kLate = only(AffectedSignal::kLink);

const FaultKind kKinds[] = {
    {.name = "forged", .group = kGroup, .act = add<forge>},
    {.name = "bit-flipped", .group = kGroup, .act = add<flip>},
    {.name = "bit-flipped-new", .group = kGroup, .act = add<flip_a_new_one>},
    {.name = "replayed", .group = kGroup, .act = add<repeat>},
    {.name = "replayed-past-session", .group = kGroup, .act = from_past_life},
    {.name = "reflected", .group = kGroup, .act = add<reflect>},
    {.name = "leading-sequence", .group = kGroup, .act = add<lead>},
    {.name = "truncated", .group = kGroup, .act = add<cut_short>},
    {.name = "empty", .group = kGroup, .act = add<empty>},
    {.name = "oversized", .group = kGroup, .act = add<lengthen>},
    {.name = "unknown-version", .group = kGroup, .act = add<of_another_version>},
    {.name = "unknown-type", .group = kGroup, .act = add<of_another_type>},
    {.name = "unknown-session", .group = kGroup, .act = add<of_another_session>},
    {.name = "flood", .group = kGroup, .affects = kLate, .longest_s = 0.1, .act = flood},
    {.name = "held-up-burst", .group = kGroup, .affects = kLate, .act = hold_up},
    {.name = "held-down-burst", .group = kGroup, .affects = kLate, .act = hold_down},
    {.name = "held-burst", .group = kGroup, .affects = kLate, .act = hold_both},
    {.name = "delayed-up", .group = kGroup, .affects = kLate, .longest_s = 15.0, .act = delay_up},
    {.name = "delayed-down", .group = kGroup, .affects = kLate, .longest_s = 15.0, .act = delay_down},
    {.name = "delay-creeps", .group = kGroup, .affects = kLate, .longest_s = 15.0, .act = creep_up},
    {.name = "every-datagram-twice", .group = kGroup, .act = twice},
    {.name = "swapped", .group = kGroup, .act = swap},
};

}  // namespace

std::span<const FaultKind> datagram_kinds() { return kKinds; }

}  // namespace longreach
