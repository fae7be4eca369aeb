// The sentences of the situations.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/unit/master/console/touching.hpp"

namespace longreach::happening_test {
namespace {

TEST(Happening, FollowsTheRunFromTheFirstNewsToTheWall) {
  ConsoleSnapshot s;
  s.link.silence_s = std::numeric_limits<double>::infinity();
  EXPECT_EQ(happening(s), "waiting for the first answer of the slave");
  s.expected_rtt_s = 2.6;
  EXPECT_EQ(happening(s), "waiting for the first answer of the slave (2.6 s)");
  s = touching();
  s.view.state = SafetyState::kObserving;
  EXPECT_TRUE(contains(happening(s), "engage to take control"));
  s.view.engaging = true;
  EXPECT_EQ(happening(s), "waiting for the first answer of the slave (2.6 s)");
  s.view.answer_in_s = 1.3;
  EXPECT_EQ(happening(s), "engaging: the slave's answer is due in 1.3 s (round trip 2.60 s)");
  s.view.answer_in_s = 0.0;
  EXPECT_EQ(happening(s), "engaging: the slave's answer is due (round trip 2.60 s)");
  s.view.engaging = false;
  s.view.state = SafetyState::kEngaged;
  s.view.far_state = SafetyState::kEngaged;
  s.view.in_contact = false;
  s.view.spring_force_n.setZero();
  EXPECT_EQ(happening(s), "free motion: the robot follows the hand, scaled by 0.80 (1.3 s ago)");
  s.view.in_contact = true;
  s.view.spring_force_n = Vector3(-3.0, 0.0, 0.0);
  s.view.surface_n_per_m = 0.0;
  EXPECT_EQ(
      happening(s),
      "touching a surface whose stiffness is not known yet: 3.0 N at the hand, 2.9 N at the tool (1.3 s ago)");
  s.view.stiffness_n_per_m = s.view.surface_n_per_m = 981.0;
  EXPECT_EQ(happening(s),
            "touching a surface of 0.98 N/mm: 3.0 N at the hand, 2.9 N at the tool (1.3 s ago)");
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
  EXPECT_TRUE(contains(page(s, 80, false), "none; the hand feels the limit of the robot"));
  EXPECT_TRUE(contains(happening(s), "the hand feels 3.0 N")) << happening(s);
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
  EXPECT_TRUE(contains(page(s, 80, false), "m  (0.4 s ago)"));
  s.view.mode = MotionMode::kRate;
  EXPECT_TRUE(contains(happening(s), "(0.4 s ago)")) << happening(s);
}

TEST(Happening, TellsAWallThatIsRememberedFromOneThatIsTouched) {
  ConsoleSnapshot s = touching();
  s.view.in_contact = false;
  EXPECT_EQ(happening(s),
            "the hand feels a surface of 0.98 N/mm with 3.0 N; the robot does not touch it (1.3 s ago)");
  s.view.spring_force_n = Vector3(-0.01, 0.0, 0.0);  // it has faded
  EXPECT_TRUE(contains(happening(s), "free motion")) << happening(s);
}

TEST(Happening, AsksForTheHandleToBeBroughtHome) {
  ConsoleSnapshot s = touching();
  s.link.rtt_s = 0.02;
  s.view.mode = MotionMode::kRate;
  s.view.bring_home = s.view.turn_home = true;
  EXPECT_EQ(happening(s),
            "bring the handle home: until then, rate mode does not move the robot; it presses with 2.9 N");
  s.view.in_contact = false;
  EXPECT_EQ(happening(s), "bring the handle home: until then, rate mode does not move the robot");
  s.view.bring_home = false;
  EXPECT_EQ(happening(s), "turn the handle home: until then, rate mode does not turn the robot");
  EXPECT_EQ(text_of(situation_of(s)).key, "bring the handle home");
  s.view.turn_home = false;
  EXPECT_FALSE(contains(happening(s), "home"));
}

ConsoleSnapshot holding(const Reason& cause) {
  ConsoleSnapshot s = touching();
  s.view.state = s.view.far_state = SafetyState::kHolding;
  s.view.cause = cause;
  return s;
}

TEST(Happening, SaysWhyTheRobotHolds) {
  ConsoleSnapshot s = holding(HoldCause::kLinkSilent);
  s.link.silence_s = 0.7;
  s.view.silent = s.view.resumes = true;
  EXPECT_EQ(happening(s), "nothing received from the slave for 0.7 s: the robot holds");
  EXPECT_TRUE(
      contains(page(s, 80, false), "Holding, slave Holding (no datagrams arrive from the other side)"));
  s.view.resumes = false;
  EXPECT_EQ(happening(s),
            "nothing received from the slave for 0.7 s: the robot holds; engage when the link has recovered");
  s = holding(HoldCause::kPeerHolds);
  EXPECT_EQ(
      happening(s),
      "holding: the other side holds; check the other side, then engage; it presses with 2.9 N (1.3 s ago)");
  s.view.in_contact = false;
  EXPECT_EQ(happening(s), "holding: the other side holds; check the other side, then engage (1.3 s ago)");
}

TEST(Happening, SaysOfASilenceThatIsOverThatItIsOver) {
  ConsoleSnapshot s = holding(HoldCause::kLinkSilent);
  s.view.in_contact = false;
  s.link.rtt_s = 0.01;
  s.link.silence_s = 0.0;
  s.view.hold_silence_s = 12.31;
  EXPECT_EQ(
      happening(s),
      "holding: nothing was received from the slave for 12.3 s; the link has recovered: engage to resume");
  EXPECT_TRUE(contains(page(s, 80, false), "(no datagrams arrived from the other side)"));
  s.view.resumes = true;
  EXPECT_TRUE(contains(happening(s), "the link has recovered: the robot resumes automatically"));
}

TEST(Happening, SaysThatTheSlaveWasRestarted) {
  const ConsoleSnapshot s = holding(HoldCause::kPeerRestarted);
  EXPECT_EQ(situation_of(s), Situation::kRestarted);
  EXPECT_TRUE(
      contains(happening(s), "the slave was restarted, and known surfaces are gone; engage to resume"));
}

TEST(Happening, SaysOfTheSlavesCauseWhereItIsAndWhetherItIsOver) {
  ConsoleSnapshot s = holding({HoldCause::kJointOutside, 5, 30.0, 2.094});
  s.view.cause_is_far = true;
  s.view.far_state = SafetyState::kFault;
  EXPECT_TRUE(contains(happening(s),
                       "fault: at the slave: joint 5 of the robot is at 30 rad (or m), beyond its limit of "
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
  EXPECT_EQ(happening(s), "not engaged: " + why);
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
  EXPECT_EQ(
      happening(s),
      "nothing received from the slave for 140.0 s: the robot holds; engage when the link has recovered");
  s.view.silent = false;
  s.view.far_state = SafetyState::kFault;
  s.view.far.cause = HoldCause::kSensorFault;
  EXPECT_EQ(happening(s),
            "fault at the slave: the force sensor reports values that no contact can cause; engage after the "
            "fault has been cleared");
}

TEST(Happening, TellsTheDelayThatAnEngagementAccepts) {
  ConsoleSnapshot s = holding(HoldCause::kDelayRose);
  s.view.in_contact = false;
  s.link.rtt_s = 0.01;
  EXPECT_EQ(happening(s), "holding: the link delay increased; engage to accept the new delay");
  s.view.rtt_least_s = 0.05;
  s.view.rtt_s = 25.05;
  EXPECT_EQ(happening(s),
            "holding: the round trip rose from 0.05 to 25.05 s; engage to accept the new delay");
}

TEST(Happening, SaysWhoStoppedTheRobot) {
  ConsoleSnapshot s = holding(HoldCause::kOperator);
  s.view.state = SafetyState::kStopped;
  EXPECT_TRUE(contains(happening(s), "stopped by the operator or a client; engage to resume"))
      << happening(s);
  s.view.cause_is_far = true;
  EXPECT_TRUE(contains(happening(s), "stopped at the slave; engage to resume")) << happening(s);
}

TEST(Happening, SaysWhatIsFeltLessAndWhoDoesNotHold) {
  ConsoleSnapshot s = touching();
  s.view.withheld_n = 6.0;
  EXPECT_EQ(
      happening(s),
      "touching a surface of 0.98 N/mm, felt less: 3.0 of 9.0 N at the hand, 2.9 N at the tool (1.3 s ago)");
  s.view.held = false;
  EXPECT_EQ(happening(s),
            "no hand is on the handle; the robot stays in place; it presses with 2.9 N (1.3 s ago)");
  s.view.held = true;
  s.view.spring_force_n.setZero();
  s.view.withheld_n = 0.0;
  s.view.surface_known = true;
  s.view.inward = Vector3::UnitX();
  s.view.surface_m = 0.02;
  EXPECT_EQ(
      happening(s),
      "the hand has left the surface; the robot follows 1.3 s later: 0.0 N at the hand, 2.9 N at the tool "
      "(1.3 s ago)");
}

}  // namespace
}  // namespace longreach::happening_test
