// An experiment that is run with a range of seeds.

#include "deploy/lab/seeds.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "common/config/config.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::seeds_test {
namespace {

std::vector<Plot> no_plots() { return {}; }

/// The second trial exceeds its bound of 10 N by the seed, if the seed is above 3, and seed 7 throws.
std::vector<Metric> run_two_trials(const ExperimentRun& run) {
  const auto seed = static_cast<double>(run.seed);
  if (run.seed == 7) throw std::runtime_error("no room");
  run.check({"first", "lead, m", 1e-3, 5e-3});
  run.check({"second", "force, N", seed > 3.0 ? 10.0 + seed : 10.0, 10.0});
  return {{"trials", 2.0, ""}, {"force_n", 100.0 - seed, "N"}};
}

constexpr Experiment kTwoTrials{.name = "two-trials",
                                .summary = "",
                                .uses = "",
                                .run = run_two_trials,
                                .plots = no_plots,
                                .trials = true};

struct Ended {
  int status;
  std::string output;
};

Ended run_with(SeedRange seeds, const std::filesystem::path& out = {}) {
  ExperimentRun run;
  run.out = out;
  testing::internal::CaptureStdout();
  const int status = run_seeds(kTwoTrials, run, seeds, false);
  return {status, testing::internal::GetCapturedStdout()};
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Seeds, AllThatPassGiveStatusZero) {
  const Ended ended = run_with({1, 3});
  EXPECT_EQ(ended.status, 0);
  EXPECT_TRUE(contains(ended.output, "seed 1: passed, 2 checks\nseed 2: passed")) << ended.output;
  EXPECT_TRUE(contains(ended.output, "0 of 3 seeds failed")) << ended.output;
  EXPECT_FALSE(contains(ended.output, "worst")) << ended.output;
}

TEST(Seeds, OneThatFailsIsNamedWithTheWorstCheck) {
  const Ended ended = run_with({2, 5});
  EXPECT_EQ(ended.status, 1);
  EXPECT_TRUE(contains(ended.output, "seed 4: failed, 1 of 2 checks\n  second: force, N: 14, permitted 10\n"))
      << ended.output;
  EXPECT_TRUE(contains(ended.output, "worst: seed 5, second: force, N: 15, permitted 10")) << ended.output;
  EXPECT_TRUE(contains(ended.output, "2 of 4 seeds failed")) << ended.output;
  const std::string row = ended.output.substr(ended.output.find("force_n"));
  EXPECT_LT(row.find("95"), row.find("98")) << row;
  EXPECT_FALSE(contains(ended.output, "trials ")) << ended.output;
}

TEST(Seeds, OneThatThrowsFailsAndTheOthersRun) {
  const Ended ended = run_with({7, 8});
  EXPECT_EQ(ended.status, 1);
  EXPECT_TRUE(contains(ended.output, "seed 7: failed: no room\nseed 8: failed, 1 of 2")) << ended.output;
}

TEST(Seeds, EachWritesItsOwnFolder) {
  const TemporaryFolder folder;
  EXPECT_EQ(run_with({1, 2}, folder.path() / "out").status, 0);
  for (const std::string seed : {"1", "2"})
    EXPECT_TRUE(exists(folder.path() / "out" / seed / "metrics.json"));
}

TEST(Seeds, ARangeIsReadOrRejected) {
  EXPECT_EQ(seed_range("71:75").first, 71U);
  EXPECT_EQ(seed_range("71:75").last, 75U);
  EXPECT_EQ(seed_range("0:0").last, 0U);
  EXPECT_EQ(seed_range("7").last, 7U);
  for (const std::string text : {"", ":", "1:", ":2", "2:1", "-1:2", "1:2:3", "a:b", "1.5:2", "1 :2",
                                 "1:200000", "0:18446744073709551615", "1:18446744073709551616"})
    EXPECT_THROW(seed_range(text), ConfigError) << text;
}

}  // namespace
}  // namespace longreach::seeds_test
