#include "deploy/lab/mapping/path_course.hpp"

#include <cmath>
#include <numbers>

namespace longreach {
namespace {

constexpr double kStretch_m = 0.03;
constexpr int kChords = 3;  // of a quarter turn
constexpr int kDrawn = 6;   // points per turn
constexpr double kTurn = -1.0;

/// Lengths of the lines, and kTurn for each turn, in the order of the scene.
std::vector<double> pieces_of(const PathConfig& scene) {
  std::vector<double> pieces;
  const std::size_t legs = scene.waypoint.size() - 1;
  for (std::size_t i = 0; i < legs; ++i) {
    const double leg_m = (scene.waypoint[i + 1].point_m - scene.waypoint[i].point_m).norm();
    const int turns = (i > 0) + (i + 1 < legs);
    pieces.push_back(leg_m - turns * scene.turn_radius_m);
    if (i + 1 < legs) pieces.push_back(kTurn);
  }
  return pieces;
}

class Pen {
 public:
  explicit Pen(double radius_m) : radius_m_(radius_m) {
    course_.path.turn_radius_m = radius_m;
    course_.path.from_tool_start = true;
    course_.path.waypoint.push_back({at_m_});
    course_.drawn_m.push_back(at_m_);
  }

  void line(double length_m) {
    const int stretches = static_cast<int>(std::ceil(length_m / kStretch_m - 1e-9));
    const Vector3 from = at_m_, way = length_m * Vector3::Unit(axis_);
    for (int i = 1; i <= stretches; ++i) go(from + way * i / stretches, i == stretches);
    course_.drawn_m.push_back(at_m_);
    course_.length_m += length_m;
  }

  void turn() {
    const Vector3 from = at_m_, ahead = Vector3::Unit(axis_);
    axis_ = (axis_ + 1) % 3;
    const Vector3 inward = Vector3::Unit(axis_);
    course_.path.waypoint.push_back({from + radius_m_ * ahead});
    for (int i = 1; i <= kChords * kDrawn; ++i) {
      const double angle = 0.5 * std::numbers::pi * i / (kChords * kDrawn);
      const Vector3 p = from + radius_m_ * (std::sin(angle) * ahead + (1.0 - std::cos(angle)) * inward);
      course_.drawn_m.push_back(p);
      if (i % kDrawn == 0) go(p, i == kChords * kDrawn);
    }
    course_.length_m += 0.5 * std::numbers::pi * radius_m_;
  }

  PathCourse finish() {
    course_.path.waypoint.push_back({at_m_});
    return course_;
  }

 private:
  void go(const Vector3& to_m, bool target) {
    at_m_ = to_m;
    course_.aims.push_back({to_m, target});
  }

  double radius_m_;
  Vector3 at_m_ = Vector3::Zero();
  int axis_ = 0;
  PathCourse course_{};
};

}  // namespace

PathCourse shuffled_course(const PathConfig& scene, Random random) {
  std::vector<double> pieces = pieces_of(scene);
  for (std::size_t i = pieces.size() - 1; i > 0; --i) std::swap(pieces[i], pieces[random.next() % (i + 1)]);
  Pen pen(scene.turn_radius_m);
  for (const double length_m : pieces) length_m == kTurn ? pen.turn() : pen.line(length_m);
  return pen.finish();
}

}  // namespace longreach
