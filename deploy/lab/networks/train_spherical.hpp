#pragma once
// Trains the networks of the reconstructed 3-RRR device. The samples of its forward kinematics are uniform
// over the motor angles of the workspace. Each sample is the end of a path from home that tracking (b)
// follows in small steps, so that all samples are in the assembly mode of the home position. The coarse
// network is trained with all samples; the network of a subspace is trained with the samples in that
// subspace, including the overlap. The workspace contains all orientations with a tilt of the handle of up to
// 30 degrees and a rotation about its axis of up to 30 degrees.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "deploy/lab/networks/spherical_network.hpp"
#include "deploy/lab/networks/spherical_network_file.hpp"
#include "master/devices/spherical/spherical_kinematics.hpp"

namespace longreach {

struct SphericalTraining {
  std::uint64_t seed = 1;
  int cells_per_axis = 3;
  int samples = 800;         // per network
  int rough_samples = 1600;  // for the coarse network
  int iterations = 500;      // iterations of the optimiser, per network
  int checks = 20000;        // number of samples for measuring the error
};

/// Returns the orientation in the assembly mode of the home position for motor angles in the workspace.
/// Throws std::runtime_error if there is a singularity on the path from home, because the set is then not a
/// valid workspace.
Quaternion followed_from_home(const SphericalKinematics& kinematics, const SphericalWorkspace& workspace,
                              const Vector3& theta_rad);

struct AngleError {
  double max_rad = 0.0;
  double rms_rad = 0.0;
  int refused = 0;  // samples without a solution; they are not included in the statistics
};

/// Measures the error, including that of the coarse network, over `count` uniformly distributed motor angles
/// of the workspace. Every call uses the same angles.
AngleError network_error(const SphericalKinematics& kinematics, const SphericalNetwork& network, int count);

/// Trains all networks. `progress` may be empty; otherwise it is called with a line of text at the beginning
/// and after every network.
SphericalNetworkFile train_spherical(const SphericalTraining& training,
                                     const std::function<void(const std::string&)>& progress);

/// Returns the text of the file, with a comment that states how the file was created.
std::string trained_text(const SphericalTraining& training, const SphericalNetworkFile& network);

}  // namespace longreach
