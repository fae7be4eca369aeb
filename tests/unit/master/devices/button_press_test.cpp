#include "master/devices/button_press.hpp"

#include <gtest/gtest.h>

namespace longreach::button_press_test {
namespace {

constexpr double kTick_s = 1e-3;

/// Number of presses that begin in these ticks.
int presses(ButtonPress& button, bool down, int ticks) {
  int count = 0;
  for (int i = 0; i < ticks; ++i) count += button.step(down, kTick_s) ? 1 : 0;
  return count;
}

TEST(ButtonPress, CountsOnceWhenTheContactsChatter) {
  ButtonPress button;
  EXPECT_EQ(presses(button, false, 20), 0);
  for (int press = 0; press < 3; ++press) {
    int count = 0;
    for (int bounce = 0; bounce < 3; ++bounce) count += presses(button, true, 1) + presses(button, false, 1);
    count += presses(button, true, 30);
    EXPECT_EQ(count, 1) << press;
    for (int bounce = 0; bounce < 3; ++bounce)
      EXPECT_EQ(presses(button, false, 1) + presses(button, true, 1), 0) << press;
    EXPECT_EQ(presses(button, false, 30), 0);
  }
}

TEST(ButtonPress, OfAButtonThatIsHeldAtTheStartCountsWhenItIsPressedAgain) {
  ButtonPress button;
  EXPECT_EQ(presses(button, true, 100), 0);
  EXPECT_EQ(presses(button, false, 19), 0);
  EXPECT_EQ(presses(button, true, 1), 0);
  EXPECT_EQ(presses(button, false, 20), 0);
  EXPECT_EQ(presses(button, true, 100), 1);
  button.forget();
  EXPECT_EQ(presses(button, true, 100), 0);
}

}  // namespace
}  // namespace longreach::button_press_test
