// Oracles: Eigen's AngleAxis and homogeneous 4x4 matrices.

#include "common/spatial/spatial.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "common/core/random.hpp"

namespace longreach::spatial_test {
namespace {

using Matrix4 = Eigen::Matrix4d;
constexpr double kPi = std::numbers::pi;

Vector3 random_vector(Random& random) { return {random.normal(), random.normal(), random.normal()}; }

Pose random_pose(Random& random) { return {random_vector(random), exp_rotation(random_vector(random))}; }

Matrix4 homogeneous(const Pose& X) {
  Matrix4 m = Matrix4::Identity();
  m.topLeftCorner<3, 3>() = X.q.toRotationMatrix();
  m.topRightCorner<3, 1>() = X.p;
  return m;
}

TEST(Spatial, ExponentialAgreesWithAngleAxis) {
  Random random(1);
  for (const double angle :
       {1e-12, 1e-6, 0.99e-4, 1.01e-4, 0.1, 1.0, kPi - 1e-9, kPi, 4.0, 2.0 * kPi, 100.0}) {
    const Vector3 axis = random_vector(random).normalized();
    const Quaternion expected(Eigen::AngleAxisd(angle, axis));
    const Quaternion q = exp_rotation(angle * axis);
    EXPECT_NEAR(q.norm(), 1.0, 1e-15);
    EXPECT_LT((q.coeffs() - expected.coeffs()).norm(), 1e-13) << angle;
  }
}

TEST(Spatial, ExponentialIsExactAtZeroAndSurvivesExtremes) {
  EXPECT_EQ(exp_rotation(Vector3::Zero()).coeffs(), Quaternion::Identity().coeffs());
  for (const double x : {std::numeric_limits<double>::denorm_min(), 1e-300, 1e-9, 1e9, 1e300}) {
    const Quaternion q = exp_rotation(Vector3(x, -x, x));
    EXPECT_TRUE(q.coeffs().allFinite()) << x;
    EXPECT_NEAR(q.norm(), 1.0, 1e-15) << x;
  }
}

TEST(Spatial, LogarithmInvertsExponentialFromZeroToPi) {
  Random random(2);
  for (const double angle : {0.0, 1e-300, 1e-150, 1e-15, 1e-9, 0.99e-10, 1.01e-10, 1e-5, 1e-4, 0.3, 1.5, 3.0,
                             kPi - 1e-3, kPi - 1e-6, kPi - 1e-9, kPi - 1e-12}) {
    for (int i = 0; i < 20; ++i) {
      const Vector3 v = angle * random_vector(random).normalized();
      EXPECT_LT((log_rotation(exp_rotation(v)) - v).norm(), 1e-15 + 4e-15 * angle) << angle;
    }
  }
}

TEST(Spatial, LogarithmKeepsSmallAnglesToFullPrecision) {
  const Vector3 v(1e-11, -2e-11, 3e-11);
  EXPECT_LT((log_rotation(exp_rotation(v)) - v).norm(), 1e-15 * v.norm());
}

TEST(Spatial, LogarithmTakesTheShorterWay) {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const Quaternion q(
        Eigen::Vector4d(random.normal(), random.normal(), random.normal(), random.normal()).normalized());
    const Vector3 v = log_rotation(q);
    EXPECT_LE(v.norm(), kPi + 1e-15);
    EXPECT_LT((v - log_rotation(Quaternion(-q.coeffs()))).norm(), 1e-14);
  }
  EXPECT_NEAR(log_rotation(Quaternion(0.0, 0.0, 1.0, 0.0)).norm(), kPi, 1e-15);
}

TEST(Spatial, CompositionAgreesWithHomogeneousMatrices) {
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    const Pose a = random_pose(random), b = random_pose(random);
    EXPECT_LT((homogeneous(a * b) - homogeneous(a) * homogeneous(b)).norm(), 1e-13);
    EXPECT_LT((homogeneous(inverse(a)) - homogeneous(a).inverse()).norm(), 1e-13);
    EXPECT_LT((homogeneous(a * inverse(a)) - Matrix4::Identity()).norm(), 1e-13);
  }
}

TEST(Spatial, CompositionStaysUnitOverManySteps) {
  Random random(5);
  const Pose step{{1e-3, 0.0, 0.0}, exp_rotation(1e-3 * random_vector(random))};
  Pose X;
  for (int i = 0; i < 100000; ++i) X = X * step;
  EXPECT_NEAR(X.q.norm(), 1.0, 1e-14);
}

TEST(Spatial, ClampKeepsDirectionAndNeverLengthens) {
  const Vector3 v(3.0, -4.0, 12.0);
  EXPECT_EQ(clamp_norm(v, 13.0), v);
  EXPECT_EQ(clamp_norm(v, 1e9), v);
  EXPECT_LT((clamp_norm(v, 1.3) - 0.1 * v).norm(), 1e-15);
  EXPECT_EQ(clamp_norm(v, 0.0), Vector3::Zero());
  EXPECT_EQ(clamp_norm(Vector3::Zero(), 0.0), Vector3::Zero());
  EXPECT_EQ(clamp_norm(Vector3::Zero(), 1.0), Vector3::Zero());
  EXPECT_NEAR(clamp_norm(Vector3(1e300, 1e300, 0.0), 1.0).norm(), 1.0, 1e-15);
  EXPECT_NEAR(clamp_norm(Vector3(1e-300, 0.0, 0.0), 1e-301).x() / 1e-301, 1.0, 1e-14);
}

}  // namespace
}  // namespace longreach::spatial_test
