#pragma once
// Kinematics of a 3-RRR spherical mechanism: motor angles from an orientation, and orientations from motor
// angles.
//
// Inverse: E cos θ + F sin θ + G = 0 a leg, E = w_cos . v, F = w_sin . v, G = w_axial . v - cos(alpha2): two
// roots. Forward, tracking: with q = (1, g) q_previous the closures are exactly quadratic in g,
//   F_i(g) = (k - c)/2 + g . (v x w) + (g . w)(g . v) - (k + c)/2 |g|² = 0,   k = w . v, c = cos(alpha2).
// Newton steps, shortened to the radius in which the Jacobian cannot become singular (Kantorovich), so the
// answer is connected with the previous pose without a type 2 singularity between: the assembly mode is kept.
// At most kMaxIterations. Converges for every step of up to 5 degrees a tick where the type 2 measure
// (spherical_statics.hpp) is at least kTrackedDistance before and after. Forward, all: the orientations on
// two cones are φ (v1 about w1) and ψ (about v1); ψ is eliminated, which leaves a trigonometric polynomial of
// degree 4 in φ: at most 8 roots, each polished on the closures.
//
// Every function accepts any input, finite or not, and returns finite numbers. Nothing allocates or throws.

#include <array>

#include "common/core/solution_status.hpp"
#include "master/devices/spherical/spherical_geometry.hpp"

namespace longreach {

/// Motor angles of an orientation. kFound: all three. kSingular: a leg is stretched or folded, or turns
/// freely; the angles close the loop. Otherwise zero.
struct SphericalMotors {
  SolutionStatus status = SolutionStatus::kNoSolution;
  Vector3 theta_rad = Vector3::Zero();  // (-pi, pi]
};

/// Both roots of each leg: `first` has u . (w x v) >= 0, `second` <= 0. Status and output are as in
/// SphericalMotors.
struct SphericalRoots {
  SolutionStatus status = SolutionStatus::kNoSolution;
  Vector3 first_rad = Vector3::Zero();
  Vector3 second_rad = Vector3::Zero();
};

/// Orientation that follows from the previous one. kFound: closes all loops in the same assembly mode.
/// Otherwise `q` and `side` are the previous ones. kNoSolution: an input is not finite. kSingular: the
/// previous pose is singular, or there is a singularity in between.
struct SphericalPose {
  SolutionStatus status = SolutionStatus::kNoSolution;
  Quaternion q = Quaternion::Identity();
  int side = 0;  // sign of det[v_i x w_i], which an assembly mode keeps; 0: unknown
  int iterations = 0;
};

/// All orientations for given motor angles. kFound: `count` orientations. kSingular: some of them are
/// singular (two coincide), or there is a continuum of which only singular members are listed. kNoSolution:
/// none.
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

  /// Returns the angles of the working mode: bit i of `mode` selects the second root of leg i (8 working
  /// modes).
  [[nodiscard]] SphericalMotors inverse(const Quaternion& q, unsigned mode = 0) const;
  [[nodiscard]] SphericalRoots inverse_all(const Quaternion& q) const;

  /// `previous.q` must be a unit quaternion; otherwise the identity is used. If `previous.side` is 0, the
  /// side is computed from the previous orientation and the new angles, which may be wrong for a step across
  /// a singularity: pass the last result.
  [[nodiscard]] SphericalPose forward(const Vector3& theta_rad, const SphericalPose& previous) const;
  [[nodiscard]] SphericalPoses forward_all(const Vector3& theta_rad) const;

 private:
  /// Three vectors, one per leg, side by side, so that the legs are computed together. The fourth lane
  /// repeats the third leg.
  struct Vectors {
    Eigen::Array4d x, y, z;
  };
  struct Closures;
  struct Search;

  SphericalGeometry g_;
  Vectors w_axial_, w_cos_, w_sin_, v_;
  double curvature_;  // bound on the change of the closures' Jacobian per unit of g
};

}  // namespace longreach
