// The step path of a port allocates nothing after its first messages.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "common/wire/memory_channel.hpp"
#include "common/wire/port.hpp"
#include "tests/unit/common/wire/samples.hpp"

namespace {
std::size_t allocations = 0;
}

// noinline: or the compiler pairs this malloc with the library's delete and warns.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }

namespace longreach::allocation_test {
namespace {

TEST(Ports, AllocateNothingAfterTheFirstMessages) {
  MemoryChannelPair channels;
  ImpairmentConfig impairment;
  impairment.delay_s = 0.01;
  impairment.jitter_s = 0.002;
  impairment.duplicate = impairment.corrupt = 0.1;
  MasterPort master(channels.a(), impairment, Random(1));
  SlavePort slave(channels.b(), impairment, Random(2));
  master.follow(samples::session(1));
  slave.follow(samples::session(1));
  const MotionCommand commands[] = {samples::command(), samples::turn(), samples::extreme_command()};
  const std::vector<std::byte> garbage(508, std::byte{0xee});
  const auto exchange = [&](std::uint64_t from, std::uint64_t to) {
    for (std::uint64_t i = from; i < to; ++i) {
      const Time now{std::chrono::milliseconds(i)};
      master.send(now, i, commands[i % 3]);
      slave.send(now, i, i % 2 == 0 ? samples::report() : samples::extreme_report());
      slave.send(now, i, i % 2 == 0 ? samples::telemetry() : samples::extreme_telemetry());
      slave.send(now, i, i % 2 == 0 ? samples::body_poses() : samples::extreme_body_poses());
      channels.a().send(garbage);
      master.receive(now);
      slave.receive(now);
    }
  };
  exchange(1, 100);
  const std::size_t before = allocations;
  exchange(100, 600);
  master.follow(samples::session(2));
  slave.follow(samples::session(2));
  exchange(600, 1000);
  EXPECT_EQ(allocations - before, 0u);
  EXPECT_GT(master.accepted_total(), 1000u);
  EXPECT_GT(slave.accepted_total(), 700u);
}

}  // namespace
}  // namespace longreach::allocation_test
