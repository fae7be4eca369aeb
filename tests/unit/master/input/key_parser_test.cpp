// Whole sequences of what terminals send, so that no part of one is a command.

#include "master/input/key_parser.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/core/random.hpp"

namespace longreach::key_parser_test {
namespace {

Key moved(int axis, int sign, bool large = false) { return {KeyAction::kMove, axis, sign, large}; }

Key turned(int axis, int sign, bool large = false) { return {KeyAction::kTurn, axis, sign, large}; }

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
                                          {"u", turned(0, 1)},
                                          {"o", turned(0, -1)},
                                          {"i", turned(1, 1)},
                                          {"K", turned(1, -1, true)},
                                          {"J", turned(2, 1, true)},
                                          {"l", turned(2, -1)},
                                          {" ", {KeyAction::kHome}},
                                          {"m", {KeyAction::kMode}},
                                          {"+", {KeyAction::kScaleUp}},
                                          {"-", {KeyAction::kScaleDown}},
                                          {".", {KeyAction::kKvUp}},
                                          {",", {KeyAction::kKvDown}},
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

/// Of bytes that come at once, from a new parser.
std::vector<Key> keys_of(const std::string& bytes) {
  KeyParser parser;
  return parser.feed(bytes);
}

// What the system's database of terminals says that keys send (terminfo(5)), by the name of the capability.
std::string unescaped(const std::string& text) {
  static const std::map<char, char> kNames = {{'E', '\x1b'}, {'e', '\x1b'}, {'n', '\n'},
                                              {'l', '\n'},   {'r', '\r'},   {'t', '\t'},
                                              {'b', '\b'},   {'f', '\f'},   {'s', ' '}};
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '^' && i + 1 < text.size()) {
      ++i;
      out += text[i] == '?' ? '\x7f' : static_cast<char>(text[i] & 0x1f);
    } else if (text[i] == '\\' && i + 3 < text.size() && text[i + 1] >= '0' && text[i + 1] <= '7') {
      out += static_cast<char>(std::stoi(text.substr(i + 1, 3), nullptr, 8));
      i += 3;
    } else if (text[i] == '\\' && i + 1 < text.size()) {
      ++i;
      const auto name = kNames.find(text[i]);
      out += name != kNames.end() ? name->second : text[i];
    } else {
      out += text[i];
    }
  }
  return out;
}

std::map<std::string, std::string> keys_of_terminal(const std::string& terminal) {
  std::map<std::string, std::string> keys;
  const std::unique_ptr<FILE, int (*)(FILE*)> in(
      ::popen(("infocmp -1 -x " + terminal + " 2>/dev/null").c_str(), "r"), ::pclose);
  std::array<char, 512> buffer{};
  while (in != nullptr && std::fgets(buffer.data(), buffer.size(), in.get()) != nullptr) {
    const std::string line(buffer.data());  // "\tkf1=\EOP,\n"
    const std::size_t equals = line.find('=');
    if (!line.starts_with("\tk") || equals == std::string::npos) continue;
    keys[line.substr(1, equals - 1)] = unescaped(line.substr(equals + 1, line.rfind(',') - equals - 1));
  }
  return keys;
}

// All that move the hand: arrows and pages, alone and with shift.
const std::map<std::string, Key>& keys_that_move() {
  static const std::map<std::string, Key> keys = {
      {"kcuu1", moved(0, 1)},       {"kcud1", moved(0, -1)},      {"kcub1", moved(1, 1)},
      {"kcuf1", moved(1, -1)},      {"kpp", moved(2, 1)},         {"knp", moved(2, -1)},
      {"kri", moved(0, 1, true)},   {"kind", moved(0, -1, true)}, {"kUP", moved(0, 1, true)},
      {"kDN", moved(0, -1, true)},  {"kLFT", moved(1, 1, true)},  {"kRIT", moved(1, -1, true)},
      {"kPRV", moved(2, 1, true)},  {"kNXT", moved(2, -1, true)}, {"kPRV2", moved(2, 1, true)},
      {"kNXT2", moved(2, -1, true)}};
  return keys;
}

