#pragma once
// Trains the networks of the reconstructed 3-RRR device: samples of its forward kinematics, uniform over the
// motor angles of the workspace, each the end of a path from home that tracking (b) has followed in small
// steps, so that all are of home's assembly mode; one coarse network over all of them, one network per
// subspace over the samples in it, including the overlap. The workspace contains every orientation with a
// tilt of the handle of up to 30 degrees and a rotation of up to 30 degrees about itself.

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
  int rough_samples = 1600;  // of the rough network
  int iterations = 500;      // of the optimiser, per network
  int checks = 20000;        // samples for measuring the error
};

/// Orientation of home's assembly mode at motor angles of the workspace. Throws std::runtime_error if there
/// is a singularity in between: such a set is not a valid workspace.
Quaternion followed_from_home(const SphericalKinematics& kinematics, const SphericalWorkspace& workspace,
                              const Vector3& theta_rad);

struct AngleError {
  double max_rad = 0.0;
  double rms_rad = 0.0;
  int refused = 0;  // without an orientation; not included in the statistics
};

/// Error over `count` uniform motor angles of the workspace, the same in every call; with the coarse network.
AngleError network_error(const SphericalKinematics& kinematics, const SphericalNetwork& network, int count);

/// `progress` is called at the beginning and after every network with a line of text; may be empty.
SphericalNetworkFile train_spherical(const SphericalTraining& training,
                                     const std::function<void(const std::string&)>& progress);

/// Text of the file, with a comment on its creation.
std::string trained_text(const SphericalTraining& training, const SphericalNetworkFile& network);

}  // namespace longreach
