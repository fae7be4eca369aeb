// How far a place is from the way of a task, against closed forms.

#include "slave/config/path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "common/core/random.hpp"

namespace longreach::path_test {
namespace {

constexpr double kPi = 3.14159265358979323846;

PathConfig way(std::initializer_list<Vector3> points, double radius_m) {
  PathConfig config;
  for (const Vector3& p : points) config.waypoint.push_back({p});
  config.turn_radius_m = radius_m;
  config.from_tool_start = false;
  return config;
}

/// Four lines with three quarter turns, as in deploy/scenes/path.txtpb.
PathConfig task() {
  return way({{0, 0, 0}, {0.12, 0, 0}, {0.12, 0.12, 0}, {0.12, 0.12, 0.12}, {0.24, 0.12, 0.12}}, 0.03);
}

void expect_near(const Vector3& a, const Vector3& b) { EXPECT_LT((a - b).norm(), 1e-15) << a.transpose(); }

TEST(Path, IsAsLongAsItsLinesAndQuarterTurns) {
  // 90 + 60 + 60 + 90 mm and three quarters of a circle of 30 mm.
  EXPECT_NEAR(Path(task(), Vector3::Zero()).length_m(), 0.3 + 3 * 0.03 * kPi / 2, 1e-15);
}

TEST(Path, ErrorBesideALineIsTheDistanceAcrossIt) {
  const Path path(task(), Vector3::Zero());
  const Path::Place place = path.place({0.05, -0.003, 0.004});
  EXPECT_NEAR(place.distance_m, 0.005, 1e-16);
  EXPECT_NEAR(place.along_m, 0.05, 1e-16);
  expect_near(place.nearest_m, {0.05, 0, 0});
}

TEST(Path, ErrorAtItsEndsIsTheDistanceToThem) {
  const Path path(task(), Vector3::Zero());
  const Path::Place first = path.place({-0.003, 0, 0.004}), last = path.place({0.243, 0.124, 0.12});
  EXPECT_NEAR(first.distance_m, 0.005, 1e-16);
  EXPECT_EQ(first.along_m, 0.0);
  EXPECT_NEAR(last.distance_m, 0.005, 1e-15);
  EXPECT_NEAR(last.along_m, path.length_m(), 1e-15);
}

// About the first turn's centre (90, 30, 0) mm: radially, and out of its plane.
TEST(Path, ErrorInATurnIsThatToTheCircle) {
  const Path path(task(), Vector3::Zero());
  for (const double angle : {0.0, 0.2, kPi / 4, 1.1, kPi / 2}) {
    const Vector3 out(std::sin(angle), -std::cos(angle), 0.0);
    for (const double off : {-0.004, 0.0, 0.005}) {
      for (const double aside : {0.0, 0.003}) {
        const Vector3 centre(0.09, 0.03, 0.0);
        const Path::Place place = path.place(centre + (0.03 + off) * out + Vector3(0, 0, aside));
        EXPECT_NEAR(place.distance_m, std::hypot(off, aside), 1e-15) << angle;
        EXPECT_NEAR(place.along_m, 0.09 + 0.03 * angle, 1e-14) << angle;
        expect_near(place.nearest_m, centre + 0.03 * out);
      }
    }
  }
}

// The corner that is cut: r (√2 - 1) from the turn.
TEST(Path, CornerIsAsFarAsItIsCut) {
  EXPECT_NEAR(Path(task(), Vector3::Zero()).place({0.12, 0, 0}).distance_m, 0.03 * (std::sqrt(2.0) - 1.0),
              1e-15);
}

TEST(Path, CountsFromWhereTheToolStarts) {
  PathConfig config = task();
  config.from_tool_start = true;
  const Vector3 start(9.8, -1.0, 4.0);
  EXPECT_NEAR(Path(config, start).place(start + Vector3(0.05, 0.002, 0)).distance_m, 0.002, 1e-14);
}

/// Many points of a way with turns, each built from its corner's own geometry: the centre lies on the
/// bisector.
std::vector<Vector3> sampled(const std::vector<Vector3>& p, double r) {
  std::vector<Vector3> out;
  const auto line = [&out](const Vector3& a, const Vector3& b) {
    for (int i = 0; i <= 1000; ++i) out.push_back(a + (b - a) * (i / 1000.0));
  };
  Vector3 from = p.front();
  for (std::size_t i = 1; i + 1 < p.size(); ++i) {
    const Vector3 back = (p[i - 1] - p[i]).normalized(), on = (p[i + 1] - p[i]).normalized();
    const double half = 0.5 * std::acos(back.dot(on));
    const Vector3 centre = p[i] + r / std::sin(half) * (back + on).normalized();
    const Vector3 first = p[i] + r / std::tan(half) * back, last = p[i] + r / std::tan(half) * on;
    line(from, first);
    for (int j = 0; j <= 1000; ++j) {
      out.push_back(centre + r * ((first - centre) + (last - first) * (j / 1000.0)).normalized());
    }
    from = last;
  }
  line(from, p.back());
  return out;
}

TEST(Path, NearestPointIsTheNearestOfManyWithTurnsOfAnyAngle) {
  const std::vector<Vector3> points{{0, 0, 0}, {0.2, 0, 0}, {0.2, 0.03, 0.1}, {0.05, 0.1, 0.05}, {0, 0.3, 0}};
  PathConfig config = way({}, 0.02);
  for (const Vector3& p : points) config.waypoint.push_back({p});
  const Path path(config, Vector3::Zero());
  const std::vector<Vector3> many = sampled(points, 0.02);
  Random random(7);
  for (int i = 0; i < 300; ++i) {
    const Vector3 p(0.1 + 0.2 * random.normal(), 0.1 * random.normal(), 0.1 * random.normal());
    double least = 1.0;
    for (const Vector3& q : many) least = std::min(least, (p - q).norm());
    const Path::Place here = path.place(p);
    EXPECT_LE(here.distance_m, least + 1e-12) << p.transpose();
    EXPECT_NEAR(here.distance_m, least, 2e-4) << p.transpose();
    EXPECT_NEAR((p - here.nearest_m).norm(), here.distance_m, 1e-15);
    EXPECT_LT(path.place(here.nearest_m).distance_m, 1e-14);
  }
}

TEST(Path, StraightOnIsNoTurn) {
  const Path path(way({{0, 0, 0}, {0.1, 0, 0}, {0.2, 0, 0}}, 0.5), Vector3::Zero());
  EXPECT_NEAR(path.length_m(), 0.2, 1e-15);
  EXPECT_NEAR(path.place({0.1, 0.01, 0}).distance_m, 0.01, 1e-16);
}

TEST(Path, RefusesWhatIsNoWay) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](const PathConfig& config) {
    EXPECT_THROW(Path(config, Vector3::Zero()), std::invalid_argument);
  };
  refused(way({{0, 0, 0}}, 0.01));
  refused(way({{0, 0, 0}, {0, 0, 0}}, 0.01));
  refused(way({{0, 0, 0}, {nan, 0, 0}}, 0.01));
  refused(way({{0, 0, 0}, {0.1, 0, 0}, {0, 0, 0}}, 0.01));
  refused(way({{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.1, 0}}, 0.11));
  refused(way({{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.1, 0}}, -0.01));
  refused(way({{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.1, 0}}, nan));
}

}  // namespace
}  // namespace longreach::path_test
