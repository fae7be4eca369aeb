// Simulated operators on the path task: their draws, their ways, a trial in each way of working, and the
// figures that compare them.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "common/config/config.hpp"
#include "deploy/lab/campaign_size.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/mapping/path_results.hpp"
#include "slave/config/path.hpp"

namespace longreach::path_task_test {
namespace {

const proto::LabConfig& task() {
  static const proto::LabConfig config = path_task_config(configure({}, LONGREACH_DEPLOY));
  return config;
}

// Hollander and Wolfe, Nonparametric Statistical Methods (1973), p. 29: depression before and after therapy.
TEST(SignedRank, IsTheTextbooksProbability) {
  const std::array before = {1.83, 0.50, 1.62, 2.48, 1.68, 1.88, 1.55, 3.06, 1.30};
  const std::array after = {0.878, 0.647, 0.598, 2.05, 1.06, 1.29, 1.06, 3.14, 1.29};
  const auto d = paired({before.begin(), before.end()}, {after.begin(), after.end()});
  EXPECT_NEAR(signed_rank_p(d), 0.0390625, 1e-12);
  EXPECT_NEAR(signed_rank_p(std::array{1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0}), 2.0 / 256.0, 1e-15);
  EXPECT_NEAR(signed_rank_p(std::array{-1.0, -1.0, -1.0, 0.0, -1.0, -1.0}), 2.0 / 32.0, 1e-15);
  EXPECT_EQ(signed_rank_p(std::array{1.0, -1.0, 1.0}), 1.0);
  EXPECT_EQ(signed_rank_p(std::array{0.0, 0.0}), 1.0);
}

TEST(Spread, IsMeanDeviationAndQuartiles) {
  const Spread s = spread_of(std::array{4.0, 1.0, 3.0, 2.0});
  EXPECT_DOUBLE_EQ(s.mean, 2.5);
  EXPECT_NEAR(s.sd, 1.2909944487358056, 1e-15);
  EXPECT_DOUBLE_EQ(s.low, 1.75);
  EXPECT_DOUBLE_EQ(s.median, 2.5);
  EXPECT_DOUBLE_EQ(s.high, 3.25);
}

TEST(PathPerson, IsDrawnAsTheModelSays) {
  std::vector<double> reaction, aim, bit, spread;
  for (int i = 0; i < 4000; ++i) {
    const PathPerson p = PathPerson::draw(Random(1).child("person " + std::to_string(i)));
    reaction.push_back(p.reaction_s);
    aim.push_back(p.aim_s);
    bit.push_back(p.aim_s_per_bit);
    spread.push_back(std::log(p.spread / 0.11));
  }
  const auto expect = [](const std::vector<double>& sample, double mean, double sd) {
    EXPECT_NEAR(spread_of(sample).mean, mean, 0.06 * sd);
    EXPECT_NEAR(spread_of(sample).sd, sd, 0.05 * sd);
  };
  expect(reaction, 0.25, 0.04);
  expect(aim, 0.25, 0.05);
  expect(bit, 0.07, 0.015);
  expect(spread, 0.0, 0.25);
}

TEST(PathCourse, HasThePiecesOfTheSceneInAnotherOrder) {
  const PathConfig scene = to_struct(task().slave()).scene.path.value();
  const double length_m = Path(scene, Vector3::Zero()).length_m();
  std::set<double> first_corners;
  for (int person = 0; person < 20; ++person) {
    const PathCourse course = course_of(task(), {.person = person});
    const Path path(course.path, Vector3::Zero());
    ASSERT_NEAR(course.length_m, length_m, 1e-12);
    EXPECT_NEAR(path.length_m(), length_m, 1e-12);
    int targets = 0;
    double along_m = 0.0;
    for (const PathAim& aim : course.aims) {
      const Path::Place place = path.place(aim.at_m);
      EXPECT_LT(place.distance_m, 1e-12);
      EXPECT_GT(place.along_m, along_m);
      along_m = place.along_m;
      targets += aim.target;
    }
    EXPECT_EQ(targets, 7);
    EXPECT_NEAR(along_m, length_m, 1e-12);
    first_corners.insert(course.path.waypoint[1].point_m.x());
  }
  EXPECT_GT(first_corners.size(), 3u);
}

// Four legs of 120 mm with three quarter turns of 30 mm; the handle moves the robot by 0.8 times 75 mm.
TEST(PathCourse, ItsSizeIsStatedInReachesOfTheHandle) {
  const double length_m = 4 * 0.12 - 3 * (2 - 0.5 * std::numbers::pi) * 0.03;
  EXPECT_NEAR(reaches_of(task(), {}), length_m / 0.06, 1e-9);
  EXPECT_NEAR(reaches_of(task(), {.size = 2.0, .person = 3}), 2.0 * length_m / 0.06, 1e-9);
  EXPECT_NEAR(course_of(task(), {.size = 2.0}).path.turn_radius_m, 0.06, 1e-12);
}

TEST(PathTask, TransferringOnlyTheTranslationTurnsTheGoalLess) {
  PathCase c{.rtt_s = 0.225};
  const PathResult still = run_path_trial(task(), c);
  EXPECT_LT(still.turned_rad, 1e-3);
  c.turns_rad = 0.05;
  const PathResult both = run_path_trial(task(), c);
  c.simultaneous = SimultaneousMotion::kTranslation;
  const PathResult translation = run_path_trial(task(), c);
  EXPECT_TRUE(still.finished && both.finished && translation.finished);
  EXPECT_GT(both.turned_rad, 0.03);
  EXPECT_LT(translation.turned_rad, 0.8 * both.turned_rad);
}

TEST(PathTask, HybridBeatsPositionInTimeAndRateInAccuracy) {
  constexpr double kRtt_s = 1.5;
  const PathSize size{.persons = 4, .trials = 1};
  const auto sample = [&](PathStrategy strategy, double rtt_s, bool ghost) {
    const PathSample s = sample_paths(task(), {.strategy = strategy, .rtt_s = rtt_s, .ghost = ghost}, size);
    EXPECT_EQ(s.unfinished, 0);
    for (const double e : s.target_error_m) EXPECT_LT(e, 0.002);
    for (const double e : s.error_m) EXPECT_LT(e, 0.01);
    return s;
  };
  const PathSample near = sample(PathStrategy::kPosition, 0.0, false);
  const PathSample position = sample(PathStrategy::kPosition, kRtt_s, false);
  const PathSample rate = sample(PathStrategy::kRate, kRtt_s, false);
  const PathSample hybrid = sample(PathStrategy::kHybrid, kRtt_s, false);
  const PathSample ghost = sample(PathStrategy::kPosition, kRtt_s, true);
  EXPECT_GT(position.relocations, 3.0);
  EXPECT_LT(hybrid.relocations, 1.0);
  EXPECT_GT(spread_of(paired(position.time_s, hybrid.time_s)).mean, 0.0);
  EXPECT_GT(spread_of(paired(rate.error_m, hybrid.error_m)).mean, 0.0);
  for (int i = 0; i < size.persons; ++i) {
    EXPECT_GT(position.time_s[i], 2.0 * near.time_s[i]) << i;
    EXPECT_LT(position.time_s[i], 3.0 * near.time_s[i]) << i;
    EXPECT_LT(ghost.time_s[i], 1.1 * near.time_s[i]) << i;
  }
}

// Few operators: no mean is surely outside, by twice its standard error.
TEST(PathTask, TheDelaySlowsDownEachWayOfWorkingAsTheModelsBandsSay) {
  struct Band {
    double rtt_s, least, most;
    int persons;
  };
  for (const PathStrategy strategy : {PathStrategy::kRate, PathStrategy::kPosition, PathStrategy::kHybrid}) {
    const auto times = [&](double rtt_s, int persons) {
      const PathSample s =
          sample_paths(task(), {.strategy = strategy, .rtt_s = rtt_s}, {.persons = persons, .trials = 1});
      EXPECT_EQ(s.unfinished, 0);
      return s.time_s;
    };
    const int many = campaign(100, 24), few = campaign(100, 4);
    const std::vector<double> near = times(0.0, many);
    for (const Band& band : {Band{0.225, 1.3, 1.8, many}, {1.5, 2.0, 3.0, few}, {2.6, 2.3, 4.5, few}}) {
      std::vector<double> slow_down = times(band.rtt_s, band.persons);
      for (std::size_t i = 0; i < slow_down.size(); ++i) slow_down[i] /= near[i];
      const Spread found = spread_of(slow_down);
      const double unsure = 2.0 * found.sd / std::sqrt(band.persons);
      EXPECT_GT(found.mean + unsure, band.least) << to_string(strategy) << ", " << band.rtt_s << " s";
      EXPECT_LT(found.mean - unsure, band.most) << to_string(strategy) << ", " << band.rtt_s << " s";
    }
  }
}

TEST(PathTask, TheSameSeedGivesTheSameTrial) {
  const PathCase c{.strategy = PathStrategy::kRate, .rtt_s = 0.225};
  const PathResult a = run_path_trial(task(), c), b = run_path_trial(task(), c);
  EXPECT_TRUE(a.finished);
  EXPECT_EQ(a.time_s, b.time_s);
  EXPECT_EQ(a.error_m, b.error_m);
  PathCase other = c;
  other.seed = 2;
  EXPECT_NE(run_path_trial(task(), other).error_m, a.error_m);
}

}  // namespace
}  // namespace longreach::path_task_test
