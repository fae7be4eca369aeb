#include "common/safety/overrun_watch.hpp"

#include <gtest/gtest.h>

namespace longreach::overrun_watch_test {
namespace {

constexpr double kRate_hz = 1000.0;

/// A loop of 1 kHz of which `late` tells what came late.
struct Loop {
  OverrunWatch watch{kRate_hz};
  Time now{};
  std::uint64_t overdue = 0;

  void tick(std::uint64_t late, Duration passed = std::chrono::milliseconds(1)) {
    now += passed;
    overdue += late;
    watch.step(now, overdue);
  }
};

TEST(OverrunWatch, SpeaksWhenMoreThanHalfOfTheTicksOfASecondWereLate) {
  for (const int late_of_ten : {0, 1, 4, 5, 6, 10}) {
    Loop loop;
    bool ever = false;
    for (int i = 0; i < 5000; ++i) {
      loop.tick(i % 10 < late_of_ten ? 1 : 0);
      ever = ever || loop.watch.overrun();
    }
    EXPECT_EQ(ever, late_of_ten > 5) << late_of_ten;
  }
}

TEST(OverrunWatch, CountsTicksThatNeverCame) {
  for (const int lasts : {1, 2, 3, 4}) {  // a step takes as many periods: all but one of its ticks are missed
    Loop loop;
    for (int i = 0; i < 3000; ++i)
      loop.tick(static_cast<std::uint64_t>(lasts) - 1, std::chrono::milliseconds(lasts));
    EXPECT_EQ(loop.watch.overrun(), lasts > 2) << lasts;
  }
}

TEST(OverrunWatch, TheSecondGoesOn) {
  Loop loop;
  for (int i = 0; i < 501; ++i) loop.tick(1);
  EXPECT_TRUE(loop.watch.overrun());
  for (int i = 0; i < 499; ++i) loop.tick(0);
  EXPECT_TRUE(loop.watch.overrun());
  loop.tick(0);
  EXPECT_FALSE(loop.watch.overrun()) << "the first of them is a second ago";
}

TEST(OverrunWatch, OneStallIsNoOverrunHoweverLong) {
  for (const int ms : {90, 400, 600, 1900}) {
    Loop loop;
    for (int i = 0; i < 2000; ++i) loop.tick(0);
    loop.tick(static_cast<std::uint64_t>(ms), std::chrono::milliseconds(ms));
    EXPECT_FALSE(loop.watch.overrun()) << ms;
  }
  Loop loop;
  for (int i = 0; i < 10; ++i) loop.tick(90, std::chrono::milliseconds(95));
  EXPECT_TRUE(loop.watch.overrun()) << "one after the other is";
  loop.watch.clear();
  EXPECT_FALSE(loop.watch.overrun());
}

TEST(OverrunWatch, MoreThanItRemembersWithinASecondIsForgottenAsWell) {
  Loop loop;
  for (int i = 0; i < 5000; ++i) loop.tick(1, Duration{0});
  EXPECT_TRUE(loop.watch.overrun());
  loop.tick(0, std::chrono::seconds(1));
  EXPECT_FALSE(loop.watch.overrun());
}

TEST(OverrunWatch, ACountThatBeginsAnewIsNoLateTick) {
  Loop loop;
  for (int i = 0; i < 400; ++i) loop.tick(1);
  loop.overdue = 0;
  for (int i = 0; i < 50; ++i) loop.tick(1);
  EXPECT_FALSE(loop.watch.overrun());
}

}  // namespace
}  // namespace longreach::overrun_watch_test
