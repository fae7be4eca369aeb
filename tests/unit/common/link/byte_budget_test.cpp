#include "common/link/byte_budget.hpp"

#include <gtest/gtest.h>

#include <deque>

namespace longreach::byte_budget_test {
namespace {

// One that would send in every tick. Bits of the fullest second, headers counted.
double fullest_second(double kbit_per_s, std::size_t bytes, Duration tick) {
  ByteBudget budget;
  budget.configure(kbit_per_s);
  std::deque<Time> sent;
  std::size_t most = 0;
  for (Time now{}; now < Time{std::chrono::seconds(5)}; now += tick) {
    if (!budget.allows(now)) continue;
    budget.spend(now, bytes);
    sent.push_back(now);
    while (sent.front() <= now - std::chrono::seconds(1)) sent.pop_front();
    most = std::max(most, sent.size());
  }
  return 8.0 * static_cast<double>(most * (bytes + kIpUdpBytes));
}

TEST(ByteBudget, KeepsEverySecondBelowTheRateAndUsesIt) {
  for (const double kbit_per_s : {64.0, 256.0, 1000.0}) {
    for (const std::size_t bytes : {std::size_t{60}, std::size_t{95}, std::size_t{508}}) {
      const double datagram = 8.0 * static_cast<double>(bytes + kIpUdpBytes);
      const double most = fullest_second(kbit_per_s, bytes, std::chrono::milliseconds(1));
      if (1e-3 * kbit_per_s * 1e3 > datagram) continue;  // more than one a tick
      EXPECT_LE(most, 1.002e3 * kbit_per_s + datagram);
      EXPECT_GE(most, 0.998e3 * kbit_per_s - datagram);
    }
  }
}

TEST(ByteBudget, WithoutALimitAllowsEverything) {
  ByteBudget budget;
  for (int i = 0; i < 1000; ++i) {
    ASSERT_TRUE(budget.allows(Time{}));
    budget.spend(Time{}, 508);
  }
}

TEST(ByteBudget, SavesNothingUpInSilence) {
  ByteBudget budget;
  budget.configure(100.0);
  budget.spend(Time{}, 472);  // 40 ms
  const Time later{std::chrono::hours(1)};
  ASSERT_TRUE(budget.allows(later));
  budget.spend(later, 472);
  EXPECT_FALSE(budget.allows(later));
  EXPECT_FALSE(budget.allows(later + std::chrono::milliseconds(37)));
  EXPECT_TRUE(budget.allows(later + std::chrono::milliseconds(38)));
}

}  // namespace
}  // namespace longreach::byte_budget_test
