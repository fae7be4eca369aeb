// Orientation -> angles -> orientation over all reachable orientations, all working modes; and long tracking.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "common/core/random.hpp"
#include "deploy/lab/campaign_size.hpp"
#include "deploy/lab/devices/spherical_catalog.hpp"
#include "master/devices/spherical/spherical_kinematics.hpp"
#include "master/devices/spherical/spherical_statics.hpp"

namespace longreach::spherical_round_trip_test {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

std::vector<SphericalGeometry> geometries() {
  return {
      agile_eye(), reconstructed_spherical(), compact_spherical(),
      SphericalGeometry(SphericalAngles{45.0 * kDegree, 90.0 * kDegree, 0.0, 90.0 * kDegree}),
      SphericalGeometry(SphericalAngles{110.0 * kDegree, 70.0 * kDegree, 100.0 * kDegree, 40.0 * kDegree})};
}

double angle_between(const Quaternion& a, const Quaternion& b) {
  return 2.0 * std::asin(std::min(1.0, (a * b.conjugate()).vec().norm()));
}

Vector3 any_direction(Random& random) {
  return Vector3(random.normal(), random.normal(), random.normal()).normalized();
}

Quaternion any_rotation(Random& random) {
  return Quaternion(random.normal(), random.normal(), random.normal(), random.normal()).normalized();
}

// A step of up to 5 degrees, from a pose and to a pose that both are at the stated distance from singularity
// at least.
TEST(Spherical, FollowsEveryStepOfFiveDegreesAwayFromSingularity) {
  const int wanted = campaign(1'000'000, 20'000);
  const std::vector<SphericalGeometry> all = geometries();
  for (std::size_t n = 0; n < all.size(); ++n) {
    const SphericalKinematics k(all[n]);
    Random random = Random(13).child("follow " + std::to_string(n));
    const int share = wanted / static_cast<int>(all.size());
    int poses = 0, most = 0;
    double worst = 0.0, sum = 0.0;
    while (poses < share) {
      const Quaternion q = any_rotation(random);
      const unsigned mode = static_cast<unsigned>(random.next() % 8);
      const SphericalMotors motors = k.inverse(q, mode);
      const Quaternion before = exp_rotation(random.uniform(0, 5.0 * kDegree) * any_direction(random)) * q;
      const SphericalMotors motors_before = k.inverse(before, mode);
      if (motors.status != SolutionStatus::kFound || motors_before.status != SolutionStatus::kFound) continue;
      const double d = singularity(all[n], velocity(all[n], motors.theta_rad, q)).platform;
      const double d_before = singularity(all[n], velocity(all[n], motors_before.theta_rad, before)).platform;
      if (std::min(d, d_before) < SphericalKinematics::kTrackedDistance) continue;
      ++poses;
      const SphericalPose back = k.forward(motors.theta_rad, {SolutionStatus::kFound, before});
      ASSERT_EQ(back.status, SolutionStatus::kFound)
          << "geometry " << n << " distance " << d << " " << d_before << " iterations " << back.iterations;
      const double error = angle_between(back.q, q) * d;
      ASSERT_LE(error, 1e-12) << "geometry " << n << " distance " << d << " before " << d_before;
      worst = std::max(worst, error);
      most = std::max(most, back.iterations);
      sum += back.iterations;
    }
    std::printf("geometry %zu: %d poses, error %.2g rad times the condition, iterations %.2f, at most %d\n",
                n, poses, worst, sum / poses, most);
  }
}

// Every working mode of every reachable orientation closes, and the angles come back.
TEST(Spherical, ClosesEveryLegInEveryWorkingMode) {
  const int wanted = campaign(1'000'000, 20'000);
  const std::vector<SphericalGeometry> all = geometries();
  Random random = Random(13).child("modes");
  for (int sample = 0; sample < wanted;) {
    const SphericalGeometry& g = all[static_cast<std::size_t>(random.next() % all.size())];
    const SphericalKinematics k(g);
    const Quaternion q = any_rotation(random);
    const SphericalRoots roots = k.inverse_all(q);
    if (roots.status != SolutionStatus::kFound) continue;
    ++sample;
    for (unsigned mode = 0; mode < 8; ++mode) {
      const Vector3 theta = k.inverse(q, mode).theta_rad;
      for (int i = 0; i < 3; ++i) {
        const double expected = (mode >> i & 1U) != 0 ? roots.second_rad[i] : roots.first_rad[i];
        ASSERT_EQ(theta[i], expected);
        const SphericalGeometry::Leg& l = g.leg(i);
        const Vector3 w = Eigen::AngleAxisd(theta[i], l.u) * Vector3(l.w_axial + l.w_cos);
        ASSERT_NEAR(w.dot(q * l.v), g.cos_alpha2(), 4e-15);
        ASSERT_GE((mode >> i & 1U) != 0 ? -l.u.dot(w.cross(q * l.v)) : l.u.dot(w.cross(q * l.v)), -1e-9);
      }
    }
  }
}

TEST(Spherical, DoesNotDriftWhileItTracks) {
  const int ticks = campaign(1'000'000, 50'000);
  const SphericalGeometry g = reconstructed_spherical();
  const SphericalKinematics k(g);
  const Quaternion home(Eigen::AngleAxisd(0.0, Vector3::UnitZ()));
  SphericalPose tracked{SolutionStatus::kFound, home};
  double worst = 0.0, last = 0.0, sum = 0.0;
  for (int tick = 0; tick < ticks; ++tick) {
    const double t = 1e-3 * tick;
    const Quaternion q =
        exp_rotation(Vector3(0.3 * std::sin(1.3 * t), 0.3 * std::sin(1.7 * t), 0.4 * std::sin(0.9 * t))) *
        home;
    const SphericalMotors motors = k.inverse(q);
    ASSERT_EQ(motors.status, SolutionStatus::kFound) << t;
    const SphericalPose pose = k.forward(motors.theta_rad, tracked);
    ASSERT_EQ(pose.status, SolutionStatus::kFound) << t;
    tracked = pose;
    last = angle_between(tracked.q, q);
    worst = std::max(worst, last);
    sum += pose.iterations;
  }
  EXPECT_LE(worst, 5e-15);
  std::printf("%d ticks: error %.2g rad at most, %.2g at the end, %.2f iterations\n", ticks, worst, last,
              sum / ticks);
}

// Along arbitrary motions of the motors, through singularities and beyond where there is any pose: a pose
// that is called found closes the loops and lies on the same side of the singularity as the one before.
TEST(Spherical, NeverChangesItsAssemblyModeSilently) {
  const int wanted = campaign(1'000'000, 30'000);
  const std::vector<SphericalGeometry> all = geometries();
  int found = 0, refused = 0;
  for (std::size_t n = 0; n < all.size(); ++n) {
    const SphericalKinematics k(all[n]);
    Random random = Random(13).child("across " + std::to_string(n));
    for (int sample = 0; sample < wanted / 100; ++sample) {
      Quaternion q = any_rotation(random);
      SphericalMotors motors = k.inverse(q, static_cast<unsigned>(random.next() % 8));
      if (motors.status != SolutionStatus::kFound) continue;
      Vector3 theta = motors.theta_rad;
      const Vector3 rate = random.uniform(0.001, 0.1) * any_direction(random);
      double side = velocity(all[n], theta, q).normals.determinant();
      SphericalPose previous{SolutionStatus::kFound, q, side < 0.0 ? 1 : -1};
      for (int tick = 0; tick < 100; ++tick) {
        theta += rate;
        const SphericalPose pose = k.forward(theta, previous);
        ASSERT_TRUE(pose.q.coeffs().allFinite());
        if (pose.status != SolutionStatus::kFound) {
          ASSERT_EQ(pose.q.coeffs(), q.coeffs());
          ++refused;
          break;
        }
        ++found;
        const SphericalVelocity at = velocity(all[n], theta, pose.q);
        ASSERT_GT(at.normals.determinant() * side, 0.0);
        for (int i = 0; i < 3; ++i) ASSERT_NEAR(at.normals.row(i).norm(), 1.0, 1e-12);
        ASSERT_LE(angle_between(pose.q, q), 1.6);
        side = at.normals.determinant();
        previous = pose;
        q = pose.q;
      }
    }
  }
  std::printf("%d steps found, %d paths ended at a singularity\n", found, refused);
  EXPECT_GT(found, refused);
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace longreach::spherical_round_trip_test
