// Campaigns of the laboratory: killed and started again, in shards, with cells that fail, and with mistakes.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <map>
#include <sstream>
#include <thread>

#include "tests/process/running_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::sweep_test {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

struct Ended {
  std::optional<int> status{};
  std::string output;
};

Ended lab(const std::vector<std::string>& arguments) {
  RunningProgram program("longreach-lab", arguments);
  const auto status = program.wait(std::chrono::minutes(2));
  return {status, program.output()};
}

std::string text_of(const fs::path& file) {
  std::stringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// Cells that are done, with the inodes of their files: a file that is written again is another one.
std::map<std::string, ino_t> cells_in(const fs::path& folder) {
  std::map<std::string, ino_t> cells;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder / "cells", none)) {
    struct stat status {};
    if (entry.path().extension() == ".txtpb" && ::stat(entry.path().c_str(), &status) == 0)
      cells[entry.path().filename()] = status.st_ino;
  }
  return cells;
}

/// Exit status when every cell is done, though some were too short to touch the wall.
constexpr int kNoContact = 3;

/// Two seconds of virtual time a cell: the wall is not reached.
class Sweep : public testing::Test {
 protected:
  fs::path write_grid(const std::string& more) const {
    return folder_.write("grid.txtpb",
                         "experiment: 'touch'\nsetting { path: 'duration_s' value: '2' }\n" + more);
  }
  [[nodiscard]] std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  /// Starts a campaign and sends it a signal when it has done `count` cells.
  std::optional<int> interrupt(const std::string& grid, const std::string& out, std::size_t count, int signal,
                               std::string* said = nullptr) const {
    RunningProgram program("longreach-lab", {"sweep", grid, "--out", out, "--jobs", "2"});
    while (program.running() && cells_in(out).size() < count) std::this_thread::sleep_for(milliseconds(1));
    program.signal(signal);
    const auto status = program.wait(std::chrono::minutes(1));
    if (said) *said = program.output();
    return status;
  }

  TemporaryFolder folder_;
};

TEST_F(Sweep, KilledAgainAndAgainItGoesOnAndGivesTheSameBytes) {
  const std::string grid =
      write_grid("setting { path: 'profile' value: ['lab', 'moon'] }\nseeds { from: 1 to: 8 }");
  const Ended whole = lab({"sweep", grid, "--out", path("whole"), "--jobs", "1"});
  ASSERT_EQ(whole.status, kNoContact) << whole.output;
  EXPECT_NE(whole.output.find("outcome: no contact in 16 cells\n"), std::string::npos) << whole.output;
  std::map<std::string, ino_t> done;
  for (const std::size_t count : {1u, 4u, 9u}) {
    interrupt(grid, path("killed"), count, SIGKILL);
    const auto now = cells_in(path("killed"));
    EXPECT_TRUE(std::ranges::includes(now, done)) << "a cell that was done was done again";
    done = now;
  }
  const Ended rest = lab({"sweep", grid, "--out", path("killed"), "--jobs", "2"});
  EXPECT_EQ(rest.status, kNoContact) << rest.output;
  EXPECT_TRUE(std::ranges::includes(cells_in(path("killed")), done)) << "a cell that was done was done again";
  EXPECT_EQ(text_of(path("killed/results.csv")), text_of(path("whole/results.csv")));
  EXPECT_EQ(std::ranges::count(text_of(path("whole/results.csv")), '\n'), 17);
}

TEST_F(Sweep, ShardsMergedAreOneRunByteForByte) {
  const std::string grid =
      write_grid("setting { path: 'profile' value: ['lab', 'moon'] }\nseeds { from: 1 to: 3 }");
  ASSERT_EQ(lab({"sweep", grid, "--out", path("one")}).status, kNoContact);
  ASSERT_EQ(lab({"sweep", grid, "--out", path("a"), "--shard", "1/2"}).status, kNoContact);
  EXPECT_EQ(cells_in(path("a")).size(), 3u);
  const Ended half = lab({"merge", path("a"), "--out", path("half.csv")});
  EXPECT_EQ(half.status, 1) << half.output;
  for (const char* missing :
       {"cell 1 has no result: touch duration_s=2 profile=lab seed=2\n",
        "cell 3 has no result: touch duration_s=2 profile=moon seed=1\n",
        "cell 5 has no result: touch duration_s=2 profile=moon seed=3\n", "3 of 6 cells"})
    EXPECT_NE(half.output.find(missing), std::string::npos) << half.output;
  ASSERT_EQ(lab({"sweep", grid, "--out", path("b"), "--shard", "2/2"}).status, kNoContact);
  const Ended merged = lab({"merge", "--out", path("merged.csv"), path("b"), path("a")});
  EXPECT_EQ(merged.status, 0) << merged.output;
  EXPECT_EQ(text_of(path("merged.csv")), text_of(path("one/results.csv")));
  EXPECT_GT(text_of(path("merged.csv")).size(), 1000u);
}