TEST(KeyParser, TakesTheKeysOfEveryTerminalWhole) {
  const std::vector<std::string> terminals = {
      "xterm", "xterm-256color", "linux", "screen",       "screen-256color", "tmux",  "tmux-256color",
      "rxvt",  "vt100",          "vt220", "rxvt-unicode", "putty",           "kitty", "alacritty",
      "foot",  "konsole",        "st"};
  int checked = 0;
  for (const std::string& terminal : terminals) {
    for (const auto& [name, bytes] : keys_of_terminal(terminal)) {
      if (name == "kmous" || bytes.empty()) continue;  // a part of a report
      std::vector<Key> expected;
      if (const auto key = keys_that_move().find(name); key != keys_that_move().end())
        expected.push_back(key->second);
      // With control and shift rxvt sends what an arrow is to the others.
      if (terminal == "rxvt" && name.ends_with('6') && bytes.starts_with("\x1bO"))
        expected = keys_of(keys_of_terminal("screen").at(
            std::map<char, std::string>{{'A', "kcuu1"}, {'B', "kcud1"}, {'C', "kcuf1"}, {'D', "kcub1"}}.at(
                bytes.back())));
      EXPECT_EQ(keys_of(bytes), expected) << terminal << ' ' << name;
      expected.push_back({KeyAction::kStop});
      EXPECT_EQ(keys_of(bytes + "x"), expected) << terminal << ' ' << name << ", then stop";
      ++checked;
    }
  }
  EXPECT_GT(checked, 500);  // the first eight are in Debian's ncurses-base
}

TEST(KeyParser, TakesNoPartOfAnUnknownSequence) {
  for (const std::string bytes : {"\x1b[Z",
                                  "\x1b[1;5P",
                                  "\x1b[15~",
                                  "\x1bOP",
                                  "\x01\x7f\xc3\xa4",
                                  "\x1b[~",
                                  "\x1b[[E",
                                  "\x1b[[A",
                                  "\x1b"
                                  "e",
                                  "\x1bw",
                                  "\x1b"
                                  "x",
                                  "\x1b\x1b[A",
                                  "\x1b[1;5A",
                                  "\x1b[1;3B",
                                  "\x1b[1;1:3A",
                                  "\x1b[<0;12;7M",
                                  "\x1b[M #!",
                                  "\x1b[?62;1;4c",
                                  "\x1b[12;40R",
                                  "\x1b[I",
                                  "\x1b[O",
                                  "\x1bOa",
                                  "\x1bO5A",
                                  "\x1b[3$",
                                  "\x1b]11;rgb:ffff/eeee/aaaa\x1b\\",
                                  "\x1b]0;we\a",
                                  "\x1bP>|xterm(370)\x1b\\",
                                  "\x1b_Gi=31;e\x1b\\",
                                  "\x1b(e",
                                  "\x1b F",
                                  "\x1b[?12;2$y",
                                  "\x1b[27;2;101~",
                                  "\x1b[101;5u",
                                  "\x1b[1;2;3;4;5;6;7;8;9;10;11~",
                                  "\xe2\x9b\x8f",
                                  "\x9b"
                                  "1~",
                                  "\x8fP",
                                  "\x1b[200~exwWq\x1b[201~",
                                  "\x1b[200~\x1b[[e\x1bPe\x1b[201~"}) {
    EXPECT_EQ(keys_of(bytes), std::vector<Key>{}) << testing::PrintToString(bytes);
    EXPECT_EQ(keys_of(bytes + "e"), std::vector<Key>{{KeyAction::kEngage}}) << testing::PrintToString(bytes);
  }
}

/// Lets polls pass in which nothing comes.
void wait(KeyParser& parser, int polls) {
  for (int i = 0; i < polls; ++i) parser.tick();
}

constexpr int kPausePolls = 5, kSecondPolls = 50;

TEST(KeyParser, TakesEveryKeyAfterALoneEscape) {
  KeyParser parser;
  EXPECT_TRUE(parser.feed("\x1b").empty());
  wait(parser, kPausePolls);
  EXPECT_EQ(parser.feed("x"), std::vector<Key>{{KeyAction::kStop}});
  EXPECT_TRUE(parser.feed("\x1b").empty());
  wait(parser, kPausePolls);
  EXPECT_EQ(parser.feed("\x1b[A"), std::vector<Key>{moved(0, 1)});
  // A slow link has split it.
  EXPECT_TRUE(parser.feed("\x1b").empty());
  wait(parser, kPausePolls);
  EXPECT_EQ(parser.feed("[A"), std::vector<Key>{moved(0, 1)});
}

