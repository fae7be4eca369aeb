// How far a long command says it is: in place on a terminal, now and then elsewhere.

#include "deploy/lab/progress_line.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace longreach::progress_line_test {
namespace {

using std::chrono::milliseconds;
using Style = ProgressLine::Style;

constexpr ProgressLine::Clock::time_point kBegan{};

TEST(ProgressLine, ATerminalHasOneLineThatIsRewrittenAndLeftEmpty) {
  std::ostringstream out;
  {
    ProgressLine line(out, Style::kTerminal, kBegan);
    line.show("touch: 0 %", 0.0, kBegan);
    line.show("touch: 12 %", 0.12, kBegan + milliseconds(900));
    line.show("touch: 25 %", 0.25, kBegan + milliseconds(2000));
    line.show("touch: 100 %", 1.0, kBegan + milliseconds(8000));
    EXPECT_EQ(out.str(), "\rtouch: 0 %\033[K\rtouch: 12 %\033[K\rtouch: 25 %, 6 s to go\033[K\r\033[K");
  }
  EXPECT_TRUE(out.str().ends_with("\r\033[K\r\033[K"));  // whatever ends the command
}

TEST(ProgressLine, ElsewhereAPlainLineEveryTenSeconds) {
  std::ostringstream out;
  {
    ProgressLine line(out, Style::kPlain, kBegan);
    for (int tenth = 0; tenth <= 400; ++tenth)
      line.show("sweep: " + std::to_string(tenth) + " of 400 cells", tenth / 400.0,
                kBegan + milliseconds(100 * tenth));
  }
  EXPECT_EQ(out.str(),
            "sweep: 100 of 400 cells, 30 s to go\n"
            "sweep: 200 of 400 cells, 20 s to go\n"
            "sweep: 300 of 400 cells, 10 s to go\n");
}

TEST(ProgressLine, AShortCommandSaysNothingElsewhereAndAQuietOneNowhere) {
  std::ostringstream out;
  ProgressLine(out, Style::kPlain, kBegan).show("touch: 90 %", 0.9, kBegan + milliseconds(9900));
  ProgressLine(out, Style::kNone, kBegan).show("touch: 90 %", 0.9, kBegan + milliseconds(99000));
  EXPECT_EQ(out.str(), "");
}

}  // namespace
}  // namespace longreach::progress_line_test
