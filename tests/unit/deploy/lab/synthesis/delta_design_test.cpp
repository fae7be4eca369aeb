#include "deploy/lab/synthesis/delta_design.hpp"

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <cmath>
#include <numbers>
#include <vector>

#include "common/core/random.hpp"
#include "deploy/lab/devices/delta_catalog.hpp"
#include "master/devices/delta/delta_kinematics.hpp"
#include "master/devices/delta/delta_statics.hpp"

namespace longreach::delta_design_test {
namespace {

constexpr double kThird = 2.0 * std::numbers::pi / 3.0;

std::vector<DeltaGeometry> devices() {
  return {reconstructed_delta().geometry, novint_falcon().geometry, omega_like().geometry};
}

Vector3 anywhere(Random& random, double most) {
  return {random.uniform(-most, most), random.uniform(-most, most), random.uniform(-most, most)};
}

TEST(DeltaDesign, IsIsotropicWhereTheRodsAreOrthogonal) {
  // Arms stretched out flat, rods that lean by acos(1/√3): closed form.
  const double a = 0.04, l1 = 0.06, l2 = (a + l1) * std::sqrt(1.5);
  const DeltaGeometry g(DeltaSimple{a, l1, l2, {0.0, kThird, 2.0 * kThird}});
  const DeltaFigures at = figures(g, {0.0, 0.0, -l2 / std::sqrt(3.0)});
  EXPECT_NEAR(at.conditioning, 1.0, 1e-7);
  EXPECT_NEAR(at.rods, 1.0, 1e-7);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(at.bend[i], 1.0 / 3.0, 1e-12);
    EXPECT_NEAR(at.torque_m[i], l1 / std::sqrt(3.0), 1e-12);
    EXPECT_NEAR(at.elbow_m[i], 0.0, 1e-12);
  }
}

TEST(DeltaDesign, HasTheClosedFormOfItsAxis) {
  // On the axis NᵀN = diag(3/2 ρ², 3/2 ρ², 3 ζ²) for rods with the parts ρ across and ζ along it.
  const double a = 0.027, l1 = 0.061, l2 = 0.095;
  const DeltaGeometry g(DeltaSimple{a, l1, l2, {0.0, kThird, 2.0 * kThird}});
  for (double depth = 0.05; depth < 0.14; depth += 0.01) {
    const double to_motor = std::hypot(a, depth);
    const double at_motor = std::acos((l1 * l1 + to_motor * to_motor - l2 * l2) / (2.0 * l1 * to_motor));
    const double theta = std::atan2(depth, -a) - at_motor;  // elbow on the outer side
    const double across = std::sqrt(1.5) * (a + l1 * std::cos(theta)) / l2;
    const double along = std::sqrt(3.0) * (depth - l1 * std::sin(theta)) / l2;
    EXPECT_NEAR(figures(g, {0.0, 0.0, -depth}).conditioning,
                std::min(across, std::abs(along)) / std::max(across, std::abs(along)), 1e-7)
        << depth;
  }
}

TEST(DeltaDesign, AgreesWithSingularValuesAndBruteForce) {
  Random random(3);
  for (const DeltaGeometry& g : devices()) {
    int seen = 0;
    while (seen < 50) {
      const Vector3 p = anywhere(random, g.size_m());
      const DeltaAngles angles = DeltaKinematics(g).inverse(p);
      if (angles.status != SolutionStatus::kFound) continue;
      const DeltaVelocity v = velocity(g, angles.theta_rad, p);
      const DeltaSingularity distance = singularity(g, v);
      if (std::min(distance.arm, distance.rods) < 0.05) continue;
      ++seen;
      const DeltaFigures at = figures(g, p);
      const Matrix3 J = jacobian(v).m_per_rad;
      const Eigen::JacobiSVD<Matrix3> svd(J);
      EXPECT_NEAR(at.conditioning, svd.singularValues()[2] / svd.singularValues()[0], 1e-7);
      EXPECT_NEAR(std::sqrt(at.bend.minCoeff()), distance.arm, 1e-9);
      Vector3 most = Vector3::Zero();
      for (int n = 0; n < 2000; ++n) {
        const Vector3 force = Vector3(random.normal(), random.normal(), random.normal()).normalized();
        most = most.cwiseMax(statics(v, force).tau_nm.cwiseAbs());
      }
      for (int i = 0; i < 3; ++i) {
        EXPECT_LE(most[i], at.torque_m[i] * (1.0 + 1e-12));
        EXPECT_GE(most[i], at.torque_m[i] * 0.98);
      }
    }
  }
}

TEST(DeltaDesign, HasNegativeBendExactlyOutOfReach) {
  Random random(4);
  for (const DeltaGeometry& g : devices()) {
    int reached = 0;
    for (int n = 0; n < 5000; ++n) {
      const Vector3 p = anywhere(random, g.size_m());
      const bool reaches = DeltaKinematics(g).inverse(p).status == SolutionStatus::kFound;
      const double bend = figures(g, p).bend.minCoeff();
      EXPECT_TRUE(std::abs(bend) < 1e-9 || (bend > 0.0) == reaches) << p.transpose();
      reached += reaches ? 1 : 0;
    }
    EXPECT_GT(reached, 100);
  }
}

TEST(DeltaDesign, SurvivesEveryPosition) {
  const double kNaN = std::numeric_limits<double>::quiet_NaN();
  const double kInf = std::numeric_limits<double>::infinity();
  for (const DeltaGeometry& g : devices()) {
    for (const double x : {0.0, 1e-9, 1e9, 1e200, -1e200, 5e-324, kNaN, kInf, -kInf}) {
      for (const Vector3& p : {Vector3(x, 0.0, 0.0), Vector3(0.0, 0.0, x), Vector3(x, x, x)}) {
        const DeltaFigures at = figures(g, p);
        EXPECT_TRUE(at.conditioning >= 0.0 && at.conditioning <= 1.0);
        EXPECT_TRUE(at.rods >= 0.0 && at.rods <= 1.0 + 1e-9);
        for (int i = 0; i < 3; ++i) {
          EXPECT_FALSE(std::isnan(at.bend[i]));
          EXPECT_FALSE(std::isnan(at.torque_m[i]));
        }
        EXPECT_FALSE(figures(g, {}, {p, 0.01}, 3).slack >= 0.0 && !(std::abs(x) < 1e9));
      }
    }
    EXPECT_EQ(largest_cube_m(g, {}, Vector3::Constant(kNaN), 3), 0.0);
  }
}

/// All demands, from the kinematics and statics alone.
bool meets(const DeltaGeometry& g, const DeltaDemand& d, const Vector3& centre, double side, int per_edge) {
  for (int n = 0; n < per_edge * per_edge * per_edge; ++n) {
    const Vector3 place(n % per_edge, n / per_edge % per_edge, n / per_edge / per_edge);
    const Vector3 p = centre + side * (place / (per_edge - 1.0) - Vector3::Constant(0.5));
    const DeltaAngles angles = DeltaKinematics(g).inverse(p);
    if (angles.status != SolutionStatus::kFound) return false;
    const DeltaVelocity v = velocity(g, angles.theta_rad, p);
    const DeltaSingularity distance = singularity(g, v);
    if (distance.arm < d.arm || distance.rods < d.rods) return false;
    const Eigen::JacobiSVD<Matrix3> svd(jacobian(v).m_per_rad);
    if (svd.singularValues()[2] < d.conditioning * svd.singularValues()[0]) return false;
    for (int i = 0; i < 3; ++i) {
      const Vector3 worst = jacobian(v).m_per_rad.col(i).normalized();
      if (statics(v, d.force_n * worst).tau_nm.cwiseAbs().maxCoeff() > d.torque_nm) return false;
      const double elbow = g.elbow(i, std::cos(angles.theta_rad[i]), std::sin(angles.theta_rad[i])).z();
      const double top = std::max(g.up() * -elbow, 0.0);
      if (top + g.up() * centre.z() + 0.5 * side > d.height_m) return false;
    }
  }
  return true;
}

TEST(DeltaDesign, FindsTheCubeThatSamplingFinds) {
  DeltaDemand reach;
  reach.arm = 0.1;
  DeltaDemand forceful;
  forceful.force_n = 4.0;
  forceful.torque_nm = 0.3;
  DeltaDemand conditioned;
  conditioned.conditioning = 0.5;
  DeltaDemand low;
  low.height_m = 0.19;
  const std::vector<DeltaDemand> demands = {reach, forceful, conditioned, low};
  for (const DeltaDesign& design : {reconstructed_delta(), omega_like()}) {
    for (const DeltaDemand& d : demands) {
      const double side = largest_cube_m(design.geometry, d, design.home_m, 13);
      EXPECT_EQ(side > 0.0, meets(design.geometry, d, design.home_m, 1e-6, 5));
      if (side == 0.0) continue;
      EXPECT_TRUE(meets(design.geometry, d, design.home_m, 0.9999 * side, 13)) << side;
      EXPECT_FALSE(meets(design.geometry, d, design.home_m, 1.0001 * side, 13)) << side;
    }
  }
}

TEST(DeltaDesign, KeepsTheDeviceInItsEnvelope) {
  const DeltaDesign design = reconstructed_delta();
  const DeltaCube cube{design.home_m, 0.04};
  const DeltaCubeFigures free = figures(design.geometry, {}, cube, 5);
  EXPECT_NEAR(free.radius_m, 0.027 + 0.020 + 0.061, 1e-12);
  EXPECT_GT(free.slack, 0.0);
  for (const double change_m : {-0.001, 0.001}) {
    DeltaDemand demand;
    demand.radius_m = free.radius_m + change_m;
    EXPECT_EQ(figures(design.geometry, demand, cube, 5).slack >= 0.0, change_m > 0.0);
    demand = {};
    demand.height_m = free.height_m + change_m;
    EXPECT_EQ(figures(design.geometry, demand, cube, 5).slack >= 0.0, change_m > 0.0);
  }
}

}  // namespace
}  // namespace longreach::delta_design_test
