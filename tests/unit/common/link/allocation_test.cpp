// Nothing on the step path of the link allocates after construction.

#include <gtest/gtest.h>

#include <cstdlib>
#include <new>
#include <vector>

#include "common/link/endpoint.hpp"
#include "common/link/header.hpp"
#include "common/link/impairment.hpp"
#include "common/link/playout.hpp"

namespace {
std::size_t allocations = 0;
}

void* operator new(std::size_t size) {
  ++allocations;
  if (void* p = std::malloc(size == 0 ? 1 : size)) return p;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  ++allocations;
  const auto a = static_cast<std::size_t>(alignment);
  if (void* p = std::aligned_alloc(a, (size + a - 1) / a * a)) return p;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size == 0 ? 1 : size);
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, const std::nothrow_t&) noexcept { std::free(p); }
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }

namespace longreach::allocation_test {
namespace {

Time at(int i) { return Time{Duration{1000000LL * i}}; }
PeerTime peer(int i) { return PeerTime{Duration{1000000LL * i}}; }

template <class Step>
std::size_t allocations_of(Step step) {
  const std::size_t before = allocations;
  for (int i = 1; i <= 30000; ++i) step(i);
  return allocations - before;
}

TEST(Allocation, TheCounterCounts) {
  EXPECT_GE(allocations_of([](int i) { std::vector<int> v(static_cast<std::size_t>(i)); }), 30000U);
}

TEST(Allocation, ImpairmentWithEverythingOnAllocatesNothing) {
  Impairment impairment({.delay_s = 20.0,
                         .jitter_s = 0.5,
                         .loss = 0.05,
                         .loss_burst = 3.0,
                         .duplicate = 0.5,
                         .reorder = 0.1,
                         .corrupt = 0.1,
                         .rate_bit_per_s = 1e7},
                        Random(1));
  const std::vector<std::byte> datagram(500), oversize(65507);
  const std::size_t n = allocations_of([&](int i) {
    impairment.push(at(i), i % 100 == 0 ? oversize : datagram);
    while (impairment.pop(at(i))) {
    }
    if (i == 15000) impairment.configure({.delay_s = 5.0, .jitter_s = 1.0}, at(i));
  });
  EXPECT_EQ(n, 0U);
  EXPECT_GT(impairment.counts().queue_dropped, 0U) << "the slots were to be exhausted as well";
}

TEST(Allocation, PlayoutAllocatesNothing) {
  Random random(1);
  Playout playout;
  const std::size_t n = allocations_of([&](int i) {
    const int late = static_cast<int>(random.next() % 50);
    playout.push(at(i), peer(i - late), static_cast<std::uint64_t>(std::max(1, i - late)),
                 Vector3::Constant(i));
    (void)playout.play(at(i));
    if (i % 1000 == 0) (void)playout.crossing(Vector3::UnitX(), Vector3::Constant(0.5 * i), i);
  });
  EXPECT_EQ(n, 0U);
}

TEST(Allocation, EndpointAndMonitorAllocateNothing) {
  Endpoint a, b;
  std::vector<std::byte> datagram(100);
  const std::size_t n = allocations_of([&](int i) {
    if (i % 1000 == 1) {
      a.follow(static_cast<std::uint64_t>(i));
      b.follow(static_cast<std::uint64_t>(i));
    }
    const auto number = static_cast<std::uint64_t>(i);
    write_header(*a.number(DatagramType::kMotionCommand, number), datagram);
    const auto read = read_header(datagram);
    const Header header = std::get<Header>(read);
    if (!b.judge(header) && b.mark(header)) b.learn(at(i), header, a.stamp_for(at(i)), datagram.size());
    const auto answer = b.number(DatagramType::kTelemetry, number);
    if (a.mark(*answer)) a.learn(at(i), *answer, b.stamp_for(at(i)), 100);
    if (i % 50 == 0) (void)a.monitor().figures(at(i));
  });
  EXPECT_EQ(n, 0U);
  EXPECT_EQ(b.monitor().last_heard(), at(30000));
}

}  // namespace
}  // namespace longreach::allocation_test
