#pragma once
// The weights of the trained networks of a 3-RRR mechanism. They are created by `longreach-lab train
// spherical`, stored in deploy/devices/ and evaluated by spherical_network.hpp.

#include <array>
#include <cmath>
#include <vector>

#include "master/devices/spherical/spherical_geometry.hpp"

namespace longreach {

/// The motor angles for which the networks are trained. They form a cylinder about home: with d = θ - home
/// and m the mean of d, |m| <= common and |d - m| <= differential. The cylinder is connected to home and
/// contains no singular pose, so that every triple of angles in it has exactly one orientation in the
/// assembly mode of the home position.
struct SphericalWorkspace {
  Vector3 home_rad = Vector3::Zero();     // motor angles at home
  Quaternion q_home{1.0, 0.0, 0.0, 0.0};  // orientation at home
  double common_rad = 0.0;                // range of rotation about the axis of symmetry, > 0
  double differential_rad = 0.0;          // range of tilt, > 0

  [[nodiscard]] bool contains(const Vector3& theta_rad) const {
    const Vector3 d = theta_rad - home_rad;
    const double mean = d.sum() / 3.0;
    const Vector3 tilt(d.x() - mean, d.y() - mean, d.z() - mean);
    return std::abs(mean) <= common_rad && tilt.squaredNorm() <= differential_rad * differential_rad;
  }
};

/// A network with three angles as inputs, one hidden layer, and three outputs:  y = c + B s(A θ + a).
struct SphericalPerceptron {
  static constexpr int kUnits = 24;

  alignas(32) std::array<std::array<double, kUnits>, 3> in{};  // A, one array per angle, 1/rad
  std::array<double, kUnits> bias{};                           // a
  std::array<std::array<double, kUnits>, 3> out{};             // B, one array per output
  std::array<double, 3> offset{};                              // c
};

/// The subspaces: a grid of equal boxes about home in the coordinates g = axis tan(angle/2) of the rotation
/// from home. Each box is extended on all sides by the fraction `overlap` of its width.
struct SphericalCells {
  int per_axis = 1;                 // odd, 1 to 9
  Vector3 width = Vector3::Zero();  // width of a box in g, without the overlap, > 0
  double overlap = 0.0;             // fraction of the width on each side, (0, 0.5]
};

struct SphericalNetworkConfig {
  SphericalAxes axes;  // axes of the trained mechanism
  SphericalWorkspace workspace;
  SphericalCells cells;
  SphericalPerceptron rough;  // estimates g anywhere in the workspace
  /// Estimates g in cell (i, j, k); index (i per_axis + j) per_axis + k.
  std::vector<SphericalPerceptron> fine;
};

}  // namespace longreach
