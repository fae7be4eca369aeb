#include "common/core/ring.hpp"

#include <gtest/gtest.h>

#include <deque>

#include "common/core/random.hpp"

namespace longreach {
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

TEST(Ring, BehavesLikeABoundedDeque) {
  Random random(11);
  Ring<int> ring(7);
  std::deque<int> oracle;
  for (int i = 0; i < 5000; ++i) {
    if (random.chance(0.01)) {
      ring.clear();
      oracle.clear();
    } else if (random.chance(0.6)) {
      if (oracle.size() == 7) oracle.pop_front();
      ring.push(i);
      oracle.push_back(i);
    } else if (!oracle.empty()) {
      ring.pop();
      oracle.pop_front();
    }
    ASSERT_EQ(ring.size(), oracle.size());
    for (std::size_t k = 0; k < oracle.size(); ++k) ASSERT_EQ(ring[k], oracle[k]);
  }
}

TEST(RingDeathTest, PopOfNothingIsAMistake) {
  Ring<int> ring(2);
  EXPECT_DEATH(ring.pop(), "CHECK failed");
  EXPECT_DEATH(Ring<int>(0), "CHECK failed");
}

}  // namespace
}  // namespace longreach
