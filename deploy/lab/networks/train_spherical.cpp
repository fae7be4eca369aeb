#include "deploy/lab/networks/train_spherical.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "common/text/number_text.hpp"
#include "deploy/lab/devices/spherical_catalog.hpp"
#include "deploy/lab/networks/train_perceptron.hpp"

namespace longreach {
namespace {

// The range needed for a tilt of 30 degrees with a rotation of 30 degrees (0.468 and 0.503 rad), plus a
// margin.
constexpr double kCommon_rad = 0.48, kDifferential_rad = 0.52;
constexpr double kOverlap = 0.25;
/// Margin by which the samples extend beyond the workspace, so that its border is inside.
constexpr double kBeyond = 1.04;
constexpr int kSteps = 16;             // from home: under 5 degrees each
constexpr int kDrawsPerSample = 2000;  // before a subspace counts as out of reach

Vector3 turn_from_home(const SphericalWorkspace& w, const Quaternion& q) {
  const Quaternion turn = q * w.q_home.conjugate();
  return turn.vec() / turn.w();
}

Vector3 draw(const SphericalWorkspace& w, Random& random) {
  const double reach = w.common_rad + w.differential_rad;
  while (true) {
    const Vector3 d(random.uniform(-reach, reach), random.uniform(-reach, reach),
                    random.uniform(-reach, reach));
    if (w.contains(w.home_rad + d)) return w.home_rad + d;
  }
}

SphericalAxes axes_of(const SphericalGeometry& g) {
  const Vector3 zero = Vector3::Zero();  // adding it leaves no "-0"
  SphericalAxes axes;
  axes.alpha1 = std::atan2(g.sin_alpha1(), g.leg(0).u.dot(g.leg(0).w_axial));
  axes.alpha2 = std::atan2(g.sin_alpha2(), g.cos_alpha2());
  for (int i = 0; i < 3; ++i) {
    axes.u.row(i) = g.leg(i).u + zero;
    axes.v.row(i) = g.leg(i).v + zero;
    axes.w0.row(i) = g.leg(i).w_axial + g.leg(i).w_cos + zero;
  }
  return axes;
}

/// Draws samples of the slightly enlarged workspace with g in the box centre ± half.
struct Sampler {
  const SphericalKinematics& kinematics;
  const SphericalWorkspace& workspace;
  SphericalWorkspace drawn = beyond(workspace);