TEST_F(Sweep, FoldersOfOtherGridsOrCommitsAreNotMixed) {
  const std::string grid = write_grid("seeds { from: 1 to: 2 }");
  ASSERT_EQ(lab({"sweep", grid, "--out", path("a")}).status, kNoContact);
  const std::string other = folder_.write("other.txtpb", "experiment: 'touch' seeds { from: 1 to: 3 }");
  const Ended mixed = lab({"sweep", other, "--out", path("a")});
  EXPECT_EQ(mixed.status, 2) << mixed.output;
  EXPECT_NE(mixed.output.find("contains results from another grid"), std::string::npos) << mixed.output;
  fs::copy(path("a"), path("b"), fs::copy_options::recursive);
  std::string record = text_of(path("b/campaign.txtpb"));
  record.replace(0, record.find('\n'), "commit: \"0123456789ab\"");
  folder_.write("b/campaign.txtpb", record);
  const Ended merged = lab({"merge", path("a"), path("b")});
  EXPECT_EQ(merged.status, 2) << merged.output;
  EXPECT_NE(merged.output.find("its results are from commit 0123456789ab, not "), std::string::npos)
      << merged.output;
  const Ended nothing = lab({"merge", path("a"), path("c")});
  EXPECT_EQ(nothing.status, 2) << nothing.output;
  EXPECT_NE(nothing.output.find("was not written by `longreach-lab sweep`"), std::string::npos)
      << nothing.output;
}

TEST_F(Sweep, ACellThatFailsIsNamedTheOthersGoOnAndItIsTriedAgain) {
  const std::string grid =
      write_grid("setting { path: 'rendering.law' value: ['WAVE', 'STIFFNESS'] }\nseeds { from: 1 to: 2 }");
  for (const char* summary : {"4 cells: 0 were already done, 4 were run, 2 of these failed",
                              "4 cells: 2 were already done, 2 were run, 2 of these failed"}) {
    const Ended ended = lab({"sweep", grid, "--out", path("a")});
    EXPECT_EQ(ended.status, 1) << ended.output;
    for (const std::string part :
         {summary,
          "cell 0 failed: touch duration_s=2 rendering.law=WAVE seed=1: this experiment accepts only",
          "cell 1 failed: "})
      EXPECT_NE(ended.output.find(part), std::string::npos) << part << "\n" << ended.output;
  }
  const std::string table = text_of(path("a/results.csv"));
  EXPECT_NE(table.find("\n0,touch,1,2,WAVE,"), std::string::npos) << table;
  EXPECT_NE(table.find("\n3,touch,2,2,STIFFNESS,"), std::string::npos) << table;
}

TEST_F(Sweep, CtrlCKeepsWhatIsDoneAndSaysHowToGoOn) {
  const std::string grid = write_grid("seeds { from: 1 to: 100000 }");
  std::string said;
  EXPECT_EQ(interrupt(grid, path("a"), 3, SIGINT, &said), 128 + SIGINT) << said;
  const std::string done = std::to_string(cells_in(path("a")).size());
  EXPECT_EQ(said, "longreach-lab: stopped (Interrupt) with " + done +
                      " of 100000 cells done; run the same command again to resume\n");
}

