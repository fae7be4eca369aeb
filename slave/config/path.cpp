#include "slave/config/path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace longreach {
namespace {

constexpr double kStraightRad = 1e-9;   // less is no turn
constexpr double kBackRad = 3.1;        // more is no way
constexpr double kLegRounding = 1e-12;  // of a leg that its turns fill exactly
constexpr double kPi = 3.14159265358979323846;

std::vector<Vector3> points(const PathConfig& config, const Vector3& p_WE_start) {
  std::vector<Vector3> result;
  for (const WaypointConfig& w : config.waypoint) {
    result.push_back(config.from_tool_start ? Vector3(p_WE_start + w.point_m) : w.point_m);
    if (!result.back().allFinite()) throw std::invalid_argument("path: a waypoint is not finite");
  }
  if (result.size() < 2) throw std::invalid_argument("path: fewer than two waypoints");
  return result;
}

double angle_between(const Vector3& a, const Vector3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

}  // namespace

Path::Path(const PathConfig& config, const Vector3& p_WE_start) {
  const std::vector<Vector3> p = points(config, p_WE_start);
  if (!(config.turn_radius_m >= 0.0)) throw std::invalid_argument("path: negative turn_radius_m");
  double cut_m = 0.0;  // of the leg, by the turn before it
  for (std::size_t i = 0; i + 1 < p.size(); ++i) {
    const Vector3 way = p[i + 1] - p[i];
    const double leg_m = way.norm();
    if (!(leg_m > 0.0)) throw std::invalid_argument("path: two waypoints are at the same position");
    const Vector3 direction = way / leg_m;
    const bool last = i + 2 == p.size();
    const Vector3 next = last ? direction : (p[i + 2] - p[i + 1]).normalized();
    const double turn_rad = angle_between(direction, next);
    if (turn_rad > kBackRad) throw std::invalid_argument("path: its direction reverses at a waypoint");
    const bool turns = turn_rad > kStraightRad && config.turn_radius_m > 0.0;
    const double next_cut_m = turns ? config.turn_radius_m * std::tan(0.5 * turn_rad) : 0.0;
    const double line_m = leg_m - cut_m - next_cut_m;
    if (!(line_m >= -kLegRounding * leg_m))
      throw std::invalid_argument("path: a segment is too short for the turns at its ends");
    add({.from_m = p[i] + cut_m * direction, .direction = direction, .length_m = std::max(line_m, 0.0)});
    if (turns) {
      add({.from_m = p[i + 1] - next_cut_m * direction,
           .direction = direction,
           .inward = (next - next.dot(direction) * direction).normalized(),
           .radius_m = config.turn_radius_m,
           .length_m = config.turn_radius_m * turn_rad});
    }
    cut_m = next_cut_m;
  }
}

void Path::add(Piece piece) {
  piece.before_m = length_m_;
  length_m_ += piece.length_m;
  pieces_.push_back(piece);
}

Path::Place Path::place_on(const Piece& piece, const Vector3& p_W) {
  const Vector3 off = p_W - piece.from_m;
  Place result;
  double s = 0.0;  // along the piece
  if (piece.radius_m > 0.0) {
    // From the centre: angle from the arc's first point on. On the far side the nearer end.
    const double turn_rad = piece.length_m / piece.radius_m;
    double angle_rad = std::atan2(off.dot(piece.direction), piece.radius_m - off.dot(piece.inward));
    if (angle_rad < 0.5 * turn_rad - kPi) angle_rad += 2.0 * kPi;
    angle_rad = std::clamp(angle_rad, 0.0, turn_rad);
    s = angle_rad * piece.radius_m;
    const double half = std::sin(0.5 * angle_rad);
    result.nearest_m = piece.from_m + piece.radius_m * (std::sin(angle_rad) * piece.direction +
                                                        2.0 * half * half * piece.inward);
  } else {
    s = std::clamp(off.dot(piece.direction), 0.0, piece.length_m);
    result.nearest_m = piece.from_m + s * piece.direction;
  }
  result.distance_m = (p_W - result.nearest_m).norm();
  result.along_m = piece.before_m + s;
  return result;
}

Path::Place Path::place(const Vector3& p_W) const {
  Place best;
  best.distance_m = std::numeric_limits<double>::infinity();
  for (const Piece& piece : pieces_) {
    const Place here = place_on(piece, p_W);
    if (here.distance_m < best.distance_m) best = here;
  }
  return best;
}

}  // namespace longreach
