#pragma once
// Kinematics of a DELTA: motor angles from a platform position, and platform position from motor angles.
//
// Inverse: with E = -2 arm U, F = -2 arm w, G = U² + w² + arm² - reach², the leg closes where E cos θ + F sin
// θ + G = 0: two roots, solved by half angles; G as arm² + (dist - reach)(dist + reach), so that nothing
// cancels. Forward without offset: the two points at the rod's length from three centres (centre and height
// of their triangle). Forward with an offset: the centre is arm's end + offset * d with d the direction from
// the arm's end to the platform in the leg's plane; its spheres start a Newton iteration on |P - centre(P)| -
// rod, at most kMaxIterations.
//
// Every function accepts any input, finite or not, and returns finite numbers. Nothing allocates or throws.

#include <array>

#include "common/core/solution_status.hpp"
#include "master/devices/delta/delta_geometry.hpp"

namespace longreach {

/// Motor angles of a position. kFound: all three. kSingular: a leg is at the double point of its root or
/// turns freely; the angles close the loop. Otherwise zero.
struct DeltaAngles {
  SolutionStatus status = SolutionStatus::kNoSolution;
  Vector3 theta_rad = Vector3::Zero();  // (-pi, pi]
};

/// Both roots of each leg: `first` has the elbow on the outer side where the platform is on the working side
/// (sin(θ2 - θ) >= 0, θ2 the angle of the forearm), `second` has the other. Status and output are as in
/// DeltaAngles.
struct DeltaRoots {
  SolutionStatus status = SolutionStatus::kNoSolution;
  Vector3 first_rad = Vector3::Zero();
  Vector3 second_rad = Vector3::Zero();
};

/// Position of the platform. kFound: it closes all loops in the requested assembly. kSingular: the assemblies
/// coincide, or the ends of the forearms are collinear. `p_m` may be used only with kFound: otherwise it is
/// the previous position, if given, or zero.
struct DeltaPosition {
  SolutionStatus status = SolutionStatus::kNoSolution;
  Vector3 p_m = Vector3::Zero();
  int iterations = 0;  // 0: closed form
};

/// All positions for given motor angles, the working assembly first: two without offset (closed form). With
/// an offset: the results of a search from many starts, usually two; up to four were observed.
struct DeltaPositions {
  static constexpr int kMost = 8;

  SolutionStatus status = SolutionStatus::kNoSolution;  // kFound: count > 0
  int count = 0;
  std::array<Vector3, kMost> p_m{};  // the first `count`
};

class DeltaKinematics {
 public:
  static constexpr int kMaxIterations = 12;

  explicit DeltaKinematics(const DeltaGeometry& geometry) : g_(geometry) {}

  [[nodiscard]] const DeltaGeometry& geometry() const { return g_; }

  /// Returns the angles of the working mode: bit i of `mode` selects the second root of leg i.
  [[nodiscard]] DeltaAngles inverse(const Vector3& p_m, unsigned mode = 0) const;
  [[nodiscard]] DeltaRoots inverse_all(const Vector3& p_m) const;

  /// Returns the position in `assembly` for these angles. `near_m` (the previous position) starts the
  /// iteration of a geometry with offset, and is returned if there is no result; the assembly never changes.
  /// From near a singularity such an iteration may converge anywhere: a result farther than 10 rods times the
  /// volume of the unit rods from the start is kSingular. Steps of up to 5 mm are found where
  /// DeltaSingularity::rods is at least 0.1 (measured: down to 0.06).
  [[nodiscard]] DeltaPosition forward(const Vector3& theta_rad, DeltaAssembly assembly,
                                      const Vector3& near_m) const;
  [[nodiscard]] DeltaPositions forward_all(const Vector3& theta_rad) const;

 private:
  DeltaGeometry g_;
};

}  // namespace longreach
