#pragma once
// 3-RRR spherical devices with known or assumed angles.

#include "master/devices/spherical/spherical_geometry.hpp"

namespace longreach {

/// The device of Liu, Geng, Liu, Wang (2019), **reconstructed**, because its table of angles is lost. All
/// link angles are 90 degrees, base and platform axes are orthogonal, in its usual attitude with z as the
/// axis of symmetry.
SphericalGeometry reconstructed_spherical();

/// The Agile Eye (Gosselin, Hamel 1994): all angles 90 degrees, base axes x, y, z, platform axes the
/// platform's x, y, z, and at θ = 0 the middle axes along z, x, y.
SphericalGeometry agile_eye();

/// A haptic handle with shorter links than the Agile Eye's, far from singularity about home; assumed.
SphericalGeometry compact_spherical();

}  // namespace longreach
