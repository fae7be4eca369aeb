#pragma once
// The path of a task, and the distance of a point from it. The path consists of straight segments between
// waypoints, joined by arcs of the turn radius r (quarter turns where the path turns by 90°). An arc that
// turns by φ is tangent to both segments at r tan(φ/2) from its waypoint. The error of a point is its
// distance from the nearest point of the path; before the start or after the end of the path, it is the
// distance from that endpoint. A path must not reverse its direction.

#include <vector>

#include "schema/config_scene.hpp"

namespace longreach {

class Path {
 public:
  /// Builds the path in W; `p_WE_start`: start position of the tool, m. Throws std::invalid_argument with the
  /// reason if the path is invalid: fewer than two points, a number that is not finite, a segment too short
  /// for its turns, or a reversal.
  Path(const PathConfig& config, const Vector3& p_WE_start);

  struct Place {
    Vector3 nearest_m = Vector3::Zero();  // nearest point of the path, in W
    double distance_m = 0.0;              // distance from that point: the error
    double along_m = 0.0;  // length of the path from the first waypoint to that point, 0..length_m()
  };
  [[nodiscard]] Place place(const Vector3& p_W) const;
  [[nodiscard]] double length_m() const { return length_m_; }

 private:
  struct Piece {
    Vector3 from_m = Vector3::Zero();     // first point of the piece
    Vector3 direction = Vector3::Zero();  // unit vector at the first point
    /// Unit vector towards the centre of an arc; zero for a line.
    Vector3 inward = Vector3::Zero();
    double radius_m = 0.0;  // radius of an arc; 0: a line
    double length_m = 0.0;
    double before_m = 0.0;  // length of the path before this piece
  };
  void add(Piece piece);
  static Place place_on(const Piece& piece, const Vector3& p_W);

  std::vector<Piece> pieces_;
  double length_m_ = 0.0;
};

}  // namespace longreach
