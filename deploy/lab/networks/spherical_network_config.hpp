#pragma once
// The trained networks of one 3-RRR mechanism as numbers: evaluated by spherical_network.hpp, created by
// `longreach-lab train spherical`, stored in deploy/devices/.

#include <array>
#include <cmath>
#include <vector>

#include "master/devices/spherical/spherical_geometry.hpp"

namespace longreach {

/// Motor angles of the training: with d = θ - home and m the mean of d, |m| <= common and |d - m| <=
/// differential: a cylinder about home. It is connected with home and has no singular pose, so every triple
/// of angles in it has exactly one orientation of home's assembly mode.
struct SphericalWorkspace {
  Vector3 home_rad = Vector3::Zero();     // motor angles at home
  Quaternion q_home{1.0, 0.0, 0.0, 0.0};  // orientation at home
  double common_rad = 0.0;                // about the axis of symmetry, > 0
  double differential_rad = 0.0;          // tilt, > 0

  [[nodiscard]] bool contains(const Vector3& theta_rad) const {
    const Vector3 d = theta_rad - home_rad;
    const double mean = d.sum() / 3.0;
    const Vector3 tilt(d.x() - mean, d.y() - mean, d.z() - mean);
    return std::abs(mean) <= common_rad && tilt.squaredNorm() <= differential_rad * differential_rad;
  }
};

/// Three angles as inputs, one hidden layer, three numbers as outputs:  y = c + B s(A θ + a).
struct SphericalPerceptron {
  static constexpr int kUnits = 24;

  alignas(32) std::array<std::array<double, kUnits>, 3> in{};  // A, a column an angle, 1/rad
  std::array<double, kUnits> bias{};                           // a
  std::array<std::array<double, kUnits>, 3> out{};             // B, a row an output
  std::array<double, 3> offset{};                              // c
};

/// The subspaces: a grid of equal boxes about home in g = axis tan(angle/2) of the rotation from home, each
/// extended on all sides by `overlap` of its width.
struct SphericalCells {
  int per_axis = 1;                 // odd, 1 to 9
  Vector3 width = Vector3::Zero();  // of g, without the overlap, > 0
  double overlap = 0.0;             // share of the width on each side, (0, 0.5]
};

struct SphericalNetworkConfig {
  SphericalAxes axes;  // of the trained mechanism
  SphericalWorkspace workspace;
  SphericalCells cells;
  SphericalPerceptron rough;              // g anywhere in the workspace
  std::vector<SphericalPerceptron> fine;  // g in cell (i, j, k), at (i per_axis + j) per_axis + k
};

}  // namespace longreach
