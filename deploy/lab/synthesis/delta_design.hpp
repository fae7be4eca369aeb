#pragma once
// Figures of merit for the dimensions of a DELTA device, at a position and over a cube of positions:
//
//   conditioning = 1/κ(J) = σ_min(J)/σ_max(J),  τ = Jᵀ F      (J⁻ᵀ, which maps torques to forces, has the same
//                  conditioning; all entries of J are lengths, so that the size of the device does not matter)
//   torque_i     = |J e_i|       torque of motor i for a unit force in its worst direction
//   bend_i       = (l_i/arm)² = (ρ/rod)² (1 - cos²γ)
//                  cos γ = (d² - arm² - (offset + ρ)²)/(2 arm (offset + ρ))
//
// Here l_i is the lever arm, ρ the length of the rods projected onto the plane of the leg, d the distance
// between platform joint and motor in that plane, and γ the angle between arm and forearm. bend becomes
// negative smoothly where the leg cannot reach the position, so that an optimiser can find its way back to
// the reachable region. The elbows are on the outer side (mode 0).
//
// Collisions between links, the range of the ball joints and the weight of the device are not considered.

#include <limits>

#include "master/devices/delta/delta_geometry.hpp"

namespace longreach {

/// The figures of merit at one position. If the position is out of reach, all of them except `bend` have the
/// default values below.
struct DeltaFigures {
  Vector3 bend = Vector3::Constant(-1.0);  // negative for a leg that does not reach the position
  /// Minimum singular value of the matrix of the three unit rod vectors, 0 to 1.
  double rods = 0.0;
  /// 0 to 1; at 1, torques of the same magnitude give the same force in all directions.
  double conditioning = 0.0;
  Vector3 torque_m = Vector3::Constant(std::numeric_limits<double>::infinity());  // N m per N
  /// Distance of the end of each arm below the base, i.e. on the side of the workspace.
  Vector3 elbow_m = Vector3::Zero();
};

DeltaFigures figures(const DeltaGeometry& g, const Vector3& p_m);

/// A cube with edges along the axes of the base frame.
struct DeltaCube {
  Vector3 centre_m = Vector3::Zero();
  double side_m = 0.0;
};

/// Requirements that a device must fulfil within its cube, and the cylinder about the axis of the base that
/// must contain the device.
struct DeltaDemand {
  double conditioning = 0.0;  // required minimum of `conditioning`
  double arm = 0.25;          // required minimum of |l_i| / arm, the distance from type 1 singularities
  double rods = 0.25;         // required minimum of `rods`, the distance from type 2 singularities
  double force_n = 0.0;       // required force in every direction
  double torque_nm = 1.0;     // available torque per motor
  /// Radius of the circle through the platform joints. The radius of the base is the sum of this radius and
  /// that of the geometry.
  double platform_radius_m = 0.02;
  double radius_m = 1.0;  // radius of the cylinder, which must contain the stretched arms
  /// Height of the cylinder, from the base or the highest elbow to the lowest point of the platform.
  double height_m = 1.0;
};

/// Dimensionless margins at one position of a cube; a margin is non-negative if its requirement is fulfilled.
/// The order is: bend (3), torque (3, limited to -1 or more), height (3), radius, rods, conditioning.
using DeltaSlacks = Eigen::Matrix<double, 12, 1>;
constexpr int kDeltaConditioningSlack = 11;
DeltaSlacks slacks(const DeltaGeometry& g, const DeltaDemand& demand, const DeltaCube& cube,
                   const DeltaFigures& at);

/// The figures of merit over a grid of `per_edge`³ positions, including corners and faces (1: only the
/// centre). All values except the mean are the worst values on the grid.
struct DeltaCubeFigures {
  double slack = 0.0;  // minimum of all margins; non-negative if all requirements are fulfilled
  double conditioning = 0.0;
  double conditioning_mean = 0.0;
  double arm = 0.0;  // minimum of |l_i| / arm; 0 if a position is out of reach
  double rods = 0.0;
  double torque_m = 0.0;  // N m per N
  double radius_m = 0.0;  // radius of the smallest cylinder that contains the device
  double height_m = 0.0;
};

DeltaCubeFigures figures(const DeltaGeometry& g, const DeltaDemand& demand, const DeltaCube& cube,
                         int per_edge);

/// Returns the side of the largest cube about `centre_m` that fulfils the requirements on the grid, or 0 if
/// the centre itself does not. It is found by bisection, accurate to 1e-6 of the size of the device;
/// bisection is valid because larger cubes about the same centre contain the smaller ones. The required
/// torque may be higher between the grid positions: with 5, 9 and 17 positions per edge, the cube of the
/// reconstructed device for 4 N at 0.3 N m is 2.5, 0.9 and 0.3 % larger than with 49.
double largest_cube_m(const DeltaGeometry& g, const DeltaDemand& demand, const Vector3& centre_m,
                      int per_edge);

}  // namespace longreach
