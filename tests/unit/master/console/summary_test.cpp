#include "master/console/summary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "common/core/random.hpp"

namespace longreach {
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
    view.far_known = true;
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
  ASSERT_TRUE(summary.displayed_stiffness_n_per_m.has_value());
  EXPECT_NEAR(*summary.displayed_stiffness_n_per_m, 800.0, 1e-6);
  EXPECT_NEAR(*summary.expected_stiffness_n_per_m, 800.0, 1e-9);
  EXPECT_NEAR(*summary.rtt_s, kRttS, 1e-12);
  EXPECT_NEAR(summary.engaged_s, 29.99, 1e-6);
  EXPECT_TRUE(summary.passed()) << summary.text();
  EXPECT_NE(summary.text().find("verdict: all checks hold"), std::string::npos);
}

TEST(Summary, LeavesOutClampedAndRateModeSamples) {
  const auto disturb = [](double t, MasterView& view) {
    if (std::fmod(t, 1.0) > 0.5) return;
    view.spring_force_n *= 3.0;
    if (std::fmod(t, 1.0) < 0.2)
      view.force_clamped = true;
    else if (std::fmod(t, 1.0) < 0.4)
      view.stiffness_clamped = true;
    else
      view.mode = MotionMode::kRate;
  };
  const Summary summary = probing(script(), disturb).finish({});
  EXPECT_NEAR(summary.displayed_stiffness_n_per_m.value_or(0.0), 800.0, 1e-6);
}

TEST(Summary, MeasuresOnAfterAHoldThatLeavesTheWallElsewhere) {
  const auto hold = [](double t, MasterView& view) {
    if (t < 15.0) return;
    if (t < 15.5) view.state = SafetyState::kHolding;
    view.p_MH += 0.01 * view.inward;                          // the same wall, farther in for this hand
    if (t < 15.48 + kRttS + 1.0) view.spring_force_n *= 0.5;  // not settled
  };
  const Summary summary = probing(script(), hold).finish({});
  EXPECT_NEAR(summary.displayed_stiffness_n_per_m.value_or(0.0), 800.0, 1e-6);
}

TEST(Summary, ExpectsKeTimesTheEstimate) {
  SummaryConfig config = script();
  config.ke = 2.0;
  const Summary summary = probing(config).finish({});
  EXPECT_NEAR(*summary.expected_stiffness_n_per_m, 1600.0, 1e-9);
  EXPECT_FALSE(summary.passed());
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
    EXPECT_FALSE(probing(script(), breaks[i]).finish({}).passed()) << "break " << i;
  }
}

TEST(Summary, JudgesAForceStepAgainstTheForceOfItsMoment) {
  const auto step = [](double t, MasterView& view) {
    if (t < 9.0) return;
    view.reports = 1;
    view.force_step_n = 0.3;  // 5 % of 6 N; the same figure stays while the hand lets go
    view.spring_force_n = -view.inward * (t < 9.005 ? 6.1 : 0.5);
  };
  const Summary summary = probing(SummaryConfig{}, step).finish({});
  EXPECT_NEAR(summary.force_step_max_n, 0.3, 1e-12);
  EXPECT_EQ(summary.force_step_excess_n, 0.0);
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
    EXPECT_TRUE(run.finish(last).passed());
    breaks[i](last);
    const Summary summary = run.finish(last);
    EXPECT_FALSE(summary.passed()) << "break " << i;
    EXPECT_NE(summary.text().find("FAIL"), std::string::npos);
  }
}

TEST(Summary, WarnsOfLateTicksAndDoesNotFail) {
  ConsoleSnapshot last;
  last.late_ticks = 1;
  const Summary summary = probing(script()).finish(last);
  EXPECT_TRUE(summary.passed());
  EXPECT_NE(summary.text().find("warn  1 ticks late by over 100 ms: this machine is busy"),
            std::string::npos);
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
  EXPECT_TRUE(stalled.passed()) << stalled.text();
  EXPECT_NE(stalled.text().find("the slave's control loop stalled: its machine is busy"), std::string::npos)
      << stalled.text();
  EXPECT_TRUE(hold(HoldCause::kOverrun, HoldCause::kNone).passed());
  EXPECT_TRUE(hold(HoldCause::kOperator, HoldCause::kOperator).passed());
  EXPECT_FALSE(hold(HoldCause::kLinkSilent, HoldCause::kNone).passed());
  EXPECT_FALSE(hold(HoldCause::kPeerHolds, HoldCause::kRobotFault).passed());
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
  EXPECT_FALSE(summary.passed());
  const std::string text = summary.text();
  EXPECT_NE(text.find("1 holds, 1 of them caused by a fault"), std::string::npos) << text;
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
  EXPECT_NE(text.find("FAIL  held at 6.0 s for 24.0 s: the keyboard input ended; start\n"), std::string::npos)
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

// As the slave says of every hold that the master asks for.
TEST(Summary, TheMastersOwnHoldIsNotTheOperators) {
  const auto rose = [](double t, MasterView& view) {
    if (t < 2.0 || t > 3.5) return;
    view.state = SafetyState::kHolding;
    view.cause = HoldCause::kDelayRose;
    view.far.cause = HoldCause::kPeerHolds;
  };
  EXPECT_FALSE(probing(script(), rose).finish({}).passed());
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
  EXPECT_FALSE(probing(config, silent).finish({}).passed());
  config.outages = true;
  EXPECT_TRUE(probing(config, silent).finish({}).passed());
}

TEST(Summary, NamesAWallThatIsStifferThanTheDeviceCanRender) {
  SummaryConfig config = script();
  config.wall_n_per_m = 5000.0;
  const auto cut = [](double t, MasterView& view) {
    view.stiffness_clamped = t >= kTouchS;
    view.stiffness_max_n_per_m = 1444.0;
  };
  const Summary summary = probing(config, cut).finish({});
  EXPECT_TRUE(summary.passed()) << summary.text();
  EXPECT_NE(
      summary.text().find(
          "warn  the wall is stiffer than this device can render: 5.000 N/mm was limited to 1.444 N/mm"),
      std::string::npos)
      << summary.text();
}

TEST(Summary, AsksAPersonForNoContact) {
  SummaryConfig config;
  RunSummary run(config);
  MasterView view;
  view.state = SafetyState::kEngaged;
  for (int tick = 0; tick < 100; ++tick) run.add(0.1 * tick, view, 0.03);
  EXPECT_TRUE(run.finish({}).passed());
  config.contact_expected = true;
  RunSummary scripted(config);
  for (int tick = 0; tick < 100; ++tick) scripted.add(0.1 * tick, view, 0.03);
  EXPECT_FALSE(scripted.finish({}).passed());
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
  EXPECT_FALSE(summary.passed());
}

}  // namespace
}  // namespace longreach