  static SphericalWorkspace beyond(SphericalWorkspace w) {
    w.common_rad *= kBeyond, w.differential_rad *= kBeyond;
    return w;
  }
  [[nodiscard]] std::vector<PerceptronSample> operator()(int count, const Vector3& centre,
                                                         const Vector3& half, Random random) const {
    std::vector<PerceptronSample> samples;
    for (int n = 0; n < count * kDrawsPerSample && static_cast<int>(samples.size()) < count; ++n) {
      const Vector3 theta = draw(drawn, random);
      const Vector3 g = turn_from_home(workspace, followed_from_home(kinematics, workspace, theta));
      if (((g - centre).cwiseAbs().array() <= half.array()).all()) samples.push_back({theta, g});
    }
    if (static_cast<int>(samples.size()) < count)
      throw std::runtime_error("one of the cells contains too few poses that lie in the workspace");
    return samples;
  }
};

std::string figure(double value) {
  char text[24];
  std::snprintf(text, sizeof text, "%.1e", value);
  return text;
}

double four_digits(double x) {
  char text[24];
  std::snprintf(text, sizeof text, "%.4g", x);
  return parse_number(text).value();
}

}  // namespace

Quaternion followed_from_home(const SphericalKinematics& kinematics, const SphericalWorkspace& workspace,
                              const Vector3& theta_rad) {
  SphericalPose pose{SolutionStatus::kFound, workspace.q_home};
  for (int step = 1; step <= kSteps; ++step) {
    const double share = static_cast<double>(step) / kSteps;
    pose = kinematics.forward(workspace.home_rad + share * (theta_rad - workspace.home_rad), pose);
    if (pose.status != SolutionStatus::kFound)
      throw std::runtime_error("a pose in the workspace is singular");
  }
  return pose.q;
}

AngleError network_error(const SphericalKinematics& kinematics, const SphericalNetwork& network, int count) {
  Random random = Random(0).child("check");
  const SphericalWorkspace& workspace = network.config().workspace;
  AngleError error;
  double sum = 0.0;
  for (int n = 0; n < count; ++n) {
    const Vector3 theta = draw(workspace, random);
    const SphericalEstimate estimate = network.forward(theta);
    if (estimate.status != SolutionStatus::kFound) {
      ++error.refused;
      continue;
    }
    const Quaternion truth = followed_from_home(kinematics, workspace, theta);
    const double angle = 2.0 * (truth.conjugate() * estimate.q).vec().norm();
    error.max_rad = std::max(error.max_rad, angle);
    sum += angle * angle;
  }
  error.rms_rad = std::sqrt(sum / std::max(1, count - error.refused));
  return error;
}

SphericalNetworkFile train_spherical(const SphericalTraining& t,
                                     const std::function<void(const std::string&)>& progress) {
  const SphericalKinematics kinematics(reconstructed_spherical());
  SphericalNetworkFile file{"reconstructed", {}, 0.0, 0.0};
  SphericalNetworkConfig& c = file.config;
  c.axes = axes_of(kinematics.geometry());
  c.workspace.q_home = Quaternion::Identity();
  c.workspace.home_rad = kinematics.inverse(c.workspace.q_home).theta_rad;
  c.workspace.common_rad = kCommon_rad;
  c.workspace.differential_rad = kDifferential_rad;

  const int n = t.cells_per_axis, count = n * n * n;
  if (progress) progress("training a coarse network and " + std::to_string(count) + " fine networks");
  const Random random = Random(t.seed).child("spherical");
  const Sampler sample{kinematics, c.workspace};
  const auto everywhere =
      sample(t.rough_samples, Vector3::Zero(), Vector3::Constant(1e9), random.child("rough"));
  c.rough = train_perceptron(everywhere, t.iterations, random.child("rough weights"));
  if (progress) progress("trained the coarse network for the whole workspace");

  Vector3 reach = Vector3::Zero();
  for (const PerceptronSample& s : everywhere) reach = reach.cwiseMax(s.out.cwiseAbs());
  c.cells.per_axis = n;
  c.cells.overlap = kOverlap;
  for (int axis = 0; axis < 3; ++axis) c.cells.width[axis] = four_digits(2.0 * reach[axis] / n);
  for (int i = 0; i < count; ++i) {
    const Vector3 at(i / (n * n) - n / 2, i / n % n - n / 2, i % n - n / 2);
    const std::string name = "cell " + std::to_string(i);
    const auto samples = sample(t.samples, at.cwiseProduct(c.cells.width), (0.5 + kOverlap) * c.cells.width,
                                random.child(name));
    c.fine.push_back(train_perceptron(samples, t.iterations, random.child(name + " weights")));
    if (progress)
      progress("trained the fine network of cell " + std::to_string(i + 1) + " of " + std::to_string(count));
  }

  const AngleError error = network_error(kinematics, SphericalNetwork(kinematics.geometry(), c), t.checks);
  file.error_max_rad = error.max_rad;
  file.error_rms_rad = error.rms_rad;
  if (progress) {
    progress("error over " + std::to_string(t.checks) + " test samples: maximum " + figure(error.max_rad) +
             ", rms " + figure(error.rms_rad) +
             " rad; samples without a result: " + std::to_string(error.refused));
  }
  return file;
}

std::string trained_text(const SphericalTraining& t, const SphericalNetworkFile& network) {
  return spherical_network_text(
      network,
      "# Networks for the forward kinematics of a 3-RRR device: schema and meaning in proto/network.proto.\n"
      "# Made by `longreach-lab train spherical --seed " +
          std::to_string(t.seed) + "`; do not edit.\n");
}

}  // namespace longreach
