#pragma once
// Figures by which the dimensions of a DELTA are judged, at a position and over a cube of positions:
//
//   conditioning = 1/κ(J) = σ_min(J)/σ_max(J),  τ = Jᵀ F      (that of J⁻ᵀ, torques to forces, is the same;
//                  all entries of J are lengths, so dividing it by the arm's length changes nothing)
//   torque_i     = |J e_i|       what motor i gives for a unit force, in the direction that is worst for it
//   bend_i       = (l_i/arm)² = (ρ/rod)² (1 - cos²γ),  cos γ = (d² - arm² - (offset + ρ)²)/(2 arm (offset +
//   ρ))
//
// l_i the lever, ρ the rods seen in the leg's plane, d the distance of the platform joint from the motor
// there, γ the angle between arm and forearm. bend continues smoothly to negative values where the leg does
// not reach, so that an optimiser finds its way back. Elbows are on the outer side (mode 0).
//
// Not handled: links that meet each other, how far ball joints turn, the device's own weight.

#include <limits>

#include "master/devices/delta/delta_geometry.hpp"

namespace longreach {

/// At one position. Out of reach: all figures but `bend` have the values below.
struct DeltaFigures {
  Vector3 bend = Vector3::Constant(-1.0);  // a leg that does not reach: negative
  double rods = 0.0;                       // least singular value of the three unit rods, 0 to 1
  double conditioning = 0.0;               // 0 to 1; 1: the same force in all directions for the same torque
  Vector3 torque_m = Vector3::Constant(std::numeric_limits<double>::infinity());  // N m per N
  Vector3 elbow_m = Vector3::Zero();  // arm's end under the base: towards the working side
};

DeltaFigures figures(const DeltaGeometry& g, const Vector3& p_m);

/// Edges along the axes of the base frame.
struct DeltaCube {
  Vector3 centre_m = Vector3::Zero();
  double side_m = 0.0;
};

/// What a device must do everywhere in its cube, and the cylinder about the base's axis into which it must
/// fit.
struct DeltaDemand {
  double conditioning = 0.0;        // at least
  double arm = 0.25;                // |l_i| / arm at least: distance from type 1 singularities
  double rods = 0.25;               // at least: distance from type 2 singularities
  double force_n = 0.0;             // in every direction
  double torque_nm = 1.0;           // with at most this torque of each motor
  double platform_radius_m = 0.02;  // of the platform joints; the base is larger by the geometry's radius
  double radius_m = 1.0;            // of the cylinder: arms stretched out stay inside
  double height_m = 1.0;            // of the cylinder: from base or highest elbow to the platform's lowest
};

/// By how much a position of a cube meets the demand: dimensionless, met where not negative. In this order:
/// bend (3), torque (3, not below -1), height (3), radius, rods, conditioning.
using DeltaSlacks = Eigen::Matrix<double, 12, 1>;
constexpr int kDeltaConditioningSlack = 11;
DeltaSlacks slacks(const DeltaGeometry& g, const DeltaDemand& demand, const DeltaCube& cube,
                   const DeltaFigures& at);

/// Over a grid of `per_edge`³ positions, corners and faces included (1: the centre). Only the mean is not the
/// worst of all.
struct DeltaCubeFigures {
  double slack = 0.0;  // least of all slacks: not negative where the whole demand is met
  double conditioning = 0.0;
  double conditioning_mean = 0.0;
  double arm = 0.0;  // least |l_i| / arm; 0 out of reach
  double rods = 0.0;
  double torque_m = 0.0;  // N m per N
  double radius_m = 0.0;  // of the cylinder that the device needs
  double height_m = 0.0;
};

DeltaCubeFigures figures(const DeltaGeometry& g, const DeltaDemand& demand, const DeltaCube& cube,
                         int per_edge);

/// Side of the largest cube about `centre_m` that meets the demand on the grid; 0 where the centre itself
/// does not. Bisection: exact to 1e-6 of the device's size, as larger cubes about the same centre contain
/// smaller ones. Between the positions the torque may be higher: with 5, 9, 17 an edge the reconstructed
/// device's cube of 4 N at 0.3 N m is 2.5, 0.9, 0.3 % larger than with 49.
double largest_cube_m(const DeltaGeometry& g, const DeltaDemand& demand, const Vector3& centre_m,
                      int per_edge);

}  // namespace longreach
