// A campaign's grid, its cells in processes of their own, its folder and its table. Whole campaigns:
// tests/process/sweep_test.cpp.
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>

#include "common/config/config.hpp"
#include "deploy/lab/campaign/campaign_folder.hpp"
#include "deploy/lab/campaign/child_processes.hpp"
#include "deploy/lab/campaign/plan.hpp"
#include "deploy/lab/campaign/results.hpp"
#include "deploy/lab/campaign/sweep.hpp"
#include "deploy/lab/experiment.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/common/config/error_of.hpp"

namespace longreach::campaign_test {
namespace {

namespace fs = std::filesystem;

const fs::path kDeploy = LONGREACH_DEPLOY;

std::string text_of(const fs::path& file) {
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

proto::Campaign campaign_of(const std::string& text) {
  proto::Campaign campaign;
  load_text("grid", text, campaign);
  return campaign;
}

constexpr const char* kGrid =
    "experiment: ['touch', 'spike'] setting { path: 'profile' value: ['moon', 'lab'] }"
    "setting { path: 'mapping.scale' value: ['0.2', '0.8', '1'] } seeds { from: 3 to: 4 }";

TEST(CampaignGrid, TurnsTheSeedFastestAndTheExperimentSlowest) {
  const Grid grid(campaign_of(kGrid));
  ASSERT_EQ(grid.size(), 24u);
  EXPECT_EQ(grid.combinations(), 6u);
  EXPECT_EQ(grid.name(grid.cell(0)), "touch profile=moon mapping.scale=0.2 seed=3");
  EXPECT_EQ(grid.name(grid.cell(1)), "touch profile=moon mapping.scale=0.2 seed=4");
  EXPECT_EQ(grid.name(grid.cell(2)), "touch profile=moon mapping.scale=0.8 seed=3");
  EXPECT_EQ(grid.name(grid.cell(11)), "touch profile=lab mapping.scale=1 seed=4");
  EXPECT_EQ(grid.name(grid.cell(12)), "spike profile=moon mapping.scale=0.2 seed=3");
  EXPECT_EQ(grid.cell(12).combination, 0u);
}

TEST(CampaignGrid, CountsWhatNoProgramCouldRun) {
  proto::Campaign campaign = campaign_of("experiment: 'touch' seeds { from: 0 to: 4294967295 }");
  for (int i = 0; i < 20; ++i) {
    auto& setting = *campaign.add_setting();
    for (int v = 0; v < 100; ++v) setting.add_value(std::to_string(v));
  }
  EXPECT_EQ(Grid(campaign).size(), Grid::kCellsMax + 1);
}

TEST(CampaignGrid, GivesFieldsThatBelongTogetherTheSameValue) {
  const Grid grid(
      campaign_of("experiment: 'touch' setting { path: 'master.link.impairment.delay_s' "
                  "also: 'slave.link.impairment.delay_s' value: ['0.1', '0.2'] }"));
  ASSERT_EQ(grid.size(), 2u);
  EXPECT_EQ(grid.settings(grid.cell(1)), (std::vector<std::string>{"master.link.impairment.delay_s=0.2",
                                                                   "slave.link.impairment.delay_s=0.2"}));
}

TEST(ConfigHash, DependsOnWhatIsEffectiveAlone) {
  const auto hash = [](const std::vector<std::string>& settings) {
    return config_hash(configure(settings, kDeploy));
  };
  EXPECT_EQ(hash({}), hash({"profile=moon", "operator.press_n=3", "robot_file=robots/space_arm.txtpb"}));
  EXPECT_EQ(hash({}), hash({"scene_file=" + (kDeploy / "scenes/wall.txtpb").string()}));
  for (const std::string other : {"profile=lab", "operator.press_n=4", "duration_s=30",
                                  "scene.material.wall.stiffness_n_per_m=999", "robot.joint.1.d_m=1e-9"})
    EXPECT_NE(hash({}), hash({other})) << other;
}

TEST(CampaignPlan, FindsFilesBesideTheGrid) {
  const TemporaryFolder folder;
  folder.write("mine.txtpb", "up { delay_s: 1.5 }");
  const fs::path file = folder.write(
      "grid.txtpb", "experiment: 'touch' setting { path: 'profile' value: ['mine.txtpb', 'moon'] }");
  EXPECT_EQ(error_of([&] { static_cast<void>(load_plan(file, kDeploy)); }), "no error");
}

TEST(CampaignPlan, RefusesEveryMistakeWithItsPlace) {
  const TemporaryFolder folder;
  const std::map<std::string, std::string> mistakes = {
      {"# nothing\n", ": the file must name at least one experiment"},
      {"experiment: 'toch'", ":1:1: unknown experiment \"toch\"; did you mean \"touch\"?"},
      {"experiment: 'touch'\nexperiment: 'touch'", ":2:1: experiment \"touch\" is given twice"},
      {"experiment: 'touch'\nsetting { value: '1' }", ":2:1: the setting has no path"},
      {"experiment: 'touch'\nsetting { path: 'profile' }", ":2:1: setting \"profile\" has no value"},
      {"experiment: 'touch'\nsetting {\n path: 'profile' value: 'moon'\n value: 'moon'\n}",
       ":4:2: setting \"profile\" contains the value \"moon\" twice"},
      {"experiment: 'touch'\nsetting { path: 'profile' value: 'moon' value: 'mars' }",
       ":2:41: there is no link profile \"mars\""},
      {"experiment: 'touch'\nsetting { path: 'no.such' value: '1' }", ":2:27: neither the laboratory nor"},
      {"experiment: 'touch'\nsetting { path: 'profile' value: 'lab' }\n"
       "setting { path: 'mapping.scale' value: '0.2' value: '7' }",
       ":3:46: master.mapping.scale = 7 is outside"},
      {"experiment: 'touch'\nsetting { path: 'mapping.scale' value: '0.2' }\n"
       "setting { path: 'master.mapping.scale' value: '0.3' }",
       ":3:11: setting \"master.mapping.scale\" is given twice"},
      {"experiment: 'touch'\nsetting { path: 'mapping.scale' also: 'mapping.scale' value: '0.2' }",
       ":2:33: setting \"mapping.scale\" is given twice, as master.mapping.scale"},
      {"experiment: 'touch'\nsetting { path: 'duration_s' value: '2' }\n"
       "setting { path: 'mapping.scale' also: 'operator.press_n' value: '1' value: '0.25' }",
       ":3:69: master.operator.press_n = 0.25 is outside"},
      {"experiment: 'touch'\nseeds { from: 3 to: 2 }", ":2:1: seeds.from = 3 is greater than seeds.to = 2"},
      {"experiment: 'touch'\nseed { from: 3 }", ":2:1: "},
      {"experiment: 'touch'\nseeds { from: -3 }", ":2:15: "},
      {"experiment: 'touch'\nseeds { to: 100001 }", ": the grid has more than 100000 cells"}};
  for (const auto& [text, about] : mistakes) {
    const fs::path file = folder.write("grid.txtpb", text);
    const std::string error = error_of([&] { static_cast<void>(load_plan(file, kDeploy)); });
    EXPECT_TRUE(error.starts_with(file.string() + about)) << text << "\n" << error;
  }
}

TEST(CampaignPlan, OfTheGridThatShips) {
  const Plan plan = load_plan(kDeploy / "cluster/walls.txtpb", kDeploy);
  EXPECT_EQ(plan.grid.size(), 320u);
  EXPECT_EQ(plan.configs.size(), 64u);
}

TEST(CampaignShard, IsOneOfSeveral) {
  EXPECT_EQ(parse_shard("2/4").index, 2u);
  EXPECT_EQ(parse_shard("2/4").count, 4u);
  for (const char* text : {"", "1", "0/4", "5/4", "1/0", "a/4", "1/4x", "-1/4", "1/99999999999999999999"})
    EXPECT_THROW(static_cast<void>(parse_shard(text)), ConfigError) << text;
}

TEST(ChildProcesses, AJobThatThrowsAbortsOrCrashesFailsAloneAndSaysWhy) {
  std::map<std::size_t, std::string> ended;
  const ChildWork work{.run =
                           [](std::size_t job) {
                             if (job == 1) throw std::runtime_error("no such wall");
                             if (job == 2) std::fprintf(stderr, "before\nit is broken\n"), std::abort();
                             if (job == 3) raise(SIGKILL);
                             if (job == 4) _exit(7);
                           },
                       .ended = [&](std::size_t job, const std::string& why) { ended[job] = why; },
                       .waited = [] {}};
  EXPECT_EQ(run_in_children({0, 1, 2, 3, 4, 5}, 2, work), 0);
  const std::map<std::size_t, std::string> expected = {
      {0, ""},
      {1, "no such wall"},
      {2, "the process was terminated by a signal (Aborted): it is broken"},
      {3, "the process was terminated by a signal (Killed)"},
      {4, "the process failed without an error message"},
      {5, ""}};
  EXPECT_EQ(ended, expected);
}

TEST(ChildProcesses, ASignalEndsAllOfThemAtOnce) {
  std::size_t ended = 0;
  const ChildWork work{.run =
                           [](std::size_t job) {
                             if (job == 2) kill(getppid(), SIGTERM);
                             if (job > 0) pause();
                           },
                       .ended = [&](std::size_t, const std::string&) { ++ended; },
                       .waited = [] {}};
  EXPECT_EQ(run_in_children({0, 1, 2, 3}, 2, work), SIGTERM);
  EXPECT_LE(ended, 1u);
}

proto::CampaignRecord record_of(const std::string& commit) {
  proto::CampaignRecord record;
  record.set_commit(commit);
  *record.mutable_campaign() = campaign_of(
      "experiment: 'touch' setting { path: 'start' value: ['1,2', 'a \"b\"'] } seeds { from: 1 to: 2 }");
  return record;
}

proto::CellRecord result_of(double value) {
  proto::CellRecord result;
  result.set_config("00ff");
  result.set_spent_s(0.25);
  auto& depth = *result.add_metric();
  depth.set_name("depth_m");
  depth.set_value(value);
  auto& step = *result.add_metric();
  step.set_name("step_us");
  step.set_value(3.0);
  step.set_of_machine(true);
  return result;
}

TEST(CampaignFolderTest, AResultThatIsCutIsNone) {
  const TemporaryFolder temporary;
  const CampaignFolder folder(temporary.path() / "a", record_of("c1"));
  folder.write(0, result_of(0.1));
  ASSERT_TRUE(folder.result(0));
  EXPECT_FALSE(folder.result(1));
  const fs::path file = temporary.path() / "a/cells/0.txtpb";
  const std::string whole = text_of(file);
  for (std::size_t size = 0; size < whole.find("true", whole.find("complete")); ++size) {
    std::ofstream(file, std::ios::binary) << whole.substr(0, size);
    ASSERT_FALSE(folder.result(0)) << size;
  }
}

TEST(CampaignFolderTest, OfAnotherCampaignIsRefused) {
  const TemporaryFolder temporary;
  const fs::path a = temporary.path() / "a", b = temporary.path() / "b";
  const CampaignFolder ours(a, record_of("c1")), others(b, record_of("c2"));
  ours.write(0, result_of(0.1));
  EXPECT_EQ(error_of([&] { CampaignFolder(a, record_of("c1")); }), "no error");
  EXPECT_EQ(error_of([&] { CampaignFolder(a, record_of("c2")); }),
            a.string() + " contains results from commit c1, not c2; choose another folder with --out");
  proto::CampaignRecord changed = record_of("c1");
  changed.mutable_campaign()->mutable_seeds()->set_to(3);
  EXPECT_NE(error_of([&] { CampaignFolder(a, changed); }).find("from another grid"), std::string::npos);
  changed = record_of("c1");
  changed.set_full(true);
  EXPECT_NE(error_of([&] { CampaignFolder(a, changed); }).find("LONGREACH_FULL"), std::string::npos);
  changed = record_of("c1");
  changed.set_configs("77");
  EXPECT_NE(error_of([&] { CampaignFolder(a, changed); }).find("deploy/"), std::string::npos);
  fs::copy(a / "cells/0.txtpb", b / "cells/0.txtpb");
  EXPECT_NE(error_of([&] { static_cast<void>(others.result(0)); }).find("belongs to another campaign"),
            std::string::npos);
}

TEST(CampaignResults, StoreTimesSeparatelyAndKeepRowsWithoutResult) {
  const TemporaryFolder temporary;
  const proto::CampaignRecord record = record_of("c1");
  CellResults results(4);
  results[0] = result_of(0.1);
  results[3] = result_of(std::numeric_limits<double>::quiet_NaN());
  const fs::path file = temporary.path() / "r.csv";
  write_results(file, record, results);
  EXPECT_EQ(text_of(file),
            "cell,experiment,seed,set.start,commit,config,depth_m\n"
            "0,touch,1,\"1,2\",c1,00ff,0.1\n"
            "1,touch,2,\"1,2\",c1,,\n"
            "2,touch,1,\"a \"\"b\"\"\",c1,,\n"
            "3,touch,2,\"a \"\"b\"\"\",c1,00ff,nan\n");
  EXPECT_EQ(text_of(temporary.path() / "r.times.csv"),
            "cell,experiment,seed,set.start,commit,config,spent_s,step_us\n"
            "0,touch,1,\"1,2\",c1,00ff,0.25,3\n"
            "1,touch,2,\"1,2\",c1,,,\n"
            "2,touch,1,\"a \"\"b\"\"\",c1,,,\n"
            "3,touch,2,\"a \"\"b\"\"\",c1,00ff,0.25,3\n");
}

}  // namespace
}  // namespace longreach::campaign_test
