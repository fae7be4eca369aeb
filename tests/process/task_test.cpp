// A person at the keyboard of the real programs does the path task; `longreach task path` judges it.

#include <chrono>
#include <cmath>
#include <numbers>
#include <thread>

#include "tests/process/task_station.hpp"

namespace longreach::task_test {
namespace {

class Task : public TaskStation {
 protected:
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
    start("path", mode == "hybrid" ? "rate" : mode);
    if (HasFatalFailure()) return;
    ClientRun task(client({"task", "path", "--participant", "p07", "--csv", study_}));
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
    const StudyRow row(study_);
    EXPECT_EQ(row.text("participant") + row.text("task") + row.text("trial") + row.text("mode"),
              "p07path1" + mode);
    EXPECT_EQ(row.number("finished"), 1.0);
    EXPECT_EQ(row.number("balls_passed"), 3.0);
    EXPECT_EQ(row.number("holds"), 0.0);
    EXPECT_NEAR(row.number("time_s"), took.count(), 3.0) << "by the clock of the test";
    EXPECT_NEAR(row.number("rtt_s"), 0.03, 0.03);
    // Over the corners, which are 12.4 mm beside the turns.
    EXPECT_GT(row.number("max_error_m"), 0.009);
    EXPECT_LT(row.number("max_error_m"), 0.025);
    EXPECT_LT(row.number("mean_error_m"), row.number("max_error_m"));
    if (mode == "position") {
      EXPECT_GE(row.number("repositionings"), 2.0);
    } else if (mode == "rate") {
      EXPECT_EQ(row.number("repositionings"), 0.0);
    }
    expect_as_recorded(row);
  }

  /// The figures follow from the telemetry that the master recorded.
  void expect_as_recorded(const StudyRow& row) {
    const RecordedTask recorded = recording();
    const auto& all = recorded.telemetry;
    std::size_t from = 0, to = 0;
    const auto distance_m = [&](std::size_t i, const Vector3& p) {
      return (all[i].tool_m - start_m_ - p).norm();
    };
    for (std::size_t i = 0; i < all.size() && to == 0; ++i) {
      if (distance_m(i, Vector3::Zero()) <= 0.005) from = i;
      if (distance_m(i, {0.24, 0.12, 0.12}) <= 0.005) to = i;
    }
    ASSERT_GT(to, from);
    double sum = 0.0, most = 0.0;
    for (std::size_t i = from; i < to; ++i) {
      sum += (all[i + 1].t_s - all[i].t_s) * beside_m(all[i].tool_m - start_m_);
      most = std::max(most, beside_m(all[i + 1].tool_m - start_m_));
    }
    const double time_s = all[to].t_s - all[from].t_s;
    EXPECT_NEAR(row.number("time_s"), time_s, 0.2);
    EXPECT_NEAR(row.number("mean_error_m"), sum / time_s, 3e-4);
    EXPECT_NEAR(row.number("max_error_m"), most, 5e-4);
    const double most_n = recorded.force_max_n(all[from].t_s, all[to].t_s + 0.1);
    EXPECT_LE(row.number("tool_force_max_n"), most_n + 1e-6);
    EXPECT_GE(row.number("tool_force_max_n"), 0.8 * recorded.force_max_n(all[from].t_s, all[to].t_s));
  }

  /// Distance from the path of the scene, from its points every 0.2 mm.
  static double beside_m(const Vector3& p) {
    static const std::vector<Vector3> path = [] {
      constexpr double kLeg_m = 0.12, kTurn_m = 0.03;
      const std::array<int, 4> axes = {0, 1, 2, 0};
      std::vector<Vector3> points;
      Vector3 corner = Vector3::Zero();
      for (std::size_t leg = 0; leg < axes.size(); ++leg) {
        const Vector3 along = Vector3::Unit(axes[leg]);
        const double begin = leg > 0 ? kTurn_m : 0.0, end = leg + 1 < axes.size() ? kLeg_m - kTurn_m : kLeg_m;
        for (double s = begin; s <= end; s += 2e-4) points.push_back(corner + s * along);
        corner += kLeg_m * along;
        if (leg + 1 == axes.size()) continue;
        const Vector3 out = Vector3::Unit(axes[leg + 1]), centre = corner + kTurn_m * (out - along);
        for (double a = 0.0; a <= 0.5 * std::numbers::pi; a += 2e-4 / kTurn_m)
          points.push_back(centre + kTurn_m * (std::sin(a) * along - std::cos(a) * out));
      }
      return points;
    }();
    double least = 1e9;
    for (const Vector3& q : path) least = std::min(least, (q - p).norm());
    return least;
  }
};

TEST_F(Task, ThePathIsFollowedInPositionMode) { judge("position"); }
TEST_F(Task, ThePathIsFollowedInRateMode) { judge("rate"); }
TEST_F(Task, ThePathIsFollowedInHybridMode) { judge("hybrid"); }

TEST_F(Task, AnUnfinishedTrialIsARowOfItsOwn) {
  start("path", "position");
  ClientRun task(client({"task", "path", "--participant", "p08", "--csv", study_}));
  task.read("the time begins when it leaves it");
  terminal_.type("WWWW");
  ASSERT_TRUE(eventually([&] { return at_m(0) > 0.01; })) << outputs();
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  task.signal(SIGINT);
  task.read();
  EXPECT_EQ(task.status(), 1) << task.out();
  EXPECT_NE(task.out().find("not finished after"), std::string::npos) << task.out();
  EXPECT_EQ(StudyRow(study_).text("finished"), "0");
}

TEST_F(Task, ASceneWithoutTheTaskIsRefused) {
  start_slave();
  ASSERT_TRUE(eventually([&] { return slave_.status().has_value(); })) << outputs();
  ClientRun task(client({"task", "path"}));
  task.read();
  EXPECT_EQ(task.status(), 1);
  EXPECT_NE(task.err().find("has no path"), std::string::npos) << task.err();
  ClientRun dock(client({"task", "dock"}));
  dock.read();
  EXPECT_EQ(dock.status(), 1);
  EXPECT_NE(dock.err().find("has no goal for a body"), std::string::npos) << dock.err();
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
