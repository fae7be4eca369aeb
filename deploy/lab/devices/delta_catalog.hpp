#pragma once
// DELTA devices with known or assumed dimensions.

#include "master/devices/delta/delta_statics.hpp"

namespace longreach {

struct DeltaDesign {
  DeltaGeometry geometry;
  DeltaMasses masses;
  Vector3 home_m;  // home position of the platform in the base frame
};

/// Returns a **reconstruction** of the device of Liu, Geng, Liu, Wang (Chinese Journal of Aeronautics 32(3),
/// 2019), whose tables of dimensions are not available. The parameters were chosen so that the gravity
/// torques (gravity along -z) agree within 7 % with those measured in the paper: 16.3 mN m at home, and 15.6,
/// 13.5 and 18.8 mN m at the position [1.5, 17.7, 33.3] mm from home.
DeltaDesign reconstructed_delta();

/// Returns the Novint Falcon, with the dimensions from libnifalcon (BSD). Masses and home are assumed. The
/// working side is +z.
DeltaDesign novint_falcon();

/// Returns a desktop device with the workspace of an omega.3 (radius 75 mm according to CHAI3D). All
/// dimensions and masses are assumed.
DeltaDesign omega_like();

}  // namespace longreach
