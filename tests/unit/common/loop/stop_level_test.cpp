#include "common/loop/stop_level.hpp"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace longreach::stop_level_test {
namespace {

using std::chrono::milliseconds;

TEST(StopLevel, IsTakenByTheNextTickOnce) {
  StopLevel stops;
  EXPECT_FALSE(stops.take());
  EXPECT_FALSE(stops.ask(milliseconds(0))) << "no loop";
  EXPECT_TRUE(stops.take()) << "it stands for a loop that comes later";
  EXPECT_FALSE(stops.take());
}

TEST(StopLevel, AnswersEverybodyWhoAskedBeforeTheTick) {
  StopLevel stops;
  std::atomic<int> answered = 0;
  std::vector<std::thread> askers;
  for (int i = 0; i < 8; ++i)
    askers.emplace_back([&] { answered += stops.ask(std::chrono::seconds(60)) ? 1 : 0; });
  int ticks = 0;
  while (answered < 8) ticks += stops.take() ? 1 : 0;
  for (std::thread& asker : askers) asker.join();
  EXPECT_GE(ticks, 1);
  EXPECT_LE(ticks, 8);
  EXPECT_FALSE(stops.take());
}

}  // namespace
}  // namespace longreach::stop_level_test