TEST_F(Sweep, MistakesExitWithStatus2BeforeAnythingRuns) {
  const auto expect = [this](const std::vector<std::string>& arguments, const std::string& about) {
    const Ended ended = lab(arguments);
    EXPECT_EQ(ended.status, 2) << ended.output;
    EXPECT_EQ(std::ranges::count(ended.output, '\n'), 1) << ended.output;
    EXPECT_NE(ended.output.find(about), std::string::npos) << ended.output;
    EXPECT_FALSE(fs::exists(path("a")));
  };
  const std::string good = write_grid("");
  const std::string bad = folder_.write(
      "bad.txtpb", "experiment: 'touch'\nsetting { path: 'mapping.scale' value: '0.5' value: '7' }\n");
  expect({"sweep", bad, "--out", path("a")}, "bad.txtpb:2:46: master.mapping.scale = 7 is outside");
  const std::string unused = folder_.write(
      "unused.txtpb",
      "experiment: ['touch', 'first-touch']\nsetting { path: 'profile' value: ['lab', 'moon'] }\n");
  expect({"sweep", unused, "--out", path("a")},
         "unused.txtpb:2:11: first-touch does not use profile; it uses these settings: ");
  expect({"sweep", path("none.txtpb"), "--out", path("a")}, "none.txtpb: there is no such file");
  for (const char* shard : {"0/2", "3/2", "half"})
    expect({"sweep", good, "--out", path("a"), "--shard", shard}, std::string("--shard ") + shard);
  expect({"sweep", good, "--out", path("a"), "--jobs", "-1"}, "--jobs -1");
  expect({"sweep", good, "--out", path("a"), "--jobs", "many"}, "--jobs");
  expect({"sweep"}, "file");
  expect({"merge"}, "folders");
}

TEST_F(Sweep, ACellWithoutContactIsNoError) {
  const std::string grid =
      folder_.write("grid.txtpb",
                    "experiment: 'touch' setting { path: 'profile' value: 'lab' }\n"
                    "setting { path: 'scene_file' value: ['scenes/wall.txtpb', 'scenes/free.txtpb'] }");
  const Ended ended = lab({"sweep", grid, "--out", path("a"), "--jobs", "2"});
  EXPECT_EQ(ended.status, kNoContact) << ended.output;
  EXPECT_NE(ended.output.find("outcome: no contact in 1 cells\n"), std::string::npos) << ended.output;
  std::ifstream file(path("a/results.csv"));
  std::vector<std::map<std::string, std::string>> rows;
  std::vector<std::string> head;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::vector<std::string> row;
    for (std::string word; std::getline(words, word, ',');) row.push_back(word);
    row.resize(std::max(row.size(), head.size()));
    if (head.empty()) head = row;
    rows.emplace_back();
    for (std::size_t i = 0; i < head.size(); ++i) rows.back()[head[i]] = row[i];
  }
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[1]["contact"], "1");
  EXPECT_NE(rows[1]["displayed_stiffness_error"], "");
  EXPECT_EQ(rows[2]["contact"], "0");
  EXPECT_EQ(rows[2]["displayed_stiffness_error"], "");
}

// A stand-in for GNU parallel writes down which shards it is to run.
TEST_F(Sweep, OnAClusterHasFourShardsAHost) {
  const auto script = [this](const std::string& name, const std::string& text) {
    fs::permissions(folder_.write("bin/" + name, "#!/bin/sh\n" + text), fs::perms::owner_all);
  };
  script("parallel", "cat > " + path("shards") + "\n");
  script("lab", "exit 0\n");
  const std::string grid = write_grid("");
  folder_.write("hosts", "one\n\ntwo");
  const auto shards = [&](const std::vector<std::string>& options) {
    std::vector<std::string> words{"PATH=" + path("bin") + ":/usr/bin:/bin",
                                   std::string(LONGREACH_DEPLOY) + "/cluster/parallel",
                                   grid,
                                   "--lab",
                                   path("bin/lab"),
                                   "--out",
                                   path("out")};
    words.insert(words.end(), options.begin(), options.end());
    RunningProgram program("/usr/bin/env", words);
    EXPECT_EQ(program.wait(std::chrono::minutes(1)), 0) << program.output();
    return text_of(path("shards"));
  };
  EXPECT_EQ(shards({}), "1\n2\n3\n4\n");
  EXPECT_EQ(shards({"--hosts", path("hosts")}), "1\n2\n3\n4\n5\n6\n7\n8\n");
  EXPECT_EQ(shards({"--shards", "2"}), "1\n2\n");
}

}  // namespace
}  // namespace longreach::sweep_test
