#include "common/core/ring.hpp"

#include <gtest/gtest.h>

#include <deque>

#include "common/core/random.hpp"

namespace longreach::ring_test {
namespace {

TEST(Ring, OldestGivesWayWhenFull) {
  Ring<int> ring(3);
  for (int i = 1; i <= 5; ++i) ring.push(i);
  ASSERT_EQ(ring.size(), 3U);
  EXPECT_TRUE(ring.full());
  EXPECT_EQ(ring.front(), 3);
  EXPECT_EQ(ring[1], 4);
  EXPECT_EQ(ring.back(), 5);
}

TEST(Ring, HoldsOneElement) {
  Ring<int> ring(1);
  ring.push(1);
  ring.push(2);
  EXPECT_EQ(ring.front(), 2);
  EXPECT_EQ(ring.back(), 2);
  ring.pop();
  EXPECT_TRUE(ring.empty());
}

// Small ones, and those that go round in more and more of their storage.
TEST(Ring, BehavesLikeABoundedDeque) {
  Random random(11);
  for (const std::size_t capacity : {7, 64, 65, 300}) {
    Ring<int> ring(capacity);
    std::deque<int> oracle;
    int times_full = 0;
    for (int i = 0; i < 10'000; ++i) {
      if (random.chance(0.05 / static_cast<double>(capacity))) {
        ring.clear();
        oracle.clear();
      } else if (random.chance(0.6)) {
        if (oracle.size() == capacity) oracle.pop_front();
        ring.push(i);
        oracle.push_back(i);
      } else if (!oracle.empty()) {
        ring.pop();
        oracle.pop_front();
      }
      ASSERT_EQ(ring.size(), oracle.size());
      ASSERT_EQ(ring.full(), oracle.size() == capacity);
      times_full += ring.full() ? 1 : 0;
      for (std::size_t k = 0; k < oracle.size(); ++k) ASSERT_EQ(ring[k], oracle[k]);
    }
    EXPECT_GT(times_full, 100);
  }
}

TEST(RingDeathTest, PopOfNothingIsAMistake) {
  Ring<int> ring(2);
  EXPECT_DEATH(ring.pop(), "CHECK failed");
  EXPECT_DEATH(Ring<int>(0), "CHECK failed");
}

}  // namespace
}  // namespace longreach::ring_test
