// Trials on all cores: each is done once, wherever; a failure comes out.

#include "deploy/lab/on_all_cores.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace longreach::on_all_cores_test {
namespace {

TEST(OnAllCores, DoesEachOnce) {
  for (const std::size_t count : {0, 1, 2, 1000}) {
    std::vector<int> done(count);
    double share = 0.0;
    on_all_cores(
        count, [&](std::size_t i) { ++done[i]; },
        [&](double now) {
          EXPECT_GE(now, share);
          EXPECT_LT(now, 1.0);
          share = now;
        });
    EXPECT_EQ(done, std::vector<int>(count, 1));
  }
}

TEST(OnAllCores, ThrowsWhatATrialThrowsAndBeginsNoMore) {
  std::vector<int> done(1'000'000);
  const auto one = [&](std::size_t i) {
    if (i == 7) throw std::runtime_error("trial 7");
    std::this_thread::sleep_for(std::chrono::microseconds(100));
    ++done[i];
  };
  try {
    on_all_cores(done.size(), one);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "trial 7");
  }
  EXPECT_EQ(done.back(), 0);
}

TEST(OnAllCores, ThrowsOfTheLowestNumberThoughAnotherWasFaster) {
  std::atomic<bool> thrown{false};
  try {
    on_all_cores(2, [&](std::size_t i) {
      // On one core, nothing else runs meanwhile.
      for (int n = 0; i == 0 && n < 1000 && !thrown; ++n)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      thrown = true;
      throw std::runtime_error("trial " + std::to_string(i));
    });
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "trial 0");
  }
}

TEST(OnAllCores, NestedCallsShareTheCores) {
  std::atomic<unsigned> running{0}, most{0}, done{0};
  on_all_cores(8, [&](std::size_t) {
    on_all_cores(8, [&](std::size_t) {
      const unsigned now = ++running;
      for (unsigned before = most; before < now && !most.compare_exchange_weak(before, now);) continue;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      --running;
      ++done;
    });
  });
  EXPECT_EQ(done, 64U);
  EXPECT_LE(most, std::max(1U, std::thread::hardware_concurrency()));
}

}  // namespace
}  // namespace longreach::on_all_cores_test
