#include "master/devices/spherical/spherical_geometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "deploy/lab/devices/spherical_catalog.hpp"
#include "master/devices/spherical/spherical_kinematics.hpp"
#include "master/devices/spherical/spherical_statics.hpp"

namespace longreach::spherical_geometry_test {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kRight = std::numbers::pi / 2.0;

template <class Shape>
std::string refusal(const Shape& shape) {
  try {
    const SphericalGeometry geometry(shape);
  } catch (const GeometryError& e) {
    return e.what();
  }
  return "";
}

bool names(const std::string& refusal, const std::string& word) {
  return refusal.find(word) != std::string::npos;
}

SphericalAxes agile_axes() {
  SphericalAxes axes{kRight, kRight, Matrix3::Identity(), Matrix3::Identity(), {}};
  axes.w0 << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  return axes;
}

TEST(SphericalGeometry, RefusesAnglesThatAreNone) {
  const SphericalAngles good{1.0, 1.2, 0.9, 1.1};
  EXPECT_EQ(refusal(good), "");
  const std::pair<const char*, double SphericalAngles::*> fields[] = {{"alpha1", &SphericalAngles::alpha1},
                                                                      {"alpha2", &SphericalAngles::alpha2},
                                                                      {"beta1", &SphericalAngles::beta1},
                                                                      {"beta2", &SphericalAngles::beta2}};
  for (const auto& [name, field] : fields) {
    for (const double bad : {-0.1, 3.2, kNaN, kInf}) {
      SphericalAngles a = good;
      a.*field = bad;
      EXPECT_TRUE(names(refusal(a), name)) << name << " " << bad << ": " << refusal(a);
    }
  }
  EXPECT_TRUE(names(refusal(SphericalAngles{0.0, 1.2, 0.9, 1.1}), "alpha1"));
  EXPECT_TRUE(names(refusal(SphericalAngles{1.0, std::numbers::pi, 0.9, 1.1}), "alpha2"));
}

TEST(SphericalGeometry, RefusesPlatformAxesInOneLine) {
  EXPECT_TRUE(names(refusal(SphericalAngles{1.0, 1.2, 0.9, 0.0}), "beta2"));
  EXPECT_EQ(refusal(SphericalAngles{1.0, 1.2, 0.0, 1.1}), "");  // coaxial motors are a known design
}

TEST(SphericalGeometry, RefusesALoopThatNoOrientationCloses) {
  EXPECT_TRUE(names(refusal(SphericalAngles{0.1, 0.1, 1.5, 0.1}), "impossible geometry"));
}

TEST(SphericalGeometry, RefusesAxesThatDoNotFit) {
  EXPECT_EQ(refusal(agile_axes()), "");
  SphericalAxes a = agile_axes();
  a.u(0, 0) = 1.1;
  EXPECT_TRUE(names(refusal(a), "u, row 1"));
  a = agile_axes(), a.v(1, 2) = kNaN;
  EXPECT_TRUE(names(refusal(a), "v, row 2"));
  a = agile_axes(), a.w0.row(2).setZero();
  EXPECT_TRUE(names(refusal(a), "w0, row 3"));
  a = agile_axes(), a.alpha1 = 1.0;
  EXPECT_TRUE(names(refusal(a), "alpha1"));
  a = agile_axes(), a.u.row(1) = a.u.row(0), a.v.row(1) = a.v.row(0), a.w0.row(1) = a.w0.row(0);
  EXPECT_TRUE(names(refusal(a), "legs 1 and 2 coincide")) << refusal(a);
}

// The axes of the published equations, written out.
TEST(SphericalGeometry, HasTheMiddleAxesOfThePublishedEquations) {
  const SphericalAngles k{0.8, 1.3, 0.7, 1.1};
  const SphericalGeometry g(k);
  for (int i = 0; i < 3; ++i) {
    for (const double theta : {-2.0, 0.0, 0.4, 3.0}) {
      const double eta = 2.0 * std::numbers::pi / 3.0 * i;
      const double se = std::sin(eta), ce = std::cos(eta), st = std::sin(theta), ct = std::cos(theta);
      const double s1 = std::sin(k.beta1), c1 = std::cos(k.beta1), sa = std::sin(k.alpha1),
                   ca = std::cos(k.alpha1);
      const Vector3 w(-se * s1 * ca + (ce * st - se * c1 * ct) * sa,
                      ce * s1 * ca + (se * st + ce * c1 * ct) * sa, -c1 * ca + s1 * ct * sa);
      EXPECT_LE((g.middle_axis(i, ct, st) - w).norm(), 1e-15);
    }
    EXPECT_NEAR(g.leg(i).v.z(), std::cos(k.beta2), 1e-15);
  }
}

// Anything at all may come in; only finite numbers go out.
TEST(SphericalKinematics, AnswersAnyInputWithFiniteNumbers) {
  const double values[] = {0.0, -0.0, 1e-9, 1e-310, 0.1, -3.0, 1e9, 1e300, kInf, -kInf, kNaN};
  const SphericalKinematics k(compact_spherical());
  for (const double x : values) {
    for (const double y : values) {
      for (const double z : values) {
        const Vector3 v(x, y, z);
        const Quaternion q(1.0, x, y, z);
        EXPECT_TRUE(k.inverse(q, 3).theta_rad.allFinite());
        EXPECT_TRUE(k.forward(v, {}).q.coeffs().allFinite());
        EXPECT_TRUE(k.forward(Vector3(0.1, 0.2, 0.3), {SolutionStatus::kFound, q}).q.coeffs().allFinite());
        const SphericalPoses all = k.forward_all(v);
        for (int n = 0; n < all.count; ++n)
          EXPECT_TRUE(all.q[static_cast<std::size_t>(n)].coeffs().allFinite());
        if (!v.allFinite()) {
          EXPECT_EQ(k.forward(v, {}).status, SolutionStatus::kNoSolution);
          EXPECT_EQ(all.status, SolutionStatus::kNoSolution);
        }
      }
    }
  }
}

// The Agile Eye at v = u in all legs: every middle axis is across its platform axis, whatever the angles are.
TEST(SphericalKinematics, SaysThatAFreelyTurningLegIsSingular) {
  const SphericalKinematics k(agile_eye());
  EXPECT_EQ(k.inverse(Quaternion::Identity()).status, SolutionStatus::kSingular);
  EXPECT_LT(
      singularity(k.geometry(), velocity(k.geometry(), Vector3(0.3, 0.5, 0.7), Quaternion::Identity())).legs,
      1e-12);
}

// sin s1 s2 s3 + c1 c2 c3 = 0 lets the platform of an Agile Eye turn with locked motors.
TEST(SphericalKinematics, SaysThatAPlatformThatNothingHoldsIsSingular) {
  const SphericalKinematics k(agile_eye());
  const Vector3 theta(std::numbers::pi / 2.0, 0.0, 0.7);
  EXPECT_EQ(k.forward_all(theta).status, SolutionStatus::kSingular);
  EXPECT_LT(singularity(k.geometry(), velocity(k.geometry(), theta, Quaternion::Identity())).platform, 1e-9);
  EXPECT_EQ(k.forward(theta, {SolutionStatus::kFound, Quaternion::Identity()}).status,
            SolutionStatus::kSingular);
}

}  // namespace
}  // namespace longreach::spherical_geometry_test
