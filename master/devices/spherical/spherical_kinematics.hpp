#pragma once
// Kinematics of a 3-RRR spherical mechanism: motor angles from an orientation, and orientations from motor
// angles.
//
// Inverse: E cos θ + F sin θ + G = 0 for each leg, with E = w_cos . v, F = w_sin . v, G = w_axial . v -
// cos(alpha2). There are two roots.
//
// Forward, tracking: with q = (1, g) q_previous the closure equations are exactly quadratic in g,
//   F_i(g) = (k - c)/2 + g . (v x w) + (g . w)(g . v) - (k + c)/2 |g|² = 0,   k = w . v, c = cos(alpha2).
// They are solved by at most kMaxIterations Newton steps. Each step is shortened to the radius within which
// the Jacobian cannot become singular (Kantorovich). The result is therefore connected to the previous pose
// without a type 2 singularity in between: the assembly mode is kept. The iteration converges for every step
// of up to 5 degrees per tick if the type 2 distance (spherical_statics.hpp) is at least kTrackedDistance
// before and after the step.
//
// Forward, all: the orientations for which two legs close are given by two angles, φ (of v1 about w1) and ψ
// (about v1). Eliminating ψ leaves a trigonometric polynomial of degree 4 in φ with at most 8 roots, each of
// which is polished on the closure equations.
//
// Every function accepts any input, finite or not, and returns finite numbers. No function allocates or
// throws.

#include <array>

#include "common/core/solution_status.hpp"
#include "master/devices/spherical/spherical_geometry.hpp"

namespace longreach {

/// Motor angles for an orientation. kFound: all three are valid. kSingular: the angles close the loops, but a
/// leg is stretched, folded or free to turn. Otherwise the angles are zero.
struct SphericalMotors {
  SolutionStatus status = SolutionStatus::kNoSolution;
  Vector3 theta_rad = Vector3::Zero();  // (-pi, pi]
};

/// Both roots of each leg: u . (w x v) is >= 0 in `first` and <= 0 in `second`. Status and output are as in
/// SphericalMotors.
struct SphericalRoots {
  SolutionStatus status = SolutionStatus::kNoSolution;
  Vector3 first_rad = Vector3::Zero();
  Vector3 second_rad = Vector3::Zero();
};

/// Orientation tracked from the previous one. kFound: it closes all loops in the same assembly mode.
/// Otherwise `q` and `side` are the previous ones. kNoSolution: an input is not finite. kSingular: the
/// previous pose is singular, or there is a singularity on the way.
struct SphericalPose {
  SolutionStatus status = SolutionStatus::kNoSolution;
  Quaternion q = Quaternion::Identity();
  int side = 0;  // sign of det[v_i x w_i], constant within an assembly mode; 0: unknown
  int iterations = 0;
};

/// All orientations for given motor angles. kFound: there are `count` orientations. kSingular: some of them
/// are singular (two coincide), or there is a continuum, of which only singular members are listed.
/// kNoSolution: there is none.
struct SphericalPoses {
  SolutionStatus status = SolutionStatus::kNoSolution;
  int count = 0;
  std::array<Quaternion, 8> q{};
};

class SphericalKinematics {
 public:
  static constexpr int kMaxIterations = 24;
  static constexpr double kTrackedDistance = 0.1;

  explicit SphericalKinematics(const SphericalGeometry& geometry);

  [[nodiscard]] const SphericalGeometry& geometry() const { return g_; }

  /// Returns the motor angles for the orientation `q`. Bit i of `mode` selects the second root of leg i (8
  /// working modes).
  [[nodiscard]] SphericalMotors inverse(const Quaternion& q, unsigned mode = 0) const;
  /// Returns both roots of each leg for the orientation `q`.
  [[nodiscard]] SphericalRoots inverse_all(const Quaternion& q) const;

  /// Returns the orientation for these motor angles that is connected to `previous`. `previous.q` must be a
  /// unit quaternion; otherwise the identity is used. If `previous.side` is 0, the side is computed from the
  /// previous orientation and the new angles. This may be wrong for a step across a singularity, so pass the
  /// previous result.
  [[nodiscard]] SphericalPose forward(const Vector3& theta_rad, const SphericalPose& previous) const;
  /// Returns the orientations for these motor angles in all assembly modes.
  [[nodiscard]] SphericalPoses forward_all(const Vector3& theta_rad) const;

 private:
  /// One vector per leg, stored as arrays of coordinates so that SIMD instructions process all legs together.
  /// The fourth lane repeats the third leg.
  struct Vectors {
    Eigen::Array4d x, y, z;
  };
  struct Closures;
  struct Search;

  SphericalGeometry g_;
  Vectors w_axial_, w_cos_, w_sin_, v_;
  double curvature_;  // bound on the change of the Jacobian of the closure equations per unit of g
};

}  // namespace longreach
