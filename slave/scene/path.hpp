#pragma once
// The path of a task: straight segments between waypoints, rounded by arcs of the turn radius (quarter turns
// where the path turns by 90°), and the distance of a point from it. An arc of turn φ touches both lines r
// tan(φ/2) before and after its waypoint. The error of a point is the distance to the nearest point of the
// path; before its first and after its last point the distance to the end. Not handled: a path that reverses.

#include <vector>

#include "slave/config/scene_config.hpp"

namespace longreach {

class Path {
 public:
  /// In W; `p_WE_start` is the start of the tool, m. Throws std::invalid_argument with the reason for an
  /// invalid path: fewer than two points, a number that is not finite, a segment too short for its turns, a
  /// reversal.
  Path(const PathConfig& config, const Vector3& p_WE_start);

  struct Place {
    Vector3 nearest_m = Vector3::Zero();  // of the path, in W
    double distance_m = 0.0;              // from it: the error
    double along_m = 0.0;                 // of it, since the first waypoint, 0..length_m()
  };
  [[nodiscard]] Place place(const Vector3& p_W) const;
  [[nodiscard]] double length_m() const { return length_m_; }

 private:
  struct Piece {
    Vector3 from_m = Vector3::Zero();     // its first point
    Vector3 direction = Vector3::Zero();  // there, unit
    Vector3 inward = Vector3::Zero();     // unit, towards the centre of an arc; else 0
    double radius_m = 0.0;                // of an arc; 0: a line
    double length_m = 0.0;
    double before_m = 0.0;  // length of the path before it
  };
  void add(Piece piece);
  static Place place_on(const Piece& piece, const Vector3& p_W);

  std::vector<Piece> pieces_;
  double length_m_ = 0.0;
};

}  // namespace longreach
