// Position -> angles -> position over the reachable space of many geometries, all working modes, both
// assemblies.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/core/random.hpp"
#include "deploy/lab/campaign_size.hpp"
#include "deploy/lab/devices/delta_catalog.hpp"
#include "master/devices/delta/delta_kinematics.hpp"

namespace longreach::delta_round_trip_test {
namespace {

constexpr double kThird = 2.0 * std::numbers::pi / 3.0;

std::vector<DeltaGeometry> geometries() {
  std::vector<DeltaGeometry> all{reconstructed_delta().geometry, novint_falcon().geometry,
                                 omega_like().geometry};
  for (const double size : {1e-3, 0.2, 20.0}) {
    all.emplace_back(DeltaSimple{0.2 * size, 0.4 * size, 0.9 * size, {0.0, kThird, 2.0 * kThird}});
    all.emplace_back(DeltaSimple{0.0, 0.6 * size, 0.5 * size, {0.3, 1.7, -2.2}});
    all.emplace_back(DeltaGeneral{0.4 * size,
                                  0.7 * size,
                                  0.1 * size,
                                  0.05 * size,
                                  0.08 * size,
                                  -0.1 * size,
                                  0.3 * size,
                                  0.07 * size,
                                  {2.0, 0.1, -2.4}});
  }
  return all;
}

constexpr double kTick = 0.03;  // of the span, from one tick to the next: over 5 mm for every ready device

double span(const DeltaGeometry& g) { return std::abs(g.radius_m()) + std::abs(g.side_m()) + g.size_m(); }

DeltaAssembly assembly_of(const DeltaVelocity& at) {
  return at.rods.determinant() > 0.0 ? DeltaAssembly::kPositive : DeltaAssembly::kNegative;
}

struct Figures {
  int poses = 0;
  double worst_regular = 0.0;      // of the span, where both measures are over 0.3
  double worst_conditioned = 0.0;  // of the span, divided by the condition of the pose
};

void round_trip(const DeltaKinematics& k, const Vector3& p, unsigned mode, Random& random, Figures& figures) {
  const DeltaGeometry& g = k.geometry();
  const DeltaAngles angles = k.inverse(p, mode);
  const DeltaVelocity at = velocity(g, angles.theta_rad, p);
  const DeltaSingularity distance = singularity(g, at);
  if (distance.rods < 1e-4) return;
  const Vector3 near =
      p + kTick * span(g) * Vector3(random.normal(), random.normal(), random.normal()).normalized();
  const DeltaPosition back = k.forward(angles.theta_rad, assembly_of(at), near);
  if (distance.rods > 0.1) {
    ASSERT_EQ(back.status, SolutionStatus::kFound) << p.transpose() << " mode " << mode;
  }
  if (back.status != SolutionStatus::kFound) return;
  const double error = (back.p_m - p).norm() / span(g);
  ++figures.poses;
  figures.worst_conditioned = std::max(figures.worst_conditioned, error * distance.rods);
  if (distance.rods > 0.3 && distance.arm > 0.3)
    figures.worst_regular = std::max(figures.worst_regular, error);
  ASSERT_LE(error * distance.rods, 1e-12) << p.transpose() << " mode " << mode;
  const DeltaAngles again = k.inverse(back.p_m, mode);
  ASSERT_NE(again.status, SolutionStatus::kNoSolution);
  for (int i = 0; i < 3; ++i) {
    const double change = std::remainder(again.theta_rad[i] - angles.theta_rad[i], 2.0 * std::numbers::pi);
    ASSERT_LE(std::abs(change) * distance.rods * distance.arm, 1e-12) << p.transpose() << " mode " << mode;
  }
}

TEST(Delta, ReturnsToEveryReachablePosition) {
  const int wanted = campaign(1'000'000, 20'000);
  const std::vector<DeltaGeometry> all = geometries();
  for (std::size_t n = 0; n < all.size(); ++n) {
    const DeltaKinematics k(all[n]);
    Random random = Random(7).child("delta round trip " + std::to_string(n));
    Figures figures;
    const int share = wanted / static_cast<int>(all.size());
    while (figures.poses < share) {
      const Vector3 p =
          span(all[n]) * Vector3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      if (k.inverse(p).status != SolutionStatus::kFound) continue;
      round_trip(k, p, static_cast<unsigned>(random.next() % 8), random, figures);
      if (HasFatalFailure()) FAIL() << "geometry " << n;
    }
    std::printf("geometry %zu: %d poses, error %.2g of the span (regular), %.2g times the condition\n", n,
                figures.poses, figures.worst_regular, figures.worst_conditioned);
  }
}

// Second derivation of the forward problem: two differences of the spheres' equations are planes; their line
// meets the first sphere. (The code goes through the centre and the height of the triangle.)
std::array<Vector3, 2> by_planes(const std::array<Vector3, 3>& c, double rod) {
  Eigen::Matrix<double, 2, 3> A;
  Eigen::Vector2d b;
  for (int i = 0; i < 2; ++i) {
    A.row(i) = 2.0 * (c[static_cast<std::size_t>(i) + 1] - c[0]);
    b[i] = (c[static_cast<std::size_t>(i) + 1] - c[0]).squaredNorm();
  }
  const Vector3 point = A.transpose() * (A * A.transpose()).inverse() * b;
  const Vector3 along = Vector3(A.row(0)).cross(Vector3(A.row(1))).normalized();
  const double half = std::sqrt(rod * rod - point.squaredNorm());
  return {c[0] + point + half * along, c[0] + point - half * along};
}

TEST(Delta, HasBothPositionsThatThePlanesOfTheSpheresGive) {
  const int wanted = campaign(1'000'000, 20'000);
  const DeltaKinematics k(omega_like().geometry);
  const DeltaGeometry& g = k.geometry();
  Random random = Random(7).child("delta planes");
  int compared = 0;
  while (compared < wanted) {
    const Vector3 theta(random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3));
    std::array<Vector3, 3> c;
    for (int i = 0; i < 3; ++i) {
      const double azimuth =
          std::atan2(g.to_world(i, Vector3::UnitX()).y(), g.to_world(i, Vector3::UnitX()).x());
      const double out = g.radius_m() + g.arm_m() * std::cos(theta[i]);
      c[static_cast<std::size_t>(i)] = {out * std::cos(azimuth), out * std::sin(azimuth),
                                        -g.arm_m() * std::sin(theta[i])};
    }
    const std::array<Vector3, 2> expected = by_planes(c, g.rod_m());
    const DeltaPositions found = k.forward_all(theta);
    if (!expected[0].allFinite()) {
      ASSERT_NE(found.status, SolutionStatus::kFound) << theta.transpose();
      continue;
    }
    const double height = 0.5 * (expected[0] - expected[1]).norm() / g.rod_m();
    if (height < 1e-4) continue;
    ASSERT_EQ(found.count, 2) << theta.transpose();
    for (const Vector3& p : expected) {
      const double error = std::min((found.p_m[0] - p).norm(), (found.p_m[1] - p).norm());
      const double flat = (c[1] - c[0]).cross(c[2] - c[0]).norm() / (g.rod_m() * g.rod_m());
      ASSERT_LE(error * height * flat * flat, 1e-13) << theta.transpose();
    }
    ++compared;
  }
}

// With offsets there is no closed form: every reachable position must be among those found without a previous
// one.
TEST(Delta, FindsThePositionOfAFalconWithoutAPreviousOne) {
  const int wanted = campaign(300'000, 5'000);
  const DeltaKinematics k(novint_falcon().geometry);
  Random random = Random(7).child("falcon");
  int seen = 0;
  while (seen < wanted) {
    const Vector3 p = 0.2 * Vector3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    const DeltaAngles angles = k.inverse(p);
    if (angles.status != SolutionStatus::kFound) continue;
    const double distance = singularity(k.geometry(), velocity(k.geometry(), angles.theta_rad, p)).rods;
    if (distance < 0.1) continue;
    ++seen;
    const DeltaPositions found = k.forward_all(angles.theta_rad);
    double error = 1.0;
    for (int n = 0; n < found.count; ++n)
      error = std::min(error, (found.p_m[static_cast<std::size_t>(n)] - p).norm());
    ASSERT_LE(error * distance, 1e-14) << p.transpose() << " distance " << distance;
  }
}

}  // namespace
}  // namespace longreach::delta_round_trip_test
