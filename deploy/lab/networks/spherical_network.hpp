#pragma once
// Forward kinematics of a 3-RRR mechanism by small trained networks, without iteration: methods (c) and (d),
// after Liu, Geng, Liu, Wang (2019).
//
//   g(θ) = c + B s(A θ + a),   s(z) = z (27 + z²) / (27 + 9 z²),   q = (1, g) q_home, normalised
//
// s is a Padé approximant of tanh, which is smooth and needs one division. g = axis tan(angle/2) describes
// the rotation from home by three unconstrained numbers without trigonometry; it is singular only at half a
// turn. The workspace is divided into subspaces: boxes in g that overlap their neighbours, with one network
// each. Without a previous pose, a coarse network over the whole workspace finds the subspace. In continuous
// motion, the subspace of the previous tick is kept until the result is halfway into the overlap, so that no
// network is used outside its training range and the subspace does not alternate at a border.
//
// The workspace is a set of motor angles (spherical_network_config.hpp) for which the orientation in the
// assembly mode of the home position is unique. Membership is tested exactly; angles outside the workspace,
// including those a full turn away, have no solution. The cost is bounded: at most one coarse and two fine
// networks are evaluated. No function allocates memory or throws after construction, and the results are
// bit-identical on every processor.
//
// The source paper states that networks are 4 times faster than Newton-Raphson at the same accuracy, and 10
// times faster without the coarse network. We measured (`longreach-lab run fk-network`), with steps of 1 ms,
// instructions (callgrind, with AVX), time (Xeon at 2.3 GHz) and maximum error:
//
//   network                   326 instructions    44 ns   2.6e-4 rad
//   rough network, network    491                 95 ns   2.1e-4
//   one Newton step           733                 92 ns   7.5e-7   from the previous pose, without a network
//   tracking (b)              870                126 ns   5e-15
//   network, Newton step     1057                135 ns   3.4e-8
//   rough network, Newton    1179                174 ns   1e-15    until convergence, without a previous pose
//   all solutions (a)      208500              22600 ns   1e-15
//
// Only the network without a Newton step is faster than tracking (2.7 times in instructions, 2.9 times in
// time), but it sacrifices eleven digits of accuracy to save 80 ns of a tick of 1,000,000 ns. The network
// with a Newton step is slower and less accurate than tracking. Tracking is therefore the default. The coarse
// network is useful at start-up, where it provides tracking with a pose in the assembly mode of the home
// position.

#include "common/core/solution_status.hpp"
#include "deploy/lab/networks/spherical_network_config.hpp"

namespace longreach {

/// Result of the networks. kFound: `q` is accurate to within the error of the networks, and `cell` is the
/// subspace to be passed to the next tick. In all other cases `q` is the orientation at home and `cell` is
/// -1. kNoSolution: the angles are not finite or are outside the workspace. kNotConverged: no subspace
/// contains the result. kSingular (`refined` only): the Newton step is not finite or would change the
/// assembly mode.
struct SphericalEstimate {
  SolutionStatus status = SolutionStatus::kNoSolution;
  Quaternion q = Quaternion::Identity();
  int cell = -1;
};

class SphericalNetwork {
 public:
  /// Throws a GeometryError if the networks were trained for another geometry (the error names the axis that
  /// differs) or contain non-finite values.
  SphericalNetwork(const SphericalGeometry& geometry, SphericalNetworkConfig config);

  [[nodiscard]] const SphericalNetworkConfig& config() const { return config_; }

  /// Without a previous pose: evaluates the coarse network, then the network of the subspace that it found.
  [[nodiscard]] SphericalEstimate forward(const Vector3& theta_rad) const;
  /// For continuous motion: evaluates the network of the previous subspace. If the result is too far outside
  /// that subspace, it is recomputed as if there were no previous pose.
  [[nodiscard]] SphericalEstimate forward(const Vector3& theta_rad, const SphericalEstimate& previous) const;
  /// Returns the orientation according to the coarse network only.
  [[nodiscard]] SphericalEstimate rough(const Vector3& theta_rad) const;
  /// Performs one Newton step on the closure equations about the estimate, g <- -J^-1 (k - c)/2
  /// (spherical_closure.hpp), which squares the error. An estimate that is not kFound is returned unchanged.
  [[nodiscard]] SphericalEstimate refined(const Vector3& theta_rad, const SphericalEstimate& estimate) const;

 private:
  [[nodiscard]] int cell_of(const Vector3& g) const;
  [[nodiscard]] SphericalEstimate nothing(SolutionStatus status) const;
  /// Returns the estimate for g, the output of the network of a cell, if g is in that cell.
  [[nodiscard]] SphericalEstimate accept(const Vector3& g, int cell) const;

  SphericalGeometry geometry_;
  SphericalNetworkConfig config_;
  std::vector<Vector3> centre_;  // centres of the cells
  Vector3 per_width_;
  int side_ = 0;  // assembly mode at home, as in SphericalPose
};

}  // namespace longreach
