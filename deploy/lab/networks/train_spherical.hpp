#pragma once
// Trains the networks of the reconstructed 3-RRR device: samples of its forward kinematics, drawn evenly over
// the workspace's motor angles, each the end of a path from home that tracking (b) has followed in small
// steps, so all are of home's assembly mode; one rough network over all of them, one network a subspace over
// what lies in it, overlap included. The workspace holds every orientation whose handle is tilted by up to 30
// degrees and turned by up to 30 degrees about itself.

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
  int samples = 800;         // a network
  int rough_samples = 1600;  // of the rough network
  int iterations = 500;      // of the optimiser, a network
  int checks = 20000;        // samples that the error is measured on
};

/// Orientation of home's assembly mode at motor angles of the workspace. Throws std::runtime_error where a
/// singularity is on the way: such a set is no workspace.
Quaternion followed_from_home(const SphericalKinematics& kinematics, const SphericalWorkspace& workspace,
                              const Vector3& theta_rad);

struct AngleError {
  double max_rad = 0.0;
  double rms_rad = 0.0;
  int refused = 0;  // without an orientation; not in the figures
};

/// Error over `count` evenly drawn motor angles of the workspace, the same at every call; with rough network.
AngleError network_error(const SphericalKinematics& kinematics, const SphericalNetwork& network, int count);

/// `progress` is called at the beginning and after every network with a line about it; may be empty.
SphericalNetworkFile train_spherical(const SphericalTraining& training,
                                     const std::function<void(const std::string&)>& progress);

/// The file's text, with a comment that says how it was made.
std::string trained_text(const SphericalTraining& training, const SphericalNetworkFile& network);

}  // namespace longreach
