#pragma once
// Orientation of a 3-RRR mechanism from its motor angles by small trained networks, without iteration:
// forward kinematics (c) and (d), after Liu, Geng, Liu, Wang (2019).
//
//   g(θ) = c + B s(A θ + a),   s(z) = z (27 + z²) / (27 + 9 z²),   q = (1, g) q_home, normalised
//
// s is the Padé approximant of tanh: smooth, one division. g = axis tan(angle/2) of the rotation from home:
// three unconstrained numbers, no trigonometry, and singular only half a turn away. There is one network per
// subspace (a box of g that overlaps its neighbours); a coarse network over the whole workspace finds the
// subspace without a previous pose. In continuous motion the subspace is that of the previous tick and
// changes only half way into the overlap: no network is used outside its training range, and a border is not
// crossed back and forth.
//
// Assembly mode: the workspace is a set of motor angles (spherical_network_config.hpp) that is tested
// exactly, and in which home's assembly mode is single-valued. Angles outside, and those a whole turn away,
// have no orientation. Constant cost: at most one coarse and two fine networks. Nothing allocates or throws
// after construction; the results are bit-identical on every processor.
//
// Comparison: the source states that networks are 4 times faster than Newton-Raphson at the same accuracy, 10
// times without the coarse network. Here (`longreach-lab run fk-network`; instructions by callgrind, with
// AVX; ns on a Xeon at 2.3 GHz; maximum error), steps of 1 ms:
//
//   network                   326 instructions    44 ns   2.6e-4 rad
//   rough network, network    491                 95 ns   2.1e-4
//   one Newton step           733                 92 ns   7.5e-7   from the previous tick, without a network
//   tracking (b)              870                126 ns   5e-15
//   network, Newton step     1057                135 ns   3.4e-8
//   rough network, Newton    1179                174 ns   1e-15    to the end, from nothing
//   all solutions (a)      208500              22600 ns   1e-15
//
// Only the bare network is faster, 2.7 times in instructions, 2.9 in time, and it loses eleven digits to save
// 80 ns of a tick of a million: tracking is the default, and the network with a Newton step is worse than
// tracking in both respects. The coarse network is useful at start-up: with tracking it finds home's assembly
// mode without a previous pose.

#include "common/core/solution_status.hpp"
#include "deploy/lab/networks/spherical_network_config.hpp"

namespace longreach {

/// kFound: `q` is within the error of the networks; `cell` is the subspace for the next tick. Otherwise `q`
/// is home's orientation and `cell` is -1. kNoSolution: the angles are not finite or outside the workspace.
/// kNotConverged: no subspace contains the result. kSingular (`refined` only): the step has no finite value
/// or would leave the assembly mode.
struct SphericalEstimate {
  SolutionStatus status = SolutionStatus::kNoSolution;
  Quaternion q = Quaternion::Identity();
  int cell = -1;
};

class SphericalNetwork {
 public:
  /// Throws GeometryError if the networks were trained for another geometry, with the axis that differs, or
  /// contain values that are not finite.
  SphericalNetwork(const SphericalGeometry& geometry, SphericalNetworkConfig config);

  [[nodiscard]] const SphericalNetworkConfig& config() const { return config_; }

  /// Without a previous pose: coarse network, then that of its subspace.
  [[nodiscard]] SphericalEstimate forward(const Vector3& theta_rad) const;
  /// Continuous motion: the network of the previous subspace. A result too far from it is computed without a
  /// previous pose.
  [[nodiscard]] SphericalEstimate forward(const Vector3& theta_rad, const SphericalEstimate& previous) const;
  /// Orientation by the coarse network only.
  [[nodiscard]] SphericalEstimate rough(const Vector3& theta_rad) const;
  /// One Newton step on the closures, g <- -J^-1 (k - c)/2 about the estimate (spherical_closure.hpp), which
  /// squares the error. An estimate that is not kFound is returned unchanged.
  [[nodiscard]] SphericalEstimate refined(const Vector3& theta_rad, const SphericalEstimate& estimate) const;

 private:
  [[nodiscard]] int cell_of(const Vector3& g) const;
  [[nodiscard]] SphericalEstimate nothing(SolutionStatus status) const;
  /// The estimate g of the network of a cell, if it is in the cell.
  [[nodiscard]] SphericalEstimate accept(const Vector3& g, int cell) const;

  SphericalGeometry geometry_;
  SphericalNetworkConfig config_;
  std::vector<Vector3> centre_;  // of the cells
  Vector3 per_width_;
  int side_ = 0;  // of home's assembly mode, as in SphericalPose
};

}  // namespace longreach
