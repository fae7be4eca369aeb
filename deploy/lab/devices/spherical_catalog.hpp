#pragma once
// 3-RRR spherical devices with known or assumed angles.

#include "master/devices/spherical/spherical_geometry.hpp"

namespace longreach {

/// Returns a **reconstruction** of the device of Liu, Geng, Liu, Wang (2019), whose table of angles is not
/// available. All link angles are 90 degrees, and the base axes and the platform axes are mutually
/// orthogonal. The device is in its usual attitude, with z as the axis of symmetry.
SphericalGeometry reconstructed_spherical();

/// Returns the Agile Eye (Gosselin, Hamel 1994). All angles are 90 degrees, the base axes are x, y, z, and
/// the platform axes are x, y, z of the platform frame. At θ = 0 the middle axes are along z, x, y.
SphericalGeometry agile_eye();

/// Returns a haptic handle with shorter links than the Agile Eye and no singularity near home. All angles are
/// assumed.
SphericalGeometry compact_spherical();

}  // namespace longreach
