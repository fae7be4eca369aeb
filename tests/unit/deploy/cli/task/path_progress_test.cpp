// When an attempt at a path begins, which balls are passed, when it ends, and its figures.

#include "deploy/cli/task/path_progress.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>

namespace longreach::path_progress_test {
namespace {

constexpr double kStep_s = 0.01, kSpeed_m_per_s = 0.05;
const Vector3 kStart{0.4, -0.1, 0.3};

PathConfig corner(double radius_m) {
  PathConfig config;
  for (const Vector3& p : {Vector3(0, 0, 0), Vector3(0.1, 0, 0), Vector3(0.1, 0.1, 0)})
    config.waypoint.push_back({p});
  config.turn_radius_m = radius_m;
  config.from_tool_start = true;
  return config;
}

/// Moves the tool along straight lines at one speed.
class Attempt {
 public:
  explicit Attempt(double radius_m = 0.03) : progress(corner(radius_m), kStart) { stay(0.1); }

  void to(std::initializer_list<Vector3> points) {
    for (const Vector3& p : points) {
      while ((p - at_).norm() > 1e-9) {
        at_ += clamp_norm(p - at_, kSpeed_m_per_s * kStep_s);
        stay(kStep_s);
      }
    }
  }
  void stay(double seconds) {
    for (const double end_s = t_s_ + seconds; t_s_ < end_s - 1e-9;)
      progress.step(t_s_ += kStep_s, kStart + at_);
  }

  PathProgress progress;

 private:
  double t_s_ = 100.0;
  Vector3 at_ = Vector3::Zero();
};

TEST(PathProgress, AlongThePathEveryBallIsPassedAndTheTargetEndsIt) {
  Attempt a(0.0);  // turns at a point
  EXPECT_EQ(a.progress.balls(), 1);
  EXPECT_EQ(a.progress.phase(), PathPhase::kReady);
  a.to({{0.09, 0, 0}});
  EXPECT_EQ(a.progress.phase(), PathPhase::kUnderway);
  EXPECT_EQ(a.progress.figures().passed, 0);
  a.to({{0.1, 0.001, 0}});
  EXPECT_EQ(a.progress.figures().passed, 1);
  a.to({{0.1, 0.1, 0}});
  EXPECT_EQ(a.progress.phase(), PathPhase::kDone);
  // From 5 mm of the start to 5 mm of the target.
  EXPECT_NEAR(a.progress.figures().time_s, 0.19 / kSpeed_m_per_s, 0.05);
  EXPECT_LT(a.progress.figures().max_error_m, 1e-3);
}

TEST(PathProgress, TheErrorIsTheDistanceFromThePathOverTheTime) {
  Attempt a;
  a.to({{0, 0, 0.008}, {0.1, 0, 0.008}});
  const double beside = std::hypot(0.03 * (std::sqrt(2.0) - 1.0), 0.008);  // at the corner
  EXPECT_NEAR(a.progress.error_m(), beside, 1e-9);
  EXPECT_NEAR(a.progress.figures().max_error_m, beside, 1e-9);
  const double before_s = a.progress.figures().time_s, sum = a.progress.figures().mean_error_m * before_s;
  a.stay(10.0);
  EXPECT_NEAR(a.progress.figures().mean_error_m, (sum + 10.0 * beside) / (before_s + 10.0), 1e-9);
}

TEST(PathProgress, AShortCutPassesNoBallSoTheTargetDoesNotCount) {
  Attempt a(0.01);
  a.to({{0.1, 0.1, 0}});
  EXPECT_EQ(a.progress.phase(), PathPhase::kUnderway);
  EXPECT_EQ(a.progress.figures().passed, 0);
  a.to({{0.1, 0.0, 0}, {0.1, 0.02, 0}, {0.1, 0.1, 0}});
  EXPECT_EQ(a.progress.phase(), PathPhase::kDone);
}

TEST(PathProgress, TheTimeBeginsAnewAtTheStartUntilABallIsPassed) {
  Attempt a;
  a.to({{0.05, 0, 0}});
  a.stay(5.0);
  a.to({{0, 0, 0}});
  EXPECT_EQ(a.progress.phase(), PathPhase::kReady);
  a.to({{0.05, 0, 0}});
  EXPECT_NEAR(a.progress.figures().time_s, 0.9, 0.05);
  a.to({{0.1, 0.02, 0}, {0.05, 0, 0}, {0, 0, 0}});
  EXPECT_EQ(a.progress.phase(), PathPhase::kUnderway);
  a.to({{0.1, 0.1, 0}});
  const double took_s = a.progress.figures().time_s;
  EXPECT_EQ(a.progress.phase(), PathPhase::kDone);
  a.stay(3.0);
  EXPECT_EQ(a.progress.figures().time_s, took_s);
  a.to({{0, 0, 0}});
  EXPECT_EQ(a.progress.phase(), PathPhase::kReady);
  EXPECT_EQ(a.progress.figures().time_s, took_s) << "the last attempt remains until the next one begins";
}

TEST(PathProgress, AToolThatIsNotAtTheStartWaits) {
  PathProgress progress(corner(0.03), kStart);
  progress.step(1.0, kStart + Vector3(0.05, 0, 0));
  progress.step(2.0, kStart + Vector3(0.06, 0, 0));
  EXPECT_EQ(progress.phase(), PathPhase::kAway);
  EXPECT_EQ(progress.figures().time_s, 0.0);
}

TEST(PathProgress, ASceneWithoutAPathHasNone) {
  EXPECT_FALSE(path_of({}, {}).has_value());
  proto::Scene broken;
  broken.mutable_path()->add_waypoint();
  EXPECT_THROW(path_of({}, broken), std::exception);
}

}  // namespace
}  // namespace longreach::path_progress_test
