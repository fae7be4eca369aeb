#include "deploy/cli/paint.hpp"

#include <gtest/gtest.h>

#include <regex>

namespace longreach::paint_test {
namespace {

std::string without_codes(const std::string& text) {
  return std::regex_replace(text, std::regex("\x1b\\[[0-9]*m"), "");
}

TEST(Paint, StatesHaveTheirColoursAndLabelsAreDim) {
  EXPECT_EQ(painted("state    Engaged    Holding (link silent)"),
            "\x1b[2mstate\x1b[0m    \x1b[32mEngaged\x1b[0m    \x1b[33mHolding\x1b[0m (link silent)");
  EXPECT_EQ(painted("state  Fault (robot fault)"), "\x1b[2mstate\x1b[0m  \x1b[31mFault\x1b[0m (robot fault)");
  EXPECT_NE(painted("the slave does not respond at x").find("\x1b[31mdoes not respond\x1b[0m"),
            std::string::npos);
}

TEST(Paint, ChangesNoWordAndNoWidth) {
  for (const std::string row : {"", " ", "   master   slave", "state    Engaged  Engaged", "Stopped",
                                "one word", "The master reports: repair it", "label  "})
    EXPECT_EQ(without_codes(painted(row)), row);
}

}  // namespace
}  // namespace longreach::paint_test
