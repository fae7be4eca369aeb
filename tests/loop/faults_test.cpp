// The campaign of faults: its oracle, its schedules, and a part of it.
#include "tests/faults/faults.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "deploy/lab/campaign_size.hpp"
#include "deploy/lab/on_all_cores.hpp"
#include "tests/faults/kind.hpp"
#include "tests/faults/trial.hpp"
#include "tests/faults/twin.hpp"
#include "tests/faults/world.hpp"

namespace longreach::faults_test {
namespace {

void expect_holds(const Tally& tally) {
  for (const Failure& f : tally.failures) {
    ADD_FAILURE() << f.violation.invariant << " at " << f.violation.t_s << " s: " << f.violation.words
                  << "; repeat it: faults --seed " << f.seed;
  }
}

TEST(Faults, NoInvariantIsViolated) {
  const Tally tally = run_faults(1, static_cast<std::uint64_t>(campaign(1000, 200)));
  expect_holds(tally);
  EXPECT_GT(tally.engaged_s, 0.5 * tally.virtual_s);
  for (const auto& [name, times] : tally.judged) EXPECT_GT(times, 0U) << name << " was never judged";
  for (const char* guard : {"slave: surface approaching", "slave: force persists", "slave: sensor sign"})
    EXPECT_TRUE(tally.guards.contains(guard)) << guard << " has never acted";
  std::printf("%.2f virtual hours, %.0f %% engaged\n", tally.virtual_s / 3600.0,
              100.0 * tally.engaged_s / tally.virtual_s);
}

TEST(Faults, TheSameSeedIsTheSameRun) {
  const auto count = static_cast<std::uint64_t>(campaign(1000, 20));
  const Tally one = run_faults(1, count), other = run_faults(1, count);
  EXPECT_EQ(one.trajectories, other.trajectories);
  EXPECT_EQ(to_text(one), to_text(other));
}

// L4, by the hour: LONGREACH_FULL has 24 of them.
TEST(Faults, NothingHoldsForHoursWhereNothingIsWrong) {
  const auto runs = static_cast<std::size_t>(campaign(24, 2));
  const double length_s = campaign(3600, 60);
  std::vector<Trial> trials(runs);
  on_all_cores(runs, [&](std::size_t i) { trials[i] = run_fault_free(i + 1, length_s); }, {});
  for (std::size_t i = 0; i < runs; ++i) {
    EXPECT_EQ(false_alarms(trials[i]), 0U) << "seed " << i + 1;
    EXPECT_GT(trials[i].engaged_s, length_s - 30.0);
    for (const Breach& v : trials[i].violations)
      ADD_FAILURE() << v.invariant << " at " << v.t_s << " s: " << v.words << ", seed " << i + 1;
  }
}

TEST(Faults, AScheduleIsReadAsItWasPrinted) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Schedule schedule = draw_schedule(seed, 0.1);
    EXPECT_EQ(to_text(parse_schedule(to_text(schedule))), to_text(schedule));
  }
  EXPECT_THROW(parse_schedule("fault no-such start_s 1 duration_s 1 size 1 seed 1"), std::runtime_error);
  EXPECT_THROW(parse_schedule("fault forged start_s x"), std::runtime_error);
}

TEST(Faults, ATallyIsReadAsItWasWritten) {
  Tally tally = run_faults(3, 1);
  tally.failures.push_back({3, {"I8", 1.5, "moved by itself"}});
  EXPECT_EQ(to_text(parse_tally(to_text(tally))), to_text(tally));
  const std::string text = to_text(tally);
  EXPECT_THROW(parse_tally(text.substr(0, text.size() / 2)), std::runtime_error);
}

// Fails while there are two faults of kinds that overlap, whatever else there is.
TEST(Faults, ShrinkingLeavesWhatMatters) {
  Schedule schedule = draw_schedule(5, 0.0);
  schedule.faults.push_back({"loss", 5.0, 4.0, 0.5, 1});
  schedule.faults.push_back({"stops", 6.0, 1.0, 0.5, 2});
  const auto both = [](const Schedule& s) -> std::optional<double> {
    const auto of = [&s](const char* kind) { return std::ranges::find(s.faults, kind, &Fault::kind); };
    if (of("loss") == s.faults.end() || of("stops") == s.faults.end()) return std::nullopt;
    return 7.0;
  };
  const Schedule least = shrink(schedule, both);
  EXPECT_EQ(least.faults.size(), 2U);
  EXPECT_LT(least.end_s, 8.0);
}

/// Whether something came later than this link ever brings it; in this tick.
bool came_late(const Moment& m, double round_trip_s) {
  constexpr double kLate_s = 0.5;
  const MotionAuthority& authority = m.sent_log->authority();
  const bool up = authority.received_s == m.t_s && m.t_s - authority.sent_s > round_trip_s + kLate_s;
  return up || (m.report_came && m.report_age_s > round_trip_s + kLate_s);
}

