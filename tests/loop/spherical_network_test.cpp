// The trained networks: made reproducibly, and what they promise. The truth is the inverse kinematics of
// known orientations, and for the workspace's corners the path that tracking has followed from home.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>

#include "common/core/geometry_error.hpp"
#include "common/core/random.hpp"
#include "deploy/lab/campaign_size.hpp"
#include "deploy/lab/devices/spherical_catalog.hpp"
#include "deploy/lab/networks/train_spherical.hpp"

namespace longreach::spherical_network_test {
namespace {

const SphericalNetworkFile& committed() {
  static const SphericalNetworkFile kFile =
      load_spherical_network(std::filesystem::path(LONGREACH_DEPLOY) / "devices/spherical_network.txtpb");
  return kFile;
}

const SphericalKinematics& kinematics() {
  static const SphericalKinematics k(reconstructed_spherical());
  return k;
}

double angle(const Quaternion& a, const Quaternion& b) { return 2.0 * (a.conjugate() * b).vec().norm(); }

/// Tilted and turned by up to 30 degrees each: what the workspace promises to hold.
Quaternion in_the_cone(Random& random) {
  constexpr double kReach = std::numbers::pi / 6.0;
  const double tilt = random.uniform(0.0, kReach), azimuth = random.uniform(0.0, 2.0 * std::numbers::pi);
  return exp_rotation(Vector3(tilt * std::cos(azimuth), tilt * std::sin(azimuth), 0.0)) *
         exp_rotation(Vector3(0.0, 0.0, random.uniform(-kReach, kReach)));
}

TEST(TrainSpherical, WritesTheSameBytesForTheSameSeedOnly) {
  SphericalTraining tiny{
      .seed = 1, .cells_per_axis = 1, .samples = 60, .rough_samples = 60, .iterations = 5, .checks = 50};
  const auto text = [&] { return trained_text(tiny, train_spherical(tiny, {})); };
  const std::string first = text();
  EXPECT_EQ(first, text());
  tiny.seed = 2;
  EXPECT_NE(first, text());
}

TEST(TrainSpherical, LearnsWhatItIsShown) {
  const SphericalTraining small{
      .seed = 1, .cells_per_axis = 1, .samples = 200, .rough_samples = 100, .iterations = 40, .checks = 500};
  const SphericalNetworkFile file = train_spherical(small, {});
  EXPECT_LT(file.error_rms_rad, 0.02);
  EXPECT_GT(file.error_rms_rad, 0.0);
}

// In the full campaign trained again, which takes minutes; else at least as the writer would write what it
// says.
TEST(TrainSpherical, MakesTheCommittedFile) {
  const SphericalTraining training;
  const SphericalNetworkFile made = campaign(1, 0) == 1 ? train_spherical(training, {}) : committed();
  std::ifstream file(std::filesystem::path(LONGREACH_DEPLOY) / "devices/spherical_network.txtpb");
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  EXPECT_EQ(text, trained_text(training, made));
}

TEST(CommittedNetwork, IsOfTheGeometryThatItNamesAndOfNoOther) {
  EXPECT_EQ(committed().name, "reconstructed");
  EXPECT_NO_THROW(SphericalNetwork(reconstructed_spherical(), committed().config));
  EXPECT_THROW(SphericalNetwork(agile_eye(), committed().config), GeometryError);
  EXPECT_THROW(SphericalNetwork(compact_spherical(), committed().config), GeometryError);
}

TEST(CommittedNetwork, HasTheErrorThatItsFileStates) {
  const SphericalNetwork network(reconstructed_spherical(), committed().config);
  const AngleError error = network_error(kinematics(), network, SphericalTraining{}.checks);
  EXPECT_EQ(error.refused, 0);
  EXPECT_NEAR(error.max_rad, committed().error_max_rad, 1e-9);
  EXPECT_NEAR(error.rms_rad, committed().error_rms_rad, 1e-9);
  EXPECT_LT(error.max_rad, 5e-4);
}

TEST(CommittedNetwork, CoversOrientationsUpToThirtyDegrees) {
  const SphericalNetwork network(reconstructed_spherical(), committed().config);
  Random random(21);
  for (int n = 0; n < campaign(1000000, 20000); ++n) {
    const Quaternion q = in_the_cone(random);
    const Vector3 theta = kinematics().inverse(q).theta_rad;
    const SphericalEstimate estimate = network.forward(theta);
    ASSERT_EQ(estimate.status, SolutionStatus::kFound);
    ASSERT_LT(angle(q, estimate.q), 5e-4);
    ASSERT_LT(angle(q, network.refined(theta, estimate).q), 5e-7);
  }
}

// Whatever cell it begins with: what it gives is right, also where that cell was never trained.
TEST(CommittedNetwork, IsRightAfterAnyJump) {
  const SphericalNetwork network(reconstructed_spherical(), committed().config);
  const SphericalWorkspace& w = network.config().workspace;
  Random random(22);
  for (int n = 0; n < campaign(200000, 3000); ++n) {
    const Vector3 d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    const Vector3 theta = w.home_rad + d;
    if (!w.contains(theta)) continue;
    const Quaternion truth = followed_from_home(kinematics(), w, theta);
    for (int cell = 0; cell < 27; ++cell) {
      const SphericalEstimate estimate = network.forward(theta, {SolutionStatus::kFound, w.q_home, cell});
      ASSERT_EQ(estimate.status, SolutionStatus::kFound);
      ASSERT_LT(angle(truth, estimate.q), 5e-3) << "cell " << cell;
    }
  }
}

TEST(CommittedNetwork, FollowsContinuousMotionWithinItsError) {
  const SphericalNetwork network(reconstructed_spherical(), committed().config);
  SphericalEstimate estimate;
  int changes = 0;
  for (int n = 0; n < campaign(1000000, 50000); ++n) {
    const double t = 1e-3 * n;
    const double tilt = 0.5 * std::sin(1.9 * t);
    const Quaternion q = exp_rotation(Vector3(tilt * std::cos(1.1 * t), tilt * std::sin(1.1 * t), 0.0)) *
                         exp_rotation(Vector3(0.0, 0.0, 0.5 * std::sin(1.4 * t)));
    const int before = estimate.cell;
    estimate = network.forward(kinematics().inverse(q).theta_rad, estimate);
    changes += estimate.cell != before ? 1 : 0;
    ASSERT_EQ(estimate.status, SolutionStatus::kFound);
    ASSERT_LT(angle(q, estimate.q), 6e-4);
  }
  EXPECT_GT(changes, 20);
}

}  // namespace
}  // namespace longreach::spherical_network_test
