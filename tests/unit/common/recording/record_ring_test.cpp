// The queue between loop and recorder: in order, nothing twice, nothing lost that there was room for.
#include "common/recording/record_ring.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <thread>

namespace longreach::record_ring_test {
namespace {

TEST(RecordRing, HandsOverWhatIsPublishedInOrder) {
  RecordRing<int> ring(3);
  EXPECT_EQ(ring.front(), nullptr);
  for (int i = 0; i < 10; ++i) {
    ring.next() = 2 * i;
    EXPECT_EQ(ring.front(), nullptr) << "not published yet";
    ring.next() = 2 * i + 1;
    ring.publish();
    for (int value : {2 * i, 2 * i + 1}) {
      ASSERT_NE(ring.front(), nullptr);
      EXPECT_EQ(*ring.front(), value);
      ring.pop();
    }
    EXPECT_EQ(ring.front(), nullptr);
  }
}

TEST(RecordRing, TellsItsRoom) {
  RecordRing<int> ring(3);
  EXPECT_EQ(ring.room(), 3u);
  ring.next() = 1;
  EXPECT_EQ(ring.room(), 2u);
  ring.next() = 2;
  ring.next() = 3;
  ring.publish();
  EXPECT_EQ(ring.room(), 0u);
  ring.pop();
  EXPECT_EQ(ring.room(), 1u);
}

TEST(RecordRing, LosesNothingBetweenTwoThreads) {
  constexpr std::uint64_t kCount = 300'000;
  struct Value {
    std::uint64_t number = 0, again = 0;
  };
  RecordRing<Value> ring(64);
  std::thread writer([&ring] {
    for (std::uint64_t i = 0; i < kCount;) {
      if (ring.room() == 0) {
        std::this_thread::yield();
        continue;
      }
      ring.next() = {i, ~i};
      ring.publish();
      ++i;
    }
  });
  std::uint64_t wrong = 0;
  for (std::uint64_t i = 0; i < kCount;) {
    const Value* value = ring.front();
    if (value == nullptr) {
      std::this_thread::yield();
      continue;
    }
    if (value->number != i || value->again != ~i) ++wrong;
    ring.pop();
    ++i;
  }
  writer.join();
  EXPECT_EQ(wrong, 0u);
  EXPECT_EQ(ring.front(), nullptr);
}

}  // namespace
}  // namespace longreach::record_ring_test
