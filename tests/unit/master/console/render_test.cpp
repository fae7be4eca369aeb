#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "master/console/terminal_view.hpp"
#include "master/console/words.hpp"

namespace longreach {
namespace {

ConsoleSnapshot touching() {
  ConsoleSnapshot s;
  s.seconds = 21.26;
  s.seconds_left = 38.74;
  s.operator_phase = "press";
  s.view.state = s.view.far_state = SafetyState::kEngaged;
  s.view.far_known = true;
  s.view.scale = 0.8;
  s.view.p_MH = Vector3(0.0123, -0.0005, 0.0);
  s.view.goal_m = Vector3(0.00984, -0.0004, 0.0);
  s.view.in_contact = true;
  s.view.stiffness_n_per_m = 981.0;
  s.view.F_H_M.force = Vector3(-3.0, 0.0, 0.0);
  s.view.spring_force_n = Vector3(-3.0, 0.0, 0.0);
  s.view.port_energy_j = 4.6e-3;
  s.view.port_energy_min_j = -1.2e-4;
  s.view.far.X_WE.p = Vector3(9.8123, 0.0, 4.25);
  s.view.far.F_E_W.force = Vector3(-2.9, 0.0, 0.0);
  s.view.far.estimate.stiffness_n_per_m = 1002.0;
  s.view.far.estimate.stiffness_sd_n_per_m = 5.01;
  s.view.far.estimate.n = 1.5;
  s.view.far.estimate.n_sd = 0.02;
  s.view.far.estimate.n_verdict = Verdict::kIdentified;
  s.view.far.estimate.lambda_verdict = Verdict::kNotIdentifiable;
  s.view.far.estimate.valid = true;
  s.link.rtt_s = 2.602;
  s.link.jitter_s = 0.0101;
  s.link.loss = 0.012;
  s.link.age_s = 2.62;
  s.link.silence_s = 0.021;
  return s;
}

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

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(View, ShowsTheWholePictureOfAContact) {
  const std::string expected =
      "longreach master  21.3 s, 39 s left  operator: press\n"
      "\n"
      "contact: wall stiffness 0.98 N/mm (1.3 s ago)\n"
      "\n"
      "state     Engaged, slave Engaged\n"
      "link      RTT 2.602 s  age 2.62 s  jitter 10.1 ms  silent for 0.02 s\n"
      "datagrams 1.2 % lost, 0.0 % reordered\n"
      "mode      position, scale 0.80\n"
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
  EXPECT_EQ(render(touching(), 74, false), expected);
}

TEST(View, SaysWhetherAContactIsKnown) {
  ConsoleSnapshot s = touching();
  s.view.far.estimate.valid = false;
  EXPECT_TRUE(contains(render(s, 80, false), "contact   not yet known\n"));
  s.view.in_contact = false;
  EXPECT_TRUE(contains(render(s, 80, false), "contact   none\n"));
  s.view.far_known = false;
  EXPECT_TRUE(contains(render(s, 80, false), "contact   none\n"));
}

TEST(View, SaysTheSameWithAndWithoutColor) {
  const std::string colored = render(touching(), 90, true);
  EXPECT_NE(colored, render(touching(), 90, false));
  EXPECT_EQ(without_colors(colored), render(touching(), 90, false));
}

TEST(View, KeepsWithinTheWidth) {
  ConsoleSnapshot s = touching();
  s.operator_phase = std::string(300, 'x');
  s.show_keys = true;
  s.rejected.fill(std::numeric_limits<std::uint64_t>::max());
  s.view.p_MH = Vector3::Constant(1e9);
  for (int width = 0; width < 200; width += 7) {
    std::istringstream lines(render(s, width, false));
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
    EXPECT_GT(render(s, 80, true).size(), 100u);
    EXPECT_FALSE(contains(render_line(s), "\n"));
  }
}

TEST(View, FillsTheBarWithTheForce) {
  ConsoleSnapshot s = touching();
  const auto filled = [&s](double force_n) {
    s.view.F_H_M.force = Vector3(0.0, force_n, 0.0);
    s.view.far.F_E_W.force.setZero();
    const std::string page = render(s, 80, false);
    return std::count(page.begin(), page.end(), '=');
  };
  EXPECT_EQ(filled(0.0), 0);
  EXPECT_EQ(filled(15.0), 2 * filled(7.5));
  EXPECT_EQ(filled(1e9), filled(15.0));
}

TEST(Happening, FollowsTheRunFromTheFirstNewsToTheWall) {
  ConsoleSnapshot s;
  s.link.silence_s = std::numeric_limits<double>::infinity();
  EXPECT_EQ(happening(s), "waiting for the first datagram from the slave");
  s = touching();
  s.view.state = SafetyState::kObserving;
  EXPECT_TRUE(contains(happening(s), "engage to take control"));
  s.view.engaging = true;
  EXPECT_EQ(happening(s), "engaging: waiting for the slave's response");
  s.view.answer_in_s = 1.3;
  EXPECT_EQ(happening(s), "engaging: the slave's response is due in 1.3 s (round trip 2.60 s)");
  s.view.answer_in_s = 0.0;
  EXPECT_EQ(happening(s), "engaging: the slave's response is due (round trip 2.60 s)");
  s.view.engaging = false;
  s.view.state = SafetyState::kEngaged;
  s.view.far_state = SafetyState::kEngaged;
  s.view.in_contact = false;
  s.view.spring_force_n.setZero();
  EXPECT_EQ(happening(s), "free motion: the robot follows the hand, scaled by 0.80 (1.3 s ago)");
  s.view.in_contact = true;
  s.view.spring_force_n = Vector3(-3.0, 0.0, 0.0);
  s.view.stiffness_n_per_m = 0.0;
  EXPECT_EQ(happening(s), "contact: the slave is still measuring the wall (1.3 s ago)");
  s.view.stiffness_n_per_m = 981.0;
  EXPECT_EQ(happening(s), "contact: wall stiffness 0.98 N/mm (1.3 s ago)");
}

TEST(Happening, SaysWhichLimitKeepsTheRobotFromFollowing) {
  ConsoleSnapshot s = touching();
  s.view.in_contact = false;
  s.view.spring_force_n.setZero();
  std::vector<std::string> seen;
  for (bool Clamps::*limit :
       {&Clamps::joint_position, &Clamps::workspace, &Clamps::unreachable, &Clamps::force_guard,
        &Clamps::moment_guard, &Clamps::singularity, &Clamps::joint_speed, &Clamps::tool_speed}) {
    s.view.far.clamps = {};
    s.view.far.clamps.*limit = true;
    EXPECT_FALSE(contains(happening(s), "free motion")) << happening(s);
    EXPECT_TRUE(contains(happening(s), "(1.3 s ago)")) << happening(s);
    seen.push_back(happening(s));
  }
  std::sort(seen.begin(), seen.end());
  EXPECT_EQ(std::adjacent_find(seen.begin(), seen.end()), seen.end());
  s.view.far.X_WE_goal.p = s.view.far.X_WE.p + Vector3(0.002, 0.0, 0.0);
  EXPECT_TRUE(contains(happening(s), "free motion")) << "quick, and not behind: " << happening(s);
  s.view.far.clamps = {};
  s.view.far.clamps.joint_position = true;
  s.view.far.clamps.joint = -5;
  EXPECT_TRUE(
      contains(happening(s), "the robot cannot move further: joint 5 is at its lower limit, towards +x"))
      << happening(s);
  s.view.spring_force_n = Vector3(-3.0, 0.0, 0.0);
  s.view.far.estimate = {};
  EXPECT_TRUE(contains(render(s, 80, false), "none; the hand feels the limit of the robot"));
  s.view.in_contact = true;
  EXPECT_TRUE(contains(happening(s), "contact: ") && contains(happening(s), "at its lower limit"));
  s.view.far.engagement = s.view.engagement + 1;  // of another engagement: no news of this one
  EXPECT_FALSE(contains(happening(s), "at its lower limit"));
}

TEST(Happening, SaysHowOldTheNewsOfTheRobotIs) {
  ConsoleSnapshot s = touching();
  s.view.in_contact = false;
  s.view.spring_force_n.setZero();
  s.link.rtt_s = 0.02;
  EXPECT_FALSE(contains(happening(s), "ago"));
  s.view.far_age_s = 0.4;
  EXPECT_TRUE(contains(happening(s), "(0.4 s ago)")) << happening(s);
  EXPECT_TRUE(contains(render(s, 80, false), "m  (0.4 s ago)"));
  s.view.mode = MotionMode::kRate;
  EXPECT_TRUE(contains(happening(s), "(0.4 s ago)")) << happening(s);
}

TEST(Happening, TellsAWallThatIsRememberedFromOneThatIsTouched) {
  ConsoleSnapshot s = touching();
  s.view.in_contact = false;
  EXPECT_EQ(happening(s), "remembered wall of 0.98 N/mm; the robot is not touching it (1.3 s ago)");
}

TEST(Happening, SaysWhyTheRobotHolds) {
  ConsoleSnapshot s = touching();
  s.view.state = SafetyState::kHolding;
  s.view.cause = HoldCause::kLinkSilent;
  s.link.silence_s = 0.7;
  s.view.silent = s.view.resumes = true;
  EXPECT_EQ(happening(s), "holding: nothing received from the slave for 0.7 s");
  EXPECT_TRUE(
      contains(render(s, 80, false), "Holding, slave Engaged (no datagrams arrive from the other side)"));
  s.view.resumes = false;
  EXPECT_EQ(happening(s),
            "holding: nothing received from the slave for 0.7 s; engage when the link has "
            "recovered");
}

TEST(Happening, SaysOfASilenceThatIsOverThatItIsOver) {
  ConsoleSnapshot s = touching();
  s.view.state = SafetyState::kHolding;
  s.view.cause = HoldCause::kLinkSilent;
  s.link.silence_s = 0.0;
  s.view.hold_silence_s = 12.31;
  EXPECT_EQ(
      happening(s),
      "holding: nothing was received from the slave for 12.3 s; the link has recovered: engage to resume");
  EXPECT_TRUE(contains(render(s, 80, false), "(no datagrams arrived from the other side)"));
  s.view.resumes = true;
  EXPECT_TRUE(contains(happening(s), "the link has recovered: the robot resumes automatically"));
  s.view.state = SafetyState::kObserving;
  EXPECT_TRUE(contains(happening(s), "no datagrams arrived from the other side; check the link, then engage"))
      << happening(s);
}

TEST(Happening, SaysOfTheSlavesCauseWhereItIsAndWhetherItIsOver) {
  ConsoleSnapshot s = touching();
  s.view.state = SafetyState::kHolding;
  s.view.cause = {HoldCause::kJointOutside, 5, 30.0, 2.094};
  s.view.cause_is_far = true;
  s.view.far_state = SafetyState::kFault;
  EXPECT_TRUE(contains(happening(s),
                       "holding: at the slave: joint 5 of the robot is at 30 rad (or m), beyond its limit of "
                       "2.094; check robot_file"))
      << happening(s);
  s.view.far_state = SafetyState::kObserving;
  EXPECT_TRUE(contains(happening(s), "at the slave (now over): joint 5")) << happening(s);
}

TEST(Happening, SaysWhyAnEngagementIsNotGrantedAndWhatToDo) {
  ConsoleSnapshot s = touching();
  s.view.state = s.view.far_state = SafetyState::kObserving;
  s.view.refusal = {HoldCause::kJointLimit, 5, 2.15, 2.094};
  s.view.refusal_is_far = true;
  const std::string why =
      "at the slave: joint 5 of the robot is at 2.15 rad (or m), beyond its limit of 2.094; move the joint "
      "back with the robot's own controls, then engage";
  EXPECT_EQ(happening(s), "observing: not engaged: " + why);
  s.view.engaging = true;
  s.view.answer_in_s = 0.0;
  EXPECT_EQ(happening(s), "engaging, but not yet accepted: " + why);
  s.view.refusal = HoldCause::kUnanswered;
  s.view.refusal_is_far = false;
  EXPECT_TRUE(contains(happening(s), "the slave did not respond to the request to engage; check"))
      << happening(s);
  s.view.far_state = SafetyState::kIdle;
  EXPECT_TRUE(contains(happening(s), "the slave does not receive this master's datagrams")) << happening(s);
}

TEST(Happening, AdvisesToEngageOnlyWhereThatIsNotRefused) {
  ConsoleSnapshot s = touching();
  s.view.state = SafetyState::kObserving;
  s.view.silent = true;
  s.link.silence_s = 140.0;
  EXPECT_EQ(happening(s),
            "observing: nothing received from the slave for 140.0 s; engage when the link has recovered");
  s.view.silent = false;
  s.view.far_state = SafetyState::kFault;
  s.view.far.cause = HoldCause::kSensorFault;
  EXPECT_EQ(happening(s),
            "observing: the slave reports a fault: the force sensor reports values that no contact can "
            "cause; engage after the fault has been cleared");
}

TEST(Happening, TellsTheDelayThatAnEngagementAccepts) {
  ConsoleSnapshot s = touching();
  s.view.state = SafetyState::kHolding;
  s.view.cause = HoldCause::kDelayRose;
  EXPECT_EQ(happening(s), "holding: the link delay increased; engage to accept the new delay");
  s.view.rtt_least_s = 0.05;
  s.view.rtt_s = 25.05;
  EXPECT_EQ(happening(s),
            "holding: the round trip rose from 0.05 to 25.05 s; engage to accept the new delay");
}

TEST(View, MarksWhatIsOldAsOld) {
  ConsoleSnapshot s = touching();
  s.view.far.clamps.tool_speed = true;
  EXPECT_TRUE(contains(render(s, 80, false), "robot: the tool is at its speed limit"));
  EXPECT_FALSE(contains(render(s, 80, false), "when last received"));
  s.view.silent = true;
  EXPECT_FALSE(contains(render(s, 80, false), "robot: the tool is at its speed limit"));
  EXPECT_TRUE(contains(render(s, 110, false), "when last received"));
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
  EXPECT_EQ(clamps_in_words(view).size(), 4u);
  EXPECT_EQ(clamps_in_words(view)[2],
            "rotational stiffness: limited to 0.45 N m/rad, the maximum that this device can render");
  view.far_known = true;
  view.far.clamps = {true, true, true, true, true, true, true, true, true};
  EXPECT_EQ(clamps_in_words(view).size(), 8u) << "a robot that keeps up is not slowed down";
  view.far.X_WE_goal.p.x() = 0.02;
  EXPECT_EQ(clamps_in_words(view).size(), 11u);
  view.far.limit_violations = 3;
  EXPECT_EQ(clamps_in_words(view).back(), "robot: 3 setpoints exceeded a limit; `longreach status` names it");
}

}  // namespace
}  // namespace longreach
