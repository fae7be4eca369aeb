#include "master/input/key_allowance.hpp"

#include <gtest/gtest.h>

namespace longreach::key_allowance_test {
namespace {

constexpr double kPoll_s = 0.02;
const Key kStep{KeyAction::kMove, 0, 1};

int taken(KeyAllowance& allowance, int keys, double since_s, bool elsewhere = false) {
  allowance.poll(since_s, elsewhere);
  int count = 0;
  for (int i = 0; i < keys; ++i) count += allowance.takes(kStep) ? 1 : 0;
  return count;
}

TEST(KeyAllowance, TakesWhatAKeyboardRepeatsAndFiveMore) {
  KeyAllowance allowance;
  EXPECT_EQ(taken(allowance, 60, kPoll_s), 5);
  EXPECT_EQ(allowance.dropped(), 55u);
  EXPECT_EQ(allowance.why(), KeyAllowance::Why::kBurst);
  EXPECT_EQ(taken(allowance, 60, 0.2), 11);
  KeyAllowance repeats;  // the fastest repeat: 30 keys a second, late by up to 0.2 s
  for (const double since_s : {0.02, 0.04, 0.1, 0.2})
    EXPECT_EQ(taken(repeats, static_cast<int>(30.0 * since_s) + 1, since_s),
              static_cast<int>(30.0 * since_s) + 1);
  EXPECT_EQ(repeats.dropped(), 0u);
}

TEST(KeyAllowance, DropsWhatWaitedAfterAStall) {
  KeyAllowance allowance;
  EXPECT_EQ(taken(allowance, 3, 0.23), 0);
  EXPECT_EQ(allowance.why(), KeyAllowance::Why::kLate);
  EXPECT_EQ(taken(allowance, 3, kPoll_s), 3);
}

TEST(KeyAllowance, TakesStopQuitAndHelpAlways) {
  KeyAllowance allowance;
  EXPECT_EQ(taken(allowance, 20, 10.0, true), 0);
  EXPECT_EQ(allowance.why(), KeyAllowance::Why::kElsewhere);
  for (const KeyAction action : {KeyAction::kStop, KeyAction::kQuit, KeyAction::kHelp})
    EXPECT_TRUE(allowance.takes({action}));
  EXPECT_FALSE(allowance.takes({KeyAction::kEngage}));
}

TEST(KeyAllowance, ForgetsWhatItDroppedAfterFiveSeconds) {
  KeyAllowance allowance;
  taken(allowance, 20, kPoll_s);
  for (int i = 0; i < 249; ++i) allowance.poll(kPoll_s, false);
  EXPECT_EQ(allowance.dropped(), 15u);
  for (int i = 0; i < 2; ++i) allowance.poll(kPoll_s, false);
  EXPECT_EQ(allowance.dropped(), 0u);
}

}  // namespace
}  // namespace longreach::key_allowance_test