TEST(KeyParser, EndsControlsOfEightBits) {
  for (const std::string bytes : {"\x9d"
                                  "11;rgb:ee/ff/cc\x9c",
                                  "\x9d"
                                  "11;rgb:ee/ff/cc\a",
                                  "\x90>|weqx\x9c", "\x98weqx\x9c",
                                  "\x9b"
                                  "200~e q W\x9b"
                                  "201~",
                                  "\x9b"
                                  "200~e q W\x1b[201~",
                                  "\xc2\x9b"
                                  "200~e q W\xc2\x9b"
                                  "201~",
                                  "\x9c"}) {
    EXPECT_EQ(keys_of(bytes + "e"), std::vector<Key>{{KeyAction::kEngage}}) << testing::PrintToString(bytes);
  }
}

// Letters whose encoding ends with 9B, 9C or 9D, also behind a pause of the link.
TEST(KeyParser, TakesNoByteOfACharacterForAControl) {
  for (const std::string character : {"\xc3\x9b", "\xc3\x9d", "\xe2\x80\x9c", "\xf0\x9f\x9b\x90"}) {
    EXPECT_EQ(keys_of(character + "e"), std::vector<Key>{{KeyAction::kEngage}});
    EXPECT_EQ(keys_of("\x1b]0;" + character + "we\a"), std::vector<Key>{});
    EXPECT_EQ(keys_of("\x1b[200~" + character + "201~we\x1b[201~"), std::vector<Key>{});
    KeyParser parser;
    for (const char byte : character) {
      parser.feed({&byte, 1});
      wait(parser, 2 * kPausePolls);
    }
    EXPECT_EQ(parser.feed("e"), std::vector<Key>{{KeyAction::kEngage}});
  }
}

const std::vector<std::string>& texts_without_end() {
  static const std::vector<std::string> texts = {"\x1b]11;rgb:ee",
                                                 "\x1bP>|",
                                                 "\x1bX",
                                                 "\x1b^",
                                                 "\x1b_G",
                                                 "\x9d",
                                                 "\x90",
                                                 "\x98",
                                                 "\xc2\x9d",
                                                 "\x9b"
                                                 "200~",
                                                 "\x1b[200~hello"};
  return texts;
}

TEST(KeyParser, TakesARepeatedStopWithinTextWithoutEnd) {
  for (const std::string& text : texts_without_end()) {
    for (const int every_polls : {1, 3, 12, 30}) {
      KeyParser parser;
      parser.feed(text);
      int polls = 0;
      std::vector<Key> keys;
      for (; keys.empty() && polls < 500; polls += every_polls) {
        wait(parser, every_polls);
        keys = parser.feed("x");
      }
      EXPECT_EQ(keys, std::vector<Key>{{KeyAction::kStop}}) << testing::PrintToString(text);
      EXPECT_LE(polls, kSecondPolls + 2 * every_polls) << testing::PrintToString(text);
    }
  }
}

TEST(KeyParser, TakesNothingButAStopOfTextThatStalls) {
  for (const std::string& text : texts_without_end()) {
    for (const int stall_polls : {10, 65, 300, 5000}) {
      KeyParser parser;
      parser.feed(text);
      for (int i = 0; i < 3; ++i) {
        wait(parser, stall_polls);
        EXPECT_EQ(parser.feed("e m W q\n wsadrf"), std::vector<Key>{}) << testing::PrintToString(text);
      }
      wait(parser, stall_polls);
      parser.feed("\x1b[201~\x1b\\");
      EXPECT_EQ(parser.feed("e"), std::vector<Key>{{KeyAction::kEngage}}) << testing::PrintToString(text);
    }
  }
}

TEST(KeyParser, IsFreedFromTextWithoutEndByEscapeOrAStop) {
  for (const std::string key : {"\x1b", "x"}) {
    for (const std::string& text : texts_without_end()) {
      KeyParser parser;
      parser.feed(text);
      wait(parser, kSecondPolls + 1);
      EXPECT_TRUE(parser.overdue());
      parser.feed(key);
      wait(parser, kSecondPolls);
      EXPECT_FALSE(parser.overdue());
      EXPECT_EQ(parser.feed("e"), std::vector<Key>{{KeyAction::kEngage}}) << testing::PrintToString(text);
    }
  }
}

TEST(KeyParser, TakesEveryStopAfterAnyBytesAndASecond) {
  Random random(3);
  for (int round = 0; round < 3000; ++round) {
    KeyParser parser;
    std::string noise = round % 2 == 0 ? "\x1b" : "";
    for (int i = 0; i < 64; ++i) noise += static_cast<char>(random.next() & 0xff);
    parser.feed(noise);
    wait(parser, kSecondPolls + 1);
    EXPECT_EQ(parser.feed("x"), std::vector<Key>{{KeyAction::kStop}}) << "round " << round;
  }
}

}  // namespace
}  // namespace longreach::key_parser_test
