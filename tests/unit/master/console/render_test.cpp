#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "master/console/terminal_view.hpp"
#include "master/console/words.hpp"
#include "tests/unit/master/console/touching.hpp"

namespace longreach::render_test {
namespace {

TEST(Render, SaysThatAHandleThatDoesNotTurnLeavesTheOrientation) {
  ConsoleSnapshot s;
  s.view.state = s.view.far_state = SafetyState::kEngaged;
  s.view.far_known = true;
  EXPECT_EQ(happening(s).find("orientation"), std::string::npos);
  s.turns = false;
  EXPECT_NE(happening(s).find("its orientation is constant, because this handle does not turn"),
            std::string::npos);
}

std::string without_colors(const std::string& text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\x1b') {
      i = text.find('m', i);
      continue;
    }
    plain += text[i];
  }
  return plain;
}

TEST(View, ShowsTheWholePictureOfAContact) {
  const std::string expected =
      "longreach master  21.3 s, 39 s left  operator: press\n"
      "\n"
      "touching a surface of 0.98 N/mm: 3.0 N at the hand, 2.9 N at the tool (1.3\n"
      "s ago)\n"
      "\n"
      "state     Engaged, slave Engaged\n"
      "link      RTT 2.602 s  age 2.62 s  jitter 10.1 ms  silent for 0.02 s\n"
      "datagrams 1.2 % lost, 0.0 % reordered\n"
      "mode      position, scale 0.80, kv 2/s\n"
      "\n"
      "hand at   x   +12.30  y    -0.50  z    +0.00 mm\n"
      "goal      x    +9.84  y    -0.40  z    +0.00 mm from anchor\n"
      "forecast  x    +0.00  y    +0.00  z    +0.00 mm when the robot receives it\n"
      "tool at   x  +9.8123  y  +0.0000  z  +4.2500 m  (1.3 s ago)\n"
      "\n"
      "stiffness 0.981 N/mm at the hand, slave estimates 1.002 within 0.5 %\n"
      "contact   n 1.5 within 0.02, lambda not identifiable\n"
      "hand         3.00 N [========................................] 15 N\n"
      "robot        2.90 N [========................................]\n"
      "energy    +4.60 mJ into the handle, minimum -0.12 mJ\n"
      "\n"
      "clamped   nothing\n"
      "loop      0 ticks late, 0 missed, 0 rejected\n";
  EXPECT_EQ(page(touching(), 74, false), expected);
}

TEST(View, SaysWhetherAContactIsKnown) {
  ConsoleSnapshot s = touching();
  s.view.far.estimate.valid = false;
  EXPECT_TRUE(contains(page(s, 80, false), "contact   not yet known\n"));
  s.view.in_contact = false;
  EXPECT_TRUE(contains(page(s, 80, false), "contact   none\n"));
  s.view.far_known = false;
  EXPECT_TRUE(contains(page(s, 80, false), "contact   none\n"));
}

TEST(View, SaysTheSameWithAndWithoutColor) {
  const std::string colored = page(touching(), 90, true);
  EXPECT_NE(colored, page(touching(), 90, false));
  EXPECT_EQ(without_colors(colored), page(touching(), 90, false));
}

TEST(View, KeepsWithinTheWidth) {
  ConsoleSnapshot s = touching();
  s.operator_phase = std::string(300, 'x');
  s.show_keys = true;
  s.rejected.fill(std::numeric_limits<std::uint64_t>::max());
  s.view.p_MH = Vector3::Constant(1e9);
  for (int width = 0; width < 200; width += 7) {
    std::istringstream lines(page(s, width, false));
    for (std::string line; std::getline(lines, line);) {
      EXPECT_LE(line.size(), static_cast<std::size_t>(std::max(width, 60))) << line;
    }
  }
}

TEST(View, SurvivesFiguresThatAreNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity, -infinity, 1e300, -1e300, 5e-324}) {
    ConsoleSnapshot s = touching();
    s.seconds = s.force_max_n = s.view.scale = s.view.stiffness_n_per_m = bad;
    s.seconds_left = s.link.rtt_s = bad;
    s.view.F_H_M.force.setConstant(bad);
    s.view.p_MH.setConstant(bad);
    EXPECT_GT(page(s, 80, true).size(), 100u);
    EXPECT_FALSE(contains(render_line(s), "\n"));
  }
}

TEST(View, FillsTheBarWithTheForce) {
  ConsoleSnapshot s = touching();
  const auto filled = [&s](double force_n) {
    s.view.F_H_M.force = Vector3(0.0, force_n, 0.0);
    s.view.far.F_E_W.force.setZero();
    const std::string text = page(s, 80, false);
    return std::count(text.begin(), text.end(), '=');
  };
  EXPECT_EQ(filled(0.0), 0);
  EXPECT_EQ(filled(15.0), 2 * filled(7.5));
  EXPECT_EQ(filled(1e9), filled(15.0));
}

TEST(View, LeavesOutDetailsWhereItIsTooSmallAndSaysSo) {
  ConsoleSnapshot s = touching();
  s.show_keys = true;
  for (const auto& [columns, rows] : {std::pair{60, 20}, {80, 24}, {200, 60}}) {
    const std::string text = page(s, columns, false, rows);
    EXPECT_LE(std::count(text.begin(), text.end(), '\n'), rows) << text;
    for (const char* what : {"touching a surface", "\nhand  ", "\nrobot ", "RTT 2.602", "quit"})
      EXPECT_TRUE(contains(text, what)) << columns << "x" << rows << ": " << what << "\n" << text;
    EXPECT_EQ(contains(text, "more lines need a terminal of"), rows < 24) << text;
  }
}

TEST(View, MarksWhatIsOldAsOld) {
  ConsoleSnapshot s = touching();
  s.view.far.clamps.tool_speed = true;
  EXPECT_TRUE(contains(page(s, 80, false), "robot: the tool is at its speed limit"));
  EXPECT_FALSE(contains(page(s, 80, false), "when last received"));
  s.view.silent = true;
  EXPECT_FALSE(contains(page(s, 80, false), "robot: the tool is at its speed limit"));
  EXPECT_TRUE(contains(page(s, 110, false), "when last received"));
}

TEST(Words, NameEveryStateDifferently) {
  std::vector<std::string_view> seen;
  for (int i = 0; i <= static_cast<int>(SafetyState::kFault); ++i)
    seen.push_back(state_in_words(static_cast<SafetyState>(i)));
  std::sort(seen.begin(), seen.end());
  EXPECT_EQ(std::adjacent_find(seen.begin(), seen.end()), seen.end());
  EXPECT_EQ(std::count(seen.begin(), seen.end(), "unknown"), 0);
}

TEST(Words, NameEveryClamp) {
  MasterView view;
  EXPECT_TRUE(clamps_in_words(view).empty());
  view.force_clamped = view.stiffness_clamped = view.damping_injected = true;
  view.rotational_stiffness_clamped = true;
  view.rotational_stiffness_max_nm_per_rad = 0.45;
  EXPECT_EQ(clamps_in_words(view).size(), 3u);
  EXPECT_EQ(clamps_in_words(view)[2],
            "rotational stiffness: limited to 0.45 N m/rad, the maximum that this device can render");
  view.far_known = true;
  view.far.clamps = {true, true, true, true, true, true, true, true, true};
  EXPECT_EQ(clamps_in_words(view).size(), 7u) << "a robot that keeps up is not slowed down";
  view.far.X_WE_goal.p.x() = 0.02;
  EXPECT_EQ(clamps_in_words(view).size(), 10u);
  view.far.limit_violations = 3;
  EXPECT_EQ(clamps_in_words(view).back(), "robot: 3 setpoints exceeded a limit; `longreach status` names it");
}

}  // namespace
}  // namespace longreach::render_test
