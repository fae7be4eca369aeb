#pragma once
// Figures of merit for the dimensions of a DELTA, at a position and over a cube of positions:
//
//   conditioning = 1/κ(J) = σ_min(J)/σ_max(J),  τ = Jᵀ F      (that of J⁻ᵀ, torques to forces, is equal; all
//                  entries of J are lengths, so the length of the arm does not matter)
//   torque_i     = |J e_i|       torque of motor i for a unit force in its worst direction
//   bend_i       = (l_i/arm)² = (ρ/rod)² (1 - cos²γ),  cos γ = (d² - arm² - (offset + ρ)²)/(2 arm (offset +
//   ρ))
//
// l_i is the lever, ρ the rods projected on the plane of the leg, d the distance of the platform joint from
// the motor in it, γ the angle between arm and forearm. bend continues smoothly to negative values where the
// leg does not reach, so that an optimiser can return. Elbows are on the outer side (mode 0).
//
// Not handled: collisions of links, ranges of ball joints, the weight of the device.

#include <limits>

#include "master/devices/delta/delta_geometry.hpp"

namespace longreach {

/// At one position. Out of reach, all figures except `bend` have the values below.
struct DeltaFigures {
  Vector3 bend = Vector3::Constant(-1.0);  // negative for a leg that does not reach
  double rods = 0.0;                       // minimum singular value of the three unit rods, 0 to 1
  double conditioning = 0.0;               // 0 to 1; 1: the same force in all directions for equal torque
  Vector3 torque_m = Vector3::Constant(std::numeric_limits<double>::infinity());  // N m per N
  Vector3 elbow_m = Vector3::Zero();  // end of the arm below the base: towards the working side
};

DeltaFigures figures(const DeltaGeometry& g, const Vector3& p_m);

/// Edges along the axes of the base frame.
struct DeltaCube {
  Vector3 centre_m = Vector3::Zero();
  double side_m = 0.0;
};

/// Requirements for a device in its cube, and the cylinder about the axis of the base that must contain it.
struct DeltaDemand {
  double conditioning = 0.0;  // minimum
  double arm = 0.25;          // minimum |l_i| / arm: distance from type 1 singularities
  double rods = 0.25;         // minimum: distance from type 2 singularities
  double force_n = 0.0;       // in every direction
  double torque_nm = 1.0;     // with at most this torque per motor
  /// of the platform joints; the base is larger by the radius of the geometry
  double platform_radius_m = 0.02;
  double radius_m = 1.0;  // of the cylinder, which contains stretched arms
  double height_m = 1.0;  // of the cylinder: from base or highest elbow to the lowest point of the platform
};

/// Margins of a position of a cube: dimensionless, non-negative if the requirement is fulfilled. In this
/// order: bend (3), torque (3, not below -1), height (3), radius, rods, conditioning.
using DeltaSlacks = Eigen::Matrix<double, 12, 1>;
constexpr int kDeltaConditioningSlack = 11;
DeltaSlacks slacks(const DeltaGeometry& g, const DeltaDemand& demand, const DeltaCube& cube,
                   const DeltaFigures& at);

/// Over a grid of `per_edge`³ positions, corners and faces included (1: the centre). All values are the
/// worst, except the mean.
struct DeltaCubeFigures {
  double slack = 0.0;  // minimum of all margins: non-negative if all requirements are fulfilled
  double conditioning = 0.0;
  double conditioning_mean = 0.0;
  double arm = 0.0;  // minimum |l_i| / arm; 0 out of reach
  double rods = 0.0;
  double torque_m = 0.0;  // N m per N
  double radius_m = 0.0;  // of the necessary cylinder
  double height_m = 0.0;
};

DeltaCubeFigures figures(const DeltaGeometry& g, const DeltaDemand& demand, const DeltaCube& cube,
                         int per_edge);

/// Side of the largest cube about `centre_m` that fulfils the requirements on the grid; 0 if the centre does
/// not. Bisection, exact to 1e-6 of the size of the device, because larger cubes about the same centre
/// contain smaller ones. Between the positions the torque may be higher: with 5, 9, 17 per edge the cube of
/// the reconstructed device for 4 N at 0.3 N m is 2.5, 0.9, 0.3 % larger than with 49.
double largest_cube_m(const DeltaGeometry& g, const DeltaDemand& demand, const Vector3& centre_m,
                      int per_edge);

}  // namespace longreach
