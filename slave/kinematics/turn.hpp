#pragma once
// Rotations about z and their action on vectors: the algebra that closed_inverse.cpp uses.

#include <cmath>

#include "common/spatial/spatial.hpp"
#include "slave/kinematics/quartic_turns.hpp"

namespace longreach {

inline Turn operator*(const Turn& a, const Turn& b) { return {a.c * b.c - a.s * b.s, a.s * b.c + a.c * b.s}; }
inline Turn reversed(const Turn& a) { return {a.c, -a.s}; }
inline double at(const Trig& f, const Turn& t) { return f.k + f.c * t.c + f.s * t.s; }

/// A point or a direction in a plane.
struct Plane {
  double x, y;
};
inline Plane flat(const Vector3& v) { return {v.x(), v.y()}; }

/// turned() returns Rz(t) v, turned_back() Rz(-t) v.
inline Vector3 turned(const Turn& t, const Vector3& v) {
  return {t.c * v.x() - t.s * v.y(), t.s * v.x() + t.c * v.y(), v.z()};
}
inline Vector3 turned_back(const Turn& t, const Vector3& v) {
  return {t.c * v.x() + t.s * v.y(), t.c * v.y() - t.s * v.x(), v.z()};
}

/// Two rows of a rotation matrix.
using Rows = Eigen::Matrix<double, 2, 3>;

/// Multiplies the rows by Rz(t) from the right.
inline void turn_back(Rows& rows, const Turn& t) {
  const Eigen::Vector2d x = rows.col(0);
  rows.col(0) = t.c * x + t.s * rows.col(1);
  rows.col(1) = t.c * rows.col(1) - t.s * x;
}

/// Returns g·Rz(φ) v as a function of φ.
inline Trig turned_part(const Vector3& g, const Vector3& v) {
  return {g.z() * v.z(), g.x() * v.x() + g.y() * v.y(), g.y() * v.x() - g.x() * v.y()};
}

/// Returns `t` normalized to unit length.
inline Turn unit(const Turn& t) {
  const double scale = 1.0 / std::sqrt(t.c * t.c + t.s * t.s);
  return {t.c * scale, t.s * scale};
}

/// Cosine of the angle between two rotations.
inline double likeness(const Turn& a, const Turn& b) { return a.c * b.c + a.s * b.s; }

}  // namespace longreach
