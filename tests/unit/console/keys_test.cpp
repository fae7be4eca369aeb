#include "master/console/keys.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "common/core/random.hpp"

namespace longreach {
namespace {

Key moved(int axis, int sign, bool large = false) { return {KeyAction::kMove, axis, sign, large}; }

struct Case {
  std::string bytes;
  Key key;
};

// Sequences as xterm's control sequence documentation gives them.
const std::vector<Case>& known_keys() {
  static const std::vector<Case> cases = {{"w", moved(0, 1)},
                                          {"s", moved(0, -1)},
                                          {"a", moved(1, 1)},
                                          {"d", moved(1, -1)},
                                          {"r", moved(2, 1)},
                                          {"f", moved(2, -1)},
                                          {"W", moved(0, 1, true)},
                                          {"F", moved(2, -1, true)},
                                          {"\x1b[A", moved(0, 1)},
                                          {"\x1b[B", moved(0, -1)},
                                          {"\x1b[D", moved(1, 1)},
                                          {"\x1b[C", moved(1, -1)},
                                          {"\x1bOA", moved(0, 1)},
                                          {"\x1b[1;2A", moved(0, 1, true)},
                                          {"\x1b[1;2C", moved(1, -1, true)},
                                          {"\x1b[5~", moved(2, 1)},
                                          {"\x1b[6~", moved(2, -1)},
                                          {"\x1b[5;2~", moved(2, 1, true)},
                                          {" ", {KeyAction::kHome}},
                                          {"m", {KeyAction::kMode}},
                                          {"+", {KeyAction::kScaleUp}},
                                          {"-", {KeyAction::kScaleDown}},
                                          {"c", {KeyAction::kClutch}},
                                          {"e", {KeyAction::kEngage}},
                                          {"x", {KeyAction::kStop}},
                                          {"q", {KeyAction::kQuit}},
                                          {"?", {KeyAction::kHelp}}};
  return cases;
}

TEST(KeyParser, KnowsItsKeys) {
  for (const Case& c : known_keys()) {
    KeyParser parser;
    const std::vector<Key> keys = parser.feed(c.bytes);
    ASSERT_EQ(keys.size(), 1u) << c.bytes;
    EXPECT_EQ(keys[0], c.key) << c.bytes;
  }
}

TEST(KeyParser, DoesNotCareHowReadsSplitTheBytes) {
  std::string all;
  std::vector<Key> expected;
  for (const Case& c : known_keys()) {
    all += c.bytes;
    expected.push_back(c.key);
  }
  Random random(11);
  for (int round = 0; round < 200; ++round) {
    KeyParser parser;
    std::vector<Key> keys;
    for (std::size_t at = 0; at < all.size();) {
      const std::size_t length = 1 + random.next() % 4;
      for (const Key& key : parser.feed(std::string_view(all).substr(at, length))) keys.push_back(key);
      at += length;
    }
    ASSERT_EQ(keys, expected) << "round " << round;
  }
}

TEST(KeyParser, TakesNoActionOnUnknownSequences) {
  KeyParser parser;
  EXPECT_TRUE(parser.feed("\x1b[Z\x1b[1;5P\x1b[15~\x1bOP\x01\x7f\xc3\xa4").empty());
  EXPECT_TRUE(parser.feed("\x1b[~").empty());  // no number
}

TEST(KeyParser, RecoversAfterALoneEscape) {
  KeyParser parser;
  EXPECT_TRUE(parser.feed("\x1b").empty());
  EXPECT_EQ(parser.feed("\x1b[A"), std::vector<Key>{moved(0, 1)});
  EXPECT_EQ(parser.feed("\x1bq"), std::vector<Key>{{KeyAction::kQuit}});
}

TEST(KeyParser, AlwaysHearsTheStopKeyAgainAfterAnyBytes) {
  Random random(3);
  for (int round = 0; round < 300; ++round) {
    KeyParser parser;
    std::string noise;
    for (int i = 0; i < 64; ++i) noise += static_cast<char>(random.next() & 0xff);
    parser.feed(noise);
    int heard = 0;  // at worst a begun sequence swallows the first one
    for (int i = 0; i < 2; ++i) {
      for (const Key& key : parser.feed("x")) heard += key.action == KeyAction::kStop;
    }
    EXPECT_GE(heard, 1) << "round " << round;
  }
}

TEST(Keys, MoveTheTargetInSteps) {
  KeyboardState state;
  const KeyboardConfig config;
  apply(moved(0, 1), config, MotionMode::kPosition, state);
  apply(moved(2, -1, true), config, MotionMode::kPosition, state);
  EXPECT_TRUE(state.target_m.isApprox(Vector3(0.001, 0.0, -0.005)));
  apply({KeyAction::kHome}, config, MotionMode::kPosition, state);
  EXPECT_EQ(state.target_m, Vector3::Zero());
}

TEST(Keys, KeepTheTargetWithinTheWorkspace) {
  Random random(5);
  KeyboardState state;
  const KeyboardConfig config;
  for (int i = 0; i < 5000; ++i) {
    const int axis = static_cast<int>(random.next() % 3);
    apply(moved(axis, random.chance(0.7) ? 1 : -1, random.chance(0.5)), config, MotionMode::kPosition, state);
    ASSERT_LE(state.target_m.norm(), config.workspace_m * (1.0 + 1e-12));
  }
  EXPECT_GT(state.target_m.norm(), 0.9 * config.workspace_m);
}

TEST(Keys, ChangeTheModeFromThePresentOne) {
  KeyboardState state;
  apply({KeyAction::kMode}, {}, MotionMode::kRate, state);
  EXPECT_EQ(state.requests.mode, MotionMode::kPosition);
  apply({KeyAction::kMode}, {}, MotionMode::kRate, state);
  EXPECT_EQ(state.requests.mode, MotionMode::kRate);
}

TEST(Keys, LetAStopWinOverAnEngageTypedWithIt) {
  for (const auto& order : {std::vector{KeyAction::kStop, KeyAction::kEngage},
                            std::vector{KeyAction::kEngage, KeyAction::kStop}}) {
    KeyboardState state;
    for (const KeyAction action : order) apply({action}, {}, MotionMode::kRate, state);
    EXPECT_TRUE(state.requests.stop);
    EXPECT_FALSE(state.requests.engage);
  }
}

TEST(Keys, CountScaleStepsAndToggleTheClutch) {
  KeyboardState state;
  for (const KeyAction action :
       {KeyAction::kScaleDown, KeyAction::kScaleDown, KeyAction::kScaleUp, KeyAction::kClutch}) {
    apply({action}, {}, MotionMode::kRate, state);
  }
  EXPECT_EQ(state.requests.scale_steps, -1);
  EXPECT_TRUE(state.requests.clutch);
  apply({KeyAction::kClutch}, {}, MotionMode::kRate, state);
  EXPECT_FALSE(state.requests.clutch);
}

TEST(Keys, TellOfALoadAndThatItIsGone) {
  KeyboardState state;
  EXPECT_FALSE(state.requests.load.has_value());
  apply({KeyAction::kLoad}, {}, MotionMode::kRate, state);
  EXPECT_EQ(state.requests.load, true);
  state.requests = {};
  apply({KeyAction::kLoad}, {}, MotionMode::kRate, state);
  EXPECT_EQ(state.requests.load, false);
}

}  // namespace
}  // namespace longreach
