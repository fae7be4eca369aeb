#pragma once
// DELTA devices with known or assumed dimensions.

#include "master/devices/delta/delta_statics.hpp"

namespace longreach {

struct DeltaDesign {
  DeltaGeometry geometry;
  DeltaMasses masses;
  Vector3 home_m;  // platform at rest, in the base frame
};

/// The device of Liu, Geng, Liu, Wang (Chinese Journal of Aeronautics 32(3), 2019), **reconstructed**,
/// because its published tables are lost. Its parameters were chosen so that the gravity torques (gravity
/// along -z) are near the values measured in the paper: 16.3 mN m at home, 15.6, 13.5 and 18.8 mN m at [1.5,
/// 17.7, 33.3] mm from it; within 7 %.
DeltaDesign reconstructed_delta();

/// Novint Falcon: dimensions of libnifalcon (BSD); masses and home are assumed. The working side is +z.
DeltaDesign novint_falcon();

/// A desktop device with the workspace of an omega.3 (CHAI3D: radius 75 mm). All dimensions and masses are
/// assumed.
DeltaDesign omega_like();

}  // namespace longreach
