#pragma once
// The way of a task: straight from waypoint to waypoint, rounded there by arcs of the turn's radius (quarter
// turns where the way turns by 90°), and how far from it a place is. An arc of turn φ touches both lines
// r tan(φ/2) before and behind its waypoint. Error of a place: distance to the nearest point of the way;
// before its first and behind its last point that to the end. Not handled: a way that turns back on itself.

#include <vector>

#include "slave/config/scene_config.hpp"

namespace longreach {

class Path {
 public:
  /// In W; `p_WE_start` is where the tool starts, m. Throws std::invalid_argument with the reason if the way
  /// is none: fewer than two points, a number that is not finite, a leg too short for its turns, a turn back.
  Path(const PathConfig& config, const Vector3& p_WE_start);

  struct Place {
    Vector3 nearest_m = Vector3::Zero();  // of the way, in W
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
    double before_m = 0.0;  // length of the way before it
  };
  void add(Piece piece);
  static Place place_on(const Piece& piece, const Vector3& p_W);

  std::vector<Piece> pieces_;
  double length_m_ = 0.0;
};

}  // namespace longreach
