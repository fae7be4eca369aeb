// Any datagrams at both sides, from somebody without the key: nothing is accepted, nothing changes but
// counters. Input: (side, length in two bytes, datagram) after each other.

#include "common/wire/memory_channel.hpp"
#include "common/wire/port.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/unit/common/wire/samples.hpp"

namespace longreach::fuzz {
namespace {

struct Sides {
  Sides() {
    master.follow(samples::session());
    slave.follow(samples::session());
    for (std::uint64_t i = 1; i < 10; ++i) {
      now = Time{std::chrono::milliseconds(i)};
      master.send(now, i, samples::command());
      slave.receive(now);
      slave.send(now, i, samples::report());
      master.receive(now);
    }
    master_before = master.endpoint();
    slave_before = slave.endpoint();
    accepted = master.accepted_total() + slave.accepted_total();
    require(accepted == 18, "the two sides understand each other");
  }

  MemoryChannelPair channels{64};
  MasterPort master{channels.a(), ImpairmentConfig{}, Random(1)};
  SlavePort slave{channels.b(), ImpairmentConfig{}, Random(2)};
  Time now{};
  Endpoint master_before, slave_before;
  std::uint64_t accepted = 0;
};

}  // namespace
}  // namespace longreach::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace longreach;
  using fuzz::require;
  static fuzz::Sides sides;
  const std::uint64_t before = sides.master.rejected_total() + sides.slave.rejected_total();
  std::uint64_t sent = 0;
  auto rest = std::as_bytes(std::span(bytes, size));
  for (; rest.size() >= 3 && sent < 32; ++sent) {
    const bool to_slave = (rest[0] & std::byte{1}) == std::byte{0};
    const auto datagram = rest.subspan(3, std::min(fuzz::length_of(rest.subspan(1)), rest.size() - 3));
    (to_slave ? sides.channels.a() : sides.channels.b()).send(datagram);
    rest = rest.subspan(3 + datagram.size());
  }
  sides.slave.receive(sides.now);
  sides.master.receive(sides.now);
  require(sides.master.accepted_total() + sides.slave.accepted_total() == sides.accepted,
          "nothing is accepted");
  require(sides.master.rejected_total() + sides.slave.rejected_total() == before + sent,
          "all of it is counted");
  static int inputs = 0;  // what has changed stays so, and comparing takes its time
  if (++inputs % 256 != 0) return 0;
  require(sides.master.endpoint() == sides.master_before, "the master's state is unchanged");
  require(sides.slave.endpoint() == sides.slave_before, "the slave's state is unchanged");
  return 0;
}
