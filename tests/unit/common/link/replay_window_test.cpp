#include "common/link/replay_window.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <set>

#include "common/core/random.hpp"
#include "deploy/lab/campaign_size.hpp"

namespace longreach::replay_window_test {
namespace {

/// Remembers everything: what the window has to agree with.
class Oracle {
 public:
  explicit Oracle(std::uint64_t width) : width_(width) {}
  bool accept(std::uint64_t n) {
    if (n == 0 || (n < newest_ && newest_ - n >= width_)) return false;
    newest_ = std::max(newest_, n);
    return seen_.insert(n).second;
  }

 private:
  std::uint64_t width_;
  std::uint64_t newest_ = 0;
  std::set<std::uint64_t> seen_;
};

TEST(ReplayWindow, AgreesWithASetForEveryThreeNumbersAtWidth64) {
  // Around the edges of words and of the window; each triple from a fresh window.
  const std::uint64_t numbers[] = {0,   1,   2,   62,  63,  64,  65,  66,  126,
                                   127, 128, 129, 130, 191, 192, 193, 256, 1000};
  for (const auto a : numbers) {
    for (const auto b : numbers) {
      for (const auto c : numbers) {
        ReplayWindow window(64);
        Oracle oracle(64);
        for (const auto n : {a, b, c, a, b, c}) {
          const bool fresh = window.fresh(n);
          ASSERT_EQ(fresh, oracle.accept(n)) << a << ' ' << b << ' ' << c;
          ASSERT_EQ(window.accept(n), fresh) << a << ' ' << b << ' ' << c;
        }
      }
    }
  }
}

TEST(ReplayWindow, AgreesWithASetForEveryTwoNumbersOf12BitsAtWidth64) {
  constexpr std::uint64_t kEnd = 1U << 12;
  const auto stride = static_cast<std::uint64_t>(campaign(1, 16));
  ReplayWindow window(64);
  for (std::uint64_t first = 0; first < kEnd; first += stride) {
    for (std::uint64_t second = 0; second < kEnd; ++second) {
      window.clear();
      std::set<std::uint64_t> seen;
      std::uint64_t newest = 0;
      for (const std::uint64_t n : {first, second, first, second}) {
        const bool expected = n != 0 && n + 64 > newest && seen.insert(n).second;
        newest = std::max(newest, n);
        ASSERT_EQ(window.fresh(n), expected) << first << ' ' << second << ' ' << n;
        ASSERT_EQ(window.accept(n), expected) << first << ' ' << second << ' ' << n;
      }
    }
  }
}

// From every state that 12 bits of numbers lead to by steps forward, every number is tried, behind and ahead.
TEST(ReplayWindow, AgreesWithASetForEveryNumberOf12BitsBehindASieve) {
  constexpr std::uint64_t kEnd = 1U << 12;
  for (std::uint64_t step = 1; step <= 130; ++step) {
    ReplayWindow window(64);
    Oracle oracle(64);
    for (std::uint64_t front = 1; front < kEnd; front += step) {
      ASSERT_EQ(window.accept(front), oracle.accept(front));
      // All that the window can still tell apart, and beyond its edge.
      for (std::uint64_t n = front > 70 ? front - 70 : 0; n <= front; n += 1 + step % 3) {
        ASSERT_EQ(window.accept(n), oracle.accept(n)) << step << ' ' << front << ' ' << n;
      }
    }
    for (std::uint64_t n = 0; n < kEnd; ++n)
      ASSERT_EQ(window.accept(n), oracle.accept(n)) << step << ' ' << n;
  }
}

TEST(ReplayWindow, AgreesWithASetOnRandomTraffic) {
  for (const std::uint32_t width : {1U, 2U, 63U, 65U, 8192U}) {
    Random random(width);
    ReplayWindow window(width);
    Oracle oracle(width);
    double front = 1.0;
    for (int i = 0; i < 100000; ++i) {
      front += random.chance(0.001) ? random.uniform(0.0, 3.0 * width) : 1.0;
      const double back = random.chance(0.3) ? random.uniform(0.0, 1.5 * width + 2.0) : 0.0;
      const auto n = static_cast<std::uint64_t>(std::max(0.0, front - back));
      ASSERT_EQ(window.accept(n), oracle.accept(n)) << "width " << width << " step " << i;
    }
  }
}

TEST(ReplayWindow, SurvivesTheGreatestNumber) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
  ReplayWindow window;
  EXPECT_TRUE(window.accept(1));
  EXPECT_TRUE(window.accept(kMost));
  EXPECT_FALSE(window.accept(kMost));
  EXPECT_FALSE(window.accept(1));
  EXPECT_TRUE(window.accept(kMost - 8191));
  EXPECT_FALSE(window.accept(kMost - 8192));
  EXPECT_EQ(window.newest(), kMost);
}

TEST(ReplayWindow, ForgetsEverythingWhenCleared) {
  ReplayWindow window(64);
  EXPECT_TRUE(window.accept(500));
  window.clear();
  EXPECT_EQ(window.newest(), 0U);
  EXPECT_TRUE(window.accept(1));
  EXPECT_TRUE(window.accept(500));
  EXPECT_FALSE(window.accept(500));
}

}  // namespace
}  // namespace longreach::replay_window_test
