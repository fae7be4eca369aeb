#include "master/console/summary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "common/core/random.hpp"

namespace longreach::summary_test {
namespace {

constexpr double kTouchS = 5.0;
constexpr double kRttS = 2.6;

using Change = std::function<void(double seconds, MasterView&)>;

// 30 s at 100 Hz: touches at kTouchS, then probes a spring of 800 N/m behind x = 20 mm along a slanted
// normal. Before the touch is settled the spring is another one, which must not count.
RunSummary probing(const SummaryConfig& config, const Change& change = {}) {
  RunSummary run(config);
  for (int tick = 0; tick < 3000; ++tick) {
    const double t = 0.01 * tick;
    MasterView view;
    view.state = SafetyState::kEngaged;
    view.inward = Vector3(2.0, -1.0, 2.0) / 3.0;
    view.surface_known = view.far_known = true;
    if (t >= kTouchS) {
      const double depth_m = 0.004 + 0.002 * std::sin(1.5 * t);
      const double k = t < kTouchS + kRttS + 1.0 ? 300.0 : 800.0;
      view.in_contact = true;
      view.p_MH = view.inward * (0.020 + depth_m);
      view.spring_force_n = -view.inward * (k * depth_m);
      view.far.estimate.stiffness_n_per_m = 800.0;
      view.far.estimate.valid = true;
    }
    if (change) change(t, view);
    run.add(t, view, t < 1.0 ? std::nullopt : std::optional(kRttS));
  }
  return run;
}

SummaryConfig script() {
  SummaryConfig config;
  config.contact_expected = true;
  return config;
}

TEST(Summary, MeasuresTheSpringThatTheHandFelt) {
  const Summary summary = probing(script()).finish({});
  ASSERT_EQ(summary.stiffness.judged, 1u);
  EXPECT_NEAR(summary.stiffness.worst.displayed_n_per_m, 800.0, 1e-6);
  EXPECT_NEAR(summary.stiffness.worst.estimated_n_per_m, 800.0, 1e-9);
  EXPECT_NEAR(*summary.rtt_s, kRttS, 1e-12);
  EXPECT_NEAR(summary.engaged_s, 29.99, 1e-6);
  EXPECT_NE(summary.text().find("verdict: ended well\n"), std::string::npos) << summary.text();
}

TEST(Summary, LeavesOutSamplesThatAreClampedOrLackEnergy) {
  const auto disturb = [](double t, MasterView& view) {
    if (std::fmod(t, 1.0) > 0.5) return;
    view.spring_force_n *= 3.0;
    if (std::fmod(t, 1.0) < 0.2)
      view.force_clamped = true;
    else if (std::fmod(t, 1.0) < 0.4)
      view.stiffness_clamped = true;
    else
      view.withheld_n = 1.0;
  };
  const Summary summary = probing(script(), disturb).finish({});
  EXPECT_NEAR(summary.stiffness.worst.displayed_n_per_m, 800.0, 1e-6);
}

TEST(Summary, JudgesEachStretchForItself) {
  using Part = std::function<void(MasterView&)>;
  const std::vector<Part> others = {
      [](MasterView& v) { v.engagement = 2; },
      [](MasterView& v) { v.scale = 0.5; },
      [](MasterView& v) { v.inward = -v.inward; },
      [](MasterView& v) { v.surface_m = 0.03; },
      [](MasterView& v) { v.far.estimate.stiffness_n_per_m = 1600.0; },
  };
  // From 16 s on, the hand presses on a spring of 1600 N/m elsewhere. A stretch of 1 s is not judged.
  for (std::size_t i = 0; i < others.size(); ++i) {
    const auto change = [&](double t, MasterView& view) {
      if (t < 15.0) return;
      if (t < 16.0) {
        view.mode = MotionMode::kRate;
        view.spring_force_n *= 0.2;
        return;
      }
      others[i](view);
      const double depth_m = 0.004 + 0.002 * std::sin(1.5 * t);
      view.p_MH = view.inward * (0.05 + depth_m);
      view.spring_force_n = -view.inward * (1600.0 * depth_m);
      view.far.estimate.stiffness_n_per_m = 1600.0;
    };
    const Summary summary = probing(SummaryConfig{}, change).finish({});
    EXPECT_EQ(summary.stiffness.judged, 2u) << i;
    EXPECT_NEAR(summary.stiffness.worst.error, 0.0, 1e-9) << i << "\n" << summary.text();
    EXPECT_EQ(summary.verdict(), RunVerdict::kWell) << summary.text();
  }
}

TEST(Summary, DoesNotJudgeAStretchThatIsTooShort) {
  const auto taps = [](double t, MasterView& view) {
    view.clutched = std::fmod(t, 5.0) < 0.5;  // a stretch is shorter than a round trip and 2 s
    view.spring_force_n *= 0.5;
  };
  const Summary person = probing(SummaryConfig{}, taps).finish({});
  EXPECT_EQ(person.stiffness.judged, 0u);
  EXPECT_EQ(person.verdict(), RunVerdict::kWell) << person.text();
  EXPECT_NE(person.text().find("displayed stiffness: not judged"), std::string::npos) << person.text();
  EXPECT_EQ(probing(script(), taps).finish({}).verdict(), RunVerdict::kFault) << "a script must press";
}

TEST(Summary, MeasuresOnAfterAHoldThatLeavesTheWallElsewhere) {
  const auto hold = [](double t, MasterView& view) {
    if (t < 15.0) return;
    if (t < 15.5) view.state = SafetyState::kHolding;
    view.p_MH += 0.01 * view.inward;                          // the same wall, farther in for this hand
    if (t < 15.48 + kRttS + 1.0) view.spring_force_n *= 0.5;  // not settled
  };
  const Summary summary = probing(script(), hold).finish({});
  EXPECT_EQ(summary.stiffness.judged, 2u);
  EXPECT_NEAR(summary.stiffness.worst.displayed_n_per_m, 800.0, 1e-6);
}

TEST(Summary, ExpectsKeTimesTheEstimate) {
  SummaryConfig config = script();
  config.ke = 2.0;
  const Summary summary = probing(config).finish({});
  EXPECT_NEAR(summary.stiffness.worst.estimated_n_per_m, 1600.0, 1e-9);
  EXPECT_EQ(summary.verdict(), RunVerdict::kFault);
}

TEST(Summary, FailsForEachBrokenPromise) {
  const std::vector<Change> breaks = {
      [](double, MasterView& v) { v.spring_force_n *= 1.2; },
      [](double, MasterView& v) { v.port_energy_min_j = -0.01; },
      [](double, MasterView& v) { v.energy_drawdown_j = 0.01; },
      [](double t, MasterView& v) {
        v.reports = t > 9.0 ? 1 : 0;
        v.force_step_n = t > 9.0 ? 2.0 : 0.0;
      },
      [](double, MasterView& v) { v.state = SafetyState::kObserving; },
      [](double, MasterView& v) { v.in_contact = false; },
  };
  for (std::size_t i = 0; i < breaks.size(); ++i) {
    EXPECT_EQ(probing(script(), breaks[i]).finish({}).verdict(), RunVerdict::kFault) << "break " << i;
  }
}

TEST(Summary, JudgesAForceStepAgainstTheForceOfItsMoment) {
  const auto step = [](double t, MasterView& view) {
    if (t < 9.0) return;
    view.reports = 1;
    view.force_step_n = 0.4;  // 5 % of 8 N; the same figure stays while the hand lets go
    view.spring_force_n = -view.inward * (t < 9.005 ? 8.1 : 0.5);
    view.stiffness_n_per_m = 1200.0;
  };
  const Summary summary = probing(SummaryConfig{}, step).finish({});
  EXPECT_NEAR(summary.force_step_max_n, 0.4, 1e-12);
  EXPECT_EQ(summary.force_step_excess_n, 0.0);
  EXPECT_NE(summary.text().find("0.400 N: the stiffness changed from 0.00 to 1.20 N/mm"), std::string::npos)
      << summary.text();
}

TEST(Summary, FailsForEachCounter) {
  const RunSummary run = probing(script());
  const std::vector<std::function<void(ConsoleSnapshot&)>> breaks = {
      [](ConsoleSnapshot& s) { s.view.rejected_values = 1; },
      [](ConsoleSnapshot& s) { s.rejected[static_cast<std::size_t>(Rejection::kValue)] = 1; },
      [](ConsoleSnapshot& s) { s.view.far.limit_violations = 1; },
  };
  for (std::size_t i = 0; i < breaks.size(); ++i) {
    ConsoleSnapshot last;
    last.view.far_known = true;
    EXPECT_NE(run.finish(last).verdict(), RunVerdict::kFault);
    breaks[i](last);
    const Summary summary = run.finish(last);
    EXPECT_EQ(summary.verdict(), RunVerdict::kFault) << "break " << i;
    EXPECT_NE(summary.text().find("FAIL"), std::string::npos);
  }
}

TEST(Summary, WarnsOfLateTicksAndDoesNotFail) {
  ConsoleSnapshot last;
  last.late_ticks = 1;
  const Summary summary = probing(script()).finish(last);
  EXPECT_NE(summary.verdict(), RunVerdict::kFault);
  EXPECT_NE(summary.text().find("event 1 tick late by over 100 ms: this machine is busy"), std::string::npos);
}

TEST(Summary, AttributesAHoldThatABusyMachineCaused) {
  const auto hold = [](HoldCause cause, HoldCause far) {
    return probing(script(),
                   [=](double t, MasterView& view) {
                     if (t < 2.0 || t > 3.5) return;
                     view.state = SafetyState::kHolding;
                     view.cause = cause;
                     view.far.cause = far;
                   })
        .finish({});
  };
  const Summary stalled = hold(HoldCause::kPeerHolds, HoldCause::kStalled);
  EXPECT_EQ(stalled.verdict(), RunVerdict::kEvents) << stalled.text();
  EXPECT_NE(stalled.text().find(
                "event held at 2.0 s for 1.5 s: the slave's control loop stalled: its machine is busy"),
            std::string::npos)
      << stalled.text();
  EXPECT_EQ(hold(HoldCause::kOverrun, HoldCause::kNone).verdict(), RunVerdict::kEvents);
  EXPECT_EQ(hold(HoldCause::kOperator, HoldCause::kOperator).verdict(), RunVerdict::kWell);
  EXPECT_EQ(hold(HoldCause::kLinkSilent, HoldCause::kNone).verdict(), RunVerdict::kEvents);
  EXPECT_EQ(hold(HoldCause::kDelayRose, HoldCause::kPeerHolds).verdict(), RunVerdict::kEvents);
  EXPECT_EQ(hold(HoldCause::kPeerHolds, HoldCause::kRobotFault).verdict(), RunVerdict::kEvents)
      << "a fault that is over";
}

TEST(Summary, EndsInAFaultWhereTheLastStateMustBeRepaired) {
  const auto end = [](HoldCause cause, HoldCause far, SafetyState far_state, bool silent) {
    const auto change = [=](double t, MasterView& view) {
      if (t < 20.0) return;
      view.state = SafetyState::kHolding;
      view.cause = cause;
      view.far.cause = far;
    };
    ConsoleSnapshot last;
    last.view.far_state = far_state;
    last.view.silent = silent;
    return probing(script(), change).finish(last).verdict();
  };
  using enum SafetyState;
  EXPECT_EQ(end(HoldCause::kOperator, HoldCause::kNone, kHolding, false), RunVerdict::kWell);
  EXPECT_EQ(end(HoldCause::kPeerRestarted, HoldCause::kNone, kObserving, false), RunVerdict::kEvents);
  EXPECT_EQ(end(HoldCause::kLinkSilent, HoldCause::kNone, kHolding, false), RunVerdict::kEvents);
  EXPECT_EQ(end(HoldCause::kLinkSilent, HoldCause::kNone, kHolding, true), RunVerdict::kFault);
  EXPECT_EQ(end(HoldCause::kPeerHolds, HoldCause::kRobotFault, kHolding, false), RunVerdict::kFault);
  EXPECT_EQ(end(HoldCause::kOperator, HoldCause::kNone, kFault, false), RunVerdict::kFault);
}

TEST(Summary, FailsForARunThatEndsInAFaultAndSaysWhatItIs) {
  const auto fault = [](double t, MasterView& view) {
    if (t < 6.0) return;
    view.state = SafetyState::kHolding;
    view.far_state = SafetyState::kFault;
    view.cause = {HoldCause::kJointOutside, 5, 30.0, 2.094};
    view.cause_is_far = true;
  };
  const Summary summary = probing(script(), fault).finish({});
  EXPECT_EQ(summary.verdict(), RunVerdict::kFault);
  const std::string text = summary.text();
  EXPECT_NE(text.find("; held at 6.0 s until the end: joint 5"), std::string::npos) << text;
  EXPECT_NE(text.find("joint 5 of the robot is at 30 rad (or m), beyond its limit of 2.094"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("FAIL  held at"), std::string::npos) << text;
  EXPECT_NE(text.find(" s ("), std::string::npos) << "the share of the time engaged\n" << text;
}

// As a keyboard whose input ends in the middle of a run, and one that was never there.
TEST(Summary, NamesWhatTheHandLost) {
  const auto gone = [](double t, MasterView& view) {
    if (t < 6.0) return;
    view.state = SafetyState::kFault;
    view.cause = HoldCause::kDeviceFault;
    view.far_state = SafetyState::kHolding;
    view.far.cause = HoldCause::kPeerHolds;
  };
  const RunSummary run = probing(script(), gone);
  const std::string text =
      run.finish({}, {{2.0, "another time"}, {6.02, "the keyboard input ended; start"}}).text();
  EXPECT_NE(text.find("FAIL  held at 6.0 s until the end: the keyboard input ended; start\n"),
            std::string::npos)
      << text;
  EXPECT_NE(run.finish({}, {{2.0, "another time"}}).text().find(": the haptic device reports a fault\n"),
            std::string::npos)
      << "a trouble of another time, and no echo of the slave's";

  RunSummary never({});
  MasterView view;
  view.state = SafetyState::kFault;
  for (int tick = 0; tick < 100; ++tick) never.add(0.1 * tick, view, 0.03);
  ConsoleSnapshot last;
  last.view.refusal = HoldCause::kDeviceFault;
  const std::string why = never.finish(last, {{0.0, "no keyboard is available"}}).text();
  EXPECT_NE(why.find("(0 %): no keyboard is available\n"), std::string::npos) << why;
}

TEST(Summary, SaysWhyTheRobotWasNeverEngaged) {
  RunSummary run({});
  MasterView view;
  view.state = SafetyState::kObserving;
  for (int tick = 0; tick < 100; ++tick) run.add(0.1 * tick, view, 0.03);
  ConsoleSnapshot last;
  last.view.refusal = {HoldCause::kJointLimit, 5, 2.15, 2.094};
  last.view.refusal_is_far = true;
  const std::string text = run.finish(last).text();
  EXPECT_NE(
      text.find(
          "engaged for 0.0 of 9.9 s (0 %): at the slave: joint 5 of the robot is at 2.15 rad (or m), beyond "
          "its limit of 2.094; move the joint back"),
      std::string::npos)
      << text;
}

TEST(Summary, ForgivesAnOutageThatTheProfileHas) {
  SummaryConfig config = script();
  const auto silent = [](double t, MasterView& view) {
    if (t > 2.0 && t < 3.5) view.state = SafetyState::kHolding, view.cause = HoldCause::kLinkSilent;
  };
  EXPECT_EQ(probing(config, silent).finish({}).text().find("as the link profile"), std::string::npos);
  config.outages = true;
  EXPECT_NE(probing(config, silent).finish({}).text().find("as the link profile"), std::string::npos);
  EXPECT_NE(probing(config, silent).finish({}).verdict(), RunVerdict::kFault);
}

TEST(Summary, NamesAWallThatIsStifferThanTheDeviceCanRender) {
  SummaryConfig config = script();
  config.wall_n_per_m = 5000.0;
  const auto cut = [](double t, MasterView& view) {
    view.stiffness_clamped = t >= kTouchS;
    view.stiffness_max_n_per_m = 1444.0;
  };
  const Summary summary = probing(config, cut).finish({});
  EXPECT_NE(summary.verdict(), RunVerdict::kFault) << summary.text();
  EXPECT_NE(
      summary.text().find(
          "event a surface is stiffer than this device can render: 5.000 N/mm was limited to 1.444 N/mm"),
      std::string::npos)
      << summary.text();
}

TEST(Summary, AsksAPersonForNoContact) {
  SummaryConfig config;
  RunSummary run(config);
  MasterView view;
  view.state = SafetyState::kEngaged;
  for (int tick = 0; tick < 100; ++tick) run.add(0.1 * tick, view, 0.03);
  EXPECT_NE(run.finish({}).verdict(), RunVerdict::kFault);
  config.contact_expected = true;
  RunSummary scripted(config);
  for (int tick = 0; tick < 100; ++tick) scripted.add(0.1 * tick, view, 0.03);
  EXPECT_EQ(scripted.finish({}).verdict(), RunVerdict::kFault);
}

TEST(Summary, TakesTheMedianOfTheRoundTripSoThatASpikeDoesNotShow) {
  RunSummary run({});
  MasterView view;
  for (int tick = 0; tick < 1000; ++tick) run.add(0.1 * tick, view, tick > 700 ? 12.0 : 0.8);
  EXPECT_NEAR(*run.finish({}).rtt_s, 0.8, 1e-12);
}

TEST(Summary, FailsWithoutAnyNews) {
  const Summary summary = RunSummary(SummaryConfig{}).finish({});
  EXPECT_FALSE(summary.rtt_s.has_value());
  EXPECT_EQ(summary.verdict(), RunVerdict::kFault);
}

}  // namespace
}  // namespace longreach::summary_test
