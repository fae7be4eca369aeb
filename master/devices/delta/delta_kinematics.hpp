#pragma once
// Kinematics of a DELTA: motor angles from a platform position, and platform position from motor angles.
//
// Inverse: with E = -2 arm U, F = -2 arm w, G = U² + w² + arm² - reach², the loop of a leg closes where E cos
// θ + F sin θ + G = 0. The two roots are found by the half-angle substitution; G is computed as arm² + (dist
// - reach)(dist + reach) to avoid cancellation.
//
// Forward, without offset: the two points whose distance from three centres is the length of the rods (from
// the centre and height of their triangle).
//
// Forward, with an offset: the centre of each sphere is the end of the arm + offset * d, where d is the
// direction from the end of the arm to the platform in the plane of the leg. These spheres give the initial
// guess for a Newton iteration on |P - centre(P)| - rod, with at most kMaxIterations steps.
//
// Every function accepts any input, finite or not, and returns finite numbers. No function allocates or
// throws.

#include <array>

#include "common/core/solution_status.hpp"
#include "master/devices/delta/delta_geometry.hpp"

namespace longreach {

/// Motor angles for a platform position. kFound: all three are valid. kSingular: the angles close the loops,
/// but the two roots of a leg coincide, or a leg can turn freely. Otherwise the angles are zero.
struct DeltaAngles {
  SolutionStatus status = SolutionStatus::kNoSolution;
  Vector3 theta_rad = Vector3::Zero();  // (-pi, pi]
};

/// Both roots of each leg. In `first` the elbow is on the outer side if the platform is on the working side
/// (sin(θ2 - θ) >= 0, θ2 the angle of the forearm); `second` is the other root. Status and output are as in
/// DeltaAngles.
struct DeltaRoots {
  SolutionStatus status = SolutionStatus::kNoSolution;
  Vector3 first_rad = Vector3::Zero();
  Vector3 second_rad = Vector3::Zero();
};

/// Position of the platform. kFound: the position closes all loops in the requested assembly. kSingular: the
/// assemblies coincide, or the centres of the spheres are collinear. Use `p_m` only with kFound; otherwise it
/// is the previous position if one was given, or zero.
struct DeltaPosition {
  SolutionStatus status = SolutionStatus::kNoSolution;
  Vector3 p_m = Vector3::Zero();
  int iterations = 0;  // 0: closed form
};

/// All positions for given motor angles, the working assembly first. Without an offset there are two (closed
/// form). With an offset they are the results of a search from many initial guesses, usually two; up to four
/// were observed.
struct DeltaPositions {
  static constexpr int kMost = 8;

  SolutionStatus status = SolutionStatus::kNoSolution;  // kFound: count > 0
  int count = 0;
  std::array<Vector3, kMost> p_m{};  // only the first `count` elements are valid
};

class DeltaKinematics {
 public:
  static constexpr int kMaxIterations = 12;

  explicit DeltaKinematics(const DeltaGeometry& geometry) : g_(geometry) {}

  [[nodiscard]] const DeltaGeometry& geometry() const { return g_; }

  /// Returns the motor angles for the platform position `p_m` (base frame). Bit i of `mode` selects the
  /// second root of leg i.
  [[nodiscard]] DeltaAngles inverse(const Vector3& p_m, unsigned mode = 0) const;
  /// Returns both roots of each leg for the platform position `p_m` (base frame).
  [[nodiscard]] DeltaRoots inverse_all(const Vector3& p_m) const;

  /// Returns the position in `assembly` for these angles. For a geometry with offset, `near_m` (the previous
  /// position) is the initial guess of the iteration, and it is returned if there is no result. The assembly
  /// never changes. Close to a singularity the iteration may converge to a distant solution; the status is
  /// therefore kSingular if the result is farther from the initial guess than 10 rod lengths times the volume
  /// of the unit rods. Steps of up to 5 mm succeed if DeltaSingularity::rods is at least 0.1 (in tests, at
  /// least 0.06).
  [[nodiscard]] DeltaPosition forward(const Vector3& theta_rad, DeltaAssembly assembly,
                                      const Vector3& near_m) const;
  /// Returns the positions for these angles in all assemblies.
  [[nodiscard]] DeltaPositions forward_all(const Vector3& theta_rad) const;

 private:
  DeltaGeometry g_;
};

}  // namespace longreach
