// A person at the keyboard of the real programs does the path task; `longreach task path` judges it.

#include <chrono>
#include <cmath>
#include <fstream>
#include <sstream>
#include <thread>

#include "tests/process/client_run.hpp"
#include "tests/process/terminal.hpp"
#include "tests/support/station.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::task_test {
namespace {

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> result;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) result.push_back(cell);
  return result;
}

class Task : public Station {
 protected:
  void start(const std::string& mode) {
    start_slave({"--profile", "lab", "--set", "scene_file=scenes/path.txtpb"});
    start_master({"--profile", "lab", "--operator", "keyboard", "--mode", mode, "--engage"},
                 {terminal_.inner, -1, -1});
    ASSERT_TRUE(both_engaged()) << outputs();
    const auto now = slave_.status();
    for (int i = 0; i < 3; ++i) start_m_[i] = now->tool_m(i);
  }
  std::vector<std::string> client(const std::vector<std::string>& words) {
    std::vector<std::string> all{"--master", "127.0.0.1:" + std::to_string(ports_.master_rpc), "--slave",
                                 "127.0.0.1:" + std::to_string(ports_.slave_rpc)};
    all.insert(all.end(), words.begin(), words.end());
    return all;
  }
  /// Of the tool from its start, along one axis.
  double at_m(int axis) {
    const auto now = slave_.status();
    return now && now->tool_m_size() == 3 ? now->tool_m(axis) - start_m_[axis] : NAN;
  }
  double hand_m(int axis) {
    const auto now = master_.status();
    return now && now->hand_m_size() == 3 ? now->hand_m(axis) : NAN;
  }

  /// By small steps of the hand, which is brought home with the clutch at the end of its range.
  void go_in_position_mode(int axis, double to_m) {
    const char* const key[] = {"W", "A", "R"};
    ASSERT_TRUE(eventually([&] {
      if (hand_m(axis) > 0.06) {
        terminal_.type("c ");
        EXPECT_TRUE(eventually([&] { return std::abs(hand_m(axis)) < 0.005; })) << outputs();
        terminal_.type("c");
      }
      if (at_m(axis) > to_m - 0.003) return true;
      terminal_.type(key[axis]);
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
      return false;
    })) << "axis "
        << axis << " " << outputs();
  }
  /// Holds the handle out until the tool is there.
  void go_in_rate_mode(int axis, double to_m) {
    const char* const keys[] = {"WWWW", "AAAA", "RRRR"};
    {
      const HeldKey held(terminal_.outer);
      terminal_.type(keys[axis]);
      EXPECT_TRUE(eventually([&] { return at_m(axis) > to_m - 0.004; }))
          << "axis " << axis << " " << outputs();
      terminal_.type(" ");
    }
    EXPECT_TRUE(eventually([&] { return std::abs(hand_m(axis)) < 0.003; })) << outputs();
  }
  void go(const std::string& mode) {
    std::string now = mode == "hybrid" ? "rate" : mode;
    for (const auto& [axis, to_m] : {std::pair(0, 0.12), {1, 0.12}, {2, 0.12}, {0, 0.24}}) {
      if (HasFailure()) return;
      now == "rate" ? go_in_rate_mode(axis, to_m) : go_in_position_mode(axis, to_m);
      if (mode != "hybrid" || axis != 1) continue;
      now = "position";
      terminal_.type("m");
      ASSERT_TRUE(eventually([&] { return master_.status()->mode() == now; })) << outputs();
    }
  }