// What is sent when a delay has ended queues behind what was sent before: the link is as late as before.
TEST(Faults, ADelayOfTheLinkLastsUntilTheLastThatItDelayedHasCome) {
  constexpr std::uint64_t kSeed = 9000149;
  const Scenario scenario = draw_scenario(kSeed);
  for (const char* kind : {"delayed-up", "delayed-down", "delay-creeps"}) {
    const Fault fault{kind, 4.0, 4.0, 0.9, 1};
    World world(scenario, {kSeed, 60.0, 60.0, {fault}}, InjectedDefect::kNone);
    double late_s = 0.0;
    while (world.moment().t_s < 30.0) {
      const Moment& m = world.step();
      if (!came_late(m, scenario.round_trip_s)) continue;
      late_s = m.t_s;
      // A narrow link takes its time for what comes at once.
      ASSERT_LE(m.since(AffectedSignal::kLink), 0.5) << kind << " at " << m.t_s << " s";
    }
    EXPECT_GT(late_s, fault.start_s + fault.duration_s + 2.0) << kind << " does not outlast itself";
    EXPECT_GT(world.moment().since(AffectedSignal::kLink), 3.0) << kind << " has no end";
  }
}

void expect_no_violation(const std::string& schedule) {
  const Trial trial = run_trial(parse_schedule(schedule));
  for (const Breach& v : trial.violations)
    ADD_FAILURE() << v.invariant << " at " << v.t_s << " s: " << v.words;
}

// The answer to an engagement that is asked for behind a crept delay is not due yet.
TEST(Faults, AnEngagementBehindACreptDelayIsNoOmissionOfTheMaster) {
  expect_no_violation(
      "seed 9000149\nfaults_end_s 31.888864558169942\nend_s 24.432\n"
      "fault delay-creeps start_s 13.762078910393797 duration_s 5.967485942286477 "
      "size 0.9376851986042755 seed 12361378352514603005\n");
}

// Of 256 kbit/s, while a stranger repeats what was sent: what is asked for and its answer queue behind that.
TEST(Faults, FloodedLinkExcusesMissingEngagement) {
  expect_no_violation(
      "seed 8000409\nfaults_end_s 14.000474281258532\nend_s 13.518\n"
      "fault joints-leave-range start_s 3.829664667149587 duration_s 1.4254549290209775 size "
      "0.9606856169490771 "
      "seed 7025826231083212113\n"
      "fault forged start_s 6.880243162656146 duration_s 0.0024213431859560043 size 0.3343071340093223 seed "
      "11467227054087048050\n"
      "fault joints-leave-range start_s 7.911228602751622 duration_s 0.006126361479799384 size "
      "0.39843014973580104 seed 7306964946838407933\n"
      "fault joints-leave-range start_s 8.112788922156206 duration_s 0.11021367574189697 size "
      "0.7931062406504255 seed 5299426581314997696\n"
      "fault handle-quaternion start_s 10.047730425108828 duration_s 0.5523934599273883 size "
      "0.606429833911236 seed 15530837050071475440\n"
      "fault replayed start_s 10.932274669677525 duration_s 2.2417321011888616 size 0.9354425230032104 seed "
      "10374408325512986436\n");
}

// What a tank holds may have come from the store of the engagement before, which is full again.
TEST(Faults, AnEngagementThatFollowsAnotherReturnsItsOwnStoreAlone) {
  expect_no_violation(
      "seed 9000279\nfaults_end_s 23.70492561170356\nend_s 3.182\n"
      "fault joints-jump start_s 2.140010931692327 duration_s 0.000581588960771315 "
      "size 0.27942626644292545 seed 15030468188859180653\n");
}

// A sensor that is noisy for 70 ms while the hand presses lightly is no corner of surfaces that stay.
TEST(Faults, ASensorThatBecomesNoisyMakesNoSurface) {
  expect_no_violation(
      "seed 8000396\nfaults_end_s 32.31451261677095\nend_s 24.660000000000004\n"
      "fault sensor-noisy start_s 13.691836719267393 duration_s 0.06934845798952666 size 0.5695334487226067 "
      "seed 6557934335145559184\n"
      "fault slave-frozen start_s 16.393904167219887 duration_s 0.7624031600940836 size 0.35221361871602597 "
      "seed 14084627291538519210\n");
}

// A sensor that sticks for 5 ms under a light press ends no contact, which would begin elsewhere.
TEST(Faults, ASensorThatSticksEndsNoContact) {
  expect_no_violation(
      "seed 100\nfaults_end_s 12.316894587448326\nend_s 8.268\n"
      "fault sensor-stuck start_s 4.538870313654189 duration_s 0.004765058811494528 size 0.8325610423205322 "
      "seed 1186773267609567018\n"
      "fault narrow start_s 4.777107929291367 duration_s 2.509872486890292 size 0.08244891451154834 seed "
      "2514417517479460272\n");
}

TEST(Faults, ThereAreFortyKinds) {
  EXPECT_GE(fault_kinds().size(), 40U);
  std::vector<std::string_view> names;
  for (const FaultKind& kind : fault_kinds()) names.push_back(kind.name);
  std::ranges::sort(names);
  EXPECT_EQ(std::ranges::adjacent_find(names), names.end());
}

}  // namespace
}  // namespace longreach::faults_test