  /// Follows the path while the client judges it.
  void judge(const std::string& mode) {
    const TemporaryFolder folder;
    const std::string study = (folder.path() / "study.csv").string();
    start(mode == "hybrid" ? "rate" : mode);
    ClientRun task(client({"task", "path", "--participant", "p07", "--csv", study}));
    task.read("the time begins when it leaves it");
    const auto begun = std::chrono::steady_clock::now();
    go(mode);
    task.read();
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
    ASSERT_EQ(task.status(), 0) << task.out() << task.err() << outputs();
    std::string before;
    for (int ball = 1; ball <= 3; ++ball) {
      const std::string line = "ball " + std::to_string(ball) + " of 3 passed after ";
      EXPECT_NE(task.out().find(line, before.size()), std::string::npos) << task.out();
      before = task.out().substr(0, task.out().find(line));
    }
    std::ifstream in(study);
    std::string header, row;
    ASSERT_TRUE(std::getline(in, header) && std::getline(in, row));
    const auto names = cells(header), values = cells(row);
    ASSERT_EQ(names.size(), values.size()) << row;
    const auto value = [&](const std::string& name) {
      return std::stod(values[static_cast<std::size_t>(std::ranges::find(names, name) - names.begin())]);
    };
    EXPECT_EQ(values[0] + values[1] + values[2] + values[3], "p07path1" + mode);
    EXPECT_EQ(value("finished"), 1.0);
    EXPECT_EQ(value("balls_passed"), 3.0);
    EXPECT_EQ(value("holds"), 0.0);
    EXPECT_NEAR(value("time_s"), took.count(), 3.0) << "by the clock of the test";
    EXPECT_NEAR(value("rtt_s"), 0.03, 0.03);
    // Over the corners, which are 12.4 mm beside the turns.
    EXPECT_GT(value("max_error_m"), 0.009);
    EXPECT_LT(value("max_error_m"), 0.025);
    EXPECT_LT(value("mean_error_m"), value("max_error_m"));
    if (mode == "position") EXPECT_GE(value("repositionings"), 2.0);
    if (mode == "rate") EXPECT_EQ(value("repositionings"), 0.0);
  }

  const Terminal terminal_;
  double start_m_[3] = {};
};

TEST_F(Task, ThePathIsFollowedInPositionMode) { judge("position"); }
TEST_F(Task, ThePathIsFollowedInRateMode) { judge("rate"); }
TEST_F(Task, ThePathIsFollowedInHybridMode) { judge("hybrid"); }

TEST_F(Task, AnUnfinishedTrialIsARowOfItsOwn) {
  const TemporaryFolder folder;
  const std::string study = (folder.path() / "study.csv").string();
  start("position");
  ClientRun task(client({"task", "path", "--participant", "p08", "--csv", study}));
  task.read("the time begins when it leaves it");
  terminal_.type("WWWW");
  ASSERT_TRUE(eventually([&] { return at_m(0) > 0.01; })) << outputs();
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  task.signal(SIGINT);
  task.read();
  EXPECT_EQ(task.status(), 1) << task.out();
  EXPECT_NE(task.out().find("not finished after"), std::string::npos) << task.out();
  std::ifstream in(study);
  std::string header, row;
  ASSERT_TRUE(std::getline(in, header) && std::getline(in, row));
  EXPECT_EQ(cells(row)[7], "0") << row;
}

TEST_F(Task, ASceneWithoutAPathIsRefused) {
  start_slave();
  ASSERT_TRUE(eventually([&] { return slave_.status().has_value(); })) << outputs();
  ClientRun task(client({"task", "path"}));
  task.read();
  EXPECT_EQ(task.status(), 1);
  EXPECT_NE(task.err().find("has no path"), std::string::npos) << task.err();
}

TEST(TaskOrder, IsAShuffleThatBelongsToTheParticipant) {
  const auto order = [](const std::string& participant) {
    ClientRun task({"task", "order", "--participant", participant, "--trials", "2"});
    task.read();
    EXPECT_EQ(task.status(), 0) << task.err();
    return task.out();
  };
  const std::string one = order("p01"), other = order("p02");
  EXPECT_EQ(one, order("p01"));
  EXPECT_NE(one, other);
  const auto lines = [](const std::string& text) {
    std::vector<std::string> trials;
    std::istringstream in(text);
    std::string line;
    std::getline(in, line);
    EXPECT_EQ(line, "trial,mode,link");
    while (std::getline(in, line)) trials.push_back(line.substr(line.find(',')));
    std::ranges::sort(trials);
    return trials;
  };
  EXPECT_EQ(lines(one).size(), 18u);
  EXPECT_EQ(lines(one), lines(other)) << "all of them, in another order";
}

TEST(TaskOrder, BadArgumentsAreRefused) {
  const auto refused = [](std::vector<std::string> words) {
    words.insert(words.begin(), "task");
    ClientRun task(words);
    task.read();
    EXPECT_EQ(task.status(), 2) << task.out();
    return task.err();
  };
  EXPECT_NE(refused({"order"}).find("--participant"), std::string::npos);
  EXPECT_NE(refused({"order", "--participant", "a,b"}).find("contains a comma"), std::string::npos);
  EXPECT_NE(refused({"order", "--participant", "a", "--trials", "0"}).find("whole number"),
            std::string::npos);
  EXPECT_NE(refused({"path", "--limit", "0"}).find("--limit"), std::string::npos);
  EXPECT_NE(refused({"path", "--csv", "/proc/study.csv"}).find("cannot be written"), std::string::npos);
}

}  // namespace
}  // namespace longreach::task_test
