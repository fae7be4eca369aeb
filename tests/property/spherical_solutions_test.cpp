// All orientations of given motor angles, against a multi-start Newton iteration and the Agile Eye's closed
// form.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <vector>

#include "common/core/random.hpp"
#include "deploy/lab/campaign_size.hpp"
#include "deploy/lab/devices/spherical_catalog.hpp"
#include "master/devices/spherical/spherical_kinematics.hpp"
#include "master/devices/spherical/spherical_statics.hpp"

namespace longreach::spherical_solutions_test {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

double angle_between(const Quaternion& a, const Quaternion& b) {
  return 2.0 * std::asin(std::min(1.0, (a * b.conjugate()).vec().norm()));
}

Vector3 residual(const SphericalGeometry& g, const std::array<Vector3, 3>& w, const Quaternion& q) {
  Vector3 r;
  for (int i = 0; i < 3; ++i) r[i] = w[static_cast<std::size_t>(i)].dot(q * g.leg(i).v) - g.cos_alpha2();
  return r;
}

Quaternion any_rotation(Random& random) {
  return Quaternion(random.normal(), random.normal(), random.normal(), random.normal()).normalized();
}

/// Solutions seen by Newton's method from random orientations, until each was met several times over.
struct MultiStart {
  std::vector<Quaternion> found;
  std::vector<int> hits;

  void start(const SphericalGeometry& g, const std::array<Vector3, 3>& w, Quaternion q) {
    for (int round = 0; round < 30; ++round) {
      Matrix3 J;
      for (int i = 0; i < 3; ++i) J.row(i) = (q * g.leg(i).v).cross(w[static_cast<std::size_t>(i)]);
      const Vector3 step = -J.inverse() * residual(g, w, q);
      if (!step.allFinite()) return;
      q = (exp_rotation(clamp_norm(step, 0.7)) * q).normalized();
      if (step.norm() > 1e-9) continue;
      for (std::size_t n = 0; n < found.size(); ++n) {
        if (angle_between(found[n], q) < 1e-5) {
          ++hits[n];
          return;
        }
      }
      found.push_back(q);
      hits.push_back(1);
      return;
    }
  }

  [[nodiscard]] int least_hits() const {
    int least = 1000;
    for (const int h : hits) least = std::min(least, h);
    return least;
  }
};

/// `wanted`: where fewer were found, the search goes on, since some are met only rarely.
MultiStart multi_start(const SphericalGeometry& g, const std::array<Vector3, 3>& w, int wanted,
                       Random& random) {
  MultiStart search;
  for (int n = 0; n < 20'000 && (n < 60 || search.least_hits() < 6); ++n)
    search.start(g, w, any_rotation(random));
  for (int n = 0; n < 20'000 && static_cast<int>(search.found.size()) < wanted; ++n)
    search.start(g, w, any_rotation(random));
  return search;
}

std::array<Vector3, 3> middle_axes(const SphericalGeometry& g, const Vector3& theta) {
  std::array<Vector3, 3> w;
  for (int i = 0; i < 3; ++i)
    w[static_cast<std::size_t>(i)] = g.middle_axis(i, std::cos(theta[i]), std::sin(theta[i]));
  return w;
}

double distance(const SphericalGeometry& g, const Vector3& theta, const Quaternion& q) {
  return singularity(g, velocity(g, theta, q)).platform;
}

std::vector<SphericalGeometry> geometries() {
  SphericalAxes skew{70.0 * kDegree, 100.0 * kDegree, {}, {}, {}};
  skew.u << 1.0, 0.2, -0.1, -0.3, 1.0, 0.1, 0.1, 0.4, -1.0;
  skew.v << 0.9, 0.1, 0.3, -0.5, 1.0, 0.0, 0.2, -0.8, 1.0;
  for (int i = 0; i < 3; ++i) {
    skew.u.row(i).normalize();
    skew.v.row(i).normalize();
    const Vector3 u = skew.u.row(i);
    skew.w0.row(i) = std::cos(skew.alpha1) * u + std::sin(skew.alpha1) * u.unitOrthogonal();
  }
  return {agile_eye(), compact_spherical(), SphericalGeometry(skew),
          SphericalGeometry(SphericalAngles{45.0 * kDegree, 90.0 * kDegree, 0.0, 90.0 * kDegree})};
}

TEST(Spherical, HasTheOrientationsThatManyNewtonStartsFind) {
  const int share = campaign(10'000, 400) / 4;
  const std::vector<SphericalGeometry> all = geometries();
  int near_singular = 0;
  std::array<int, 9> counts{};
  for (std::size_t n = 0; n < all.size(); ++n) {
    const SphericalKinematics k(all[n]);
    Random random = Random(11).child("multi-start " + std::to_string(n));
    for (int sample = 0; sample < share; ++sample) {
      const Vector3 theta =
          std::numbers::pi * Vector3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      const std::array<Vector3, 3> w = middle_axes(all[n], theta);
      const SphericalPoses ours = k.forward_all(theta);
      const MultiStart theirs = multi_start(all[n], w, ours.count, random);
      ++counts[static_cast<std::size_t>(ours.count)];
      for (int i = 0; i < ours.count; ++i)
        ASSERT_LE(residual(all[n], w, ours.q[static_cast<std::size_t>(i)]).norm(), 1e-12)
            << theta.transpose();
      for (const Quaternion& q : theirs.found) {
        double nearest = 10.0;
        for (int i = 0; i < ours.count; ++i)
          nearest = std::min(nearest, angle_between(ours.q[static_cast<std::size_t>(i)], q));
        const double d = distance(all[n], theta, q);
        if (d < 1e-5) {
          ++near_singular;
          continue;
        }
        ASSERT_LE(nearest * d, 1e-12)
            << "geometry " << n << " theta " << theta.transpose() << " distance " << d;
      }
      ASSERT_EQ(ours.count, static_cast<int>(theirs.found.size()))
          << "geometry " << n << " theta " << theta.transpose();
    }
  }
  std::printf("orientations: ");
  for (std::size_t c = 0; c < counts.size(); ++c) std::printf("%zu: %d times  ", c, counts[c]);
  std::printf("\nvalues left out as singular: %d\n", near_singular);
}

// Agile Eye with w1 = (0, -s1, c1) and so on: v_i = (t_i, c, s) up to length and sign, where orthogonality is
// linear in the t_i (after Bonev, Chablat, Wenger, arXiv 0708.3936); and the four with v_i = +-u_i.
std::vector<Quaternion> agile_eye_closed_form(const Vector3& theta) {
  const Vector3 s = theta.array().sin(), c = theta.array().cos();
  Matrix3 A;
  A << s[1], c[0], 0.0, 0.0, s[2], c[1], c[2], 0.0, s[0];
  const Vector3 t = A.fullPivLu().solve(Vector3(-s[0] * c[1], -s[1] * c[2], -c[0] * s[2]));
  const std::array<Matrix3, 2> families{
      Matrix3::Identity(), (Matrix3() << Vector3(t[0], c[0], s[0]).normalized(),
                            Vector3(s[1], t[1], c[1]).normalized(), Vector3(c[2], s[2], t[2]).normalized())
                               .finished()};
  std::vector<Quaternion> all;
  for (const Matrix3& family : families) {
    for (unsigned signs = 0; signs < 8; ++signs) {
      const Vector3 sign((signs & 1U) != 0 ? -1.0 : 1.0, (signs & 2U) != 0 ? -1.0 : 1.0,
                         (signs & 4U) != 0 ? -1.0 : 1.0);
      const Matrix3 R = family * sign.asDiagonal();
      if (R.determinant() > 0.0) all.emplace_back(R);
    }
  }
  return all;
}

TEST(Spherical, HasTheEightOrientationsOfTheAgileEye) {
  const int wanted = campaign(100'000, 2'000);
  const SphericalGeometry g = agile_eye();
  const SphericalKinematics k(g);
  Random random = Random(11).child("agile eye");
  int compared = 0;
  double worst = 0.0;
  while (compared < wanted) {
    const Vector3 theta =
        std::numbers::pi * Vector3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    const std::vector<Quaternion> expected = agile_eye_closed_form(theta);
    ASSERT_EQ(expected.size(), 8U);
    double least = 1.0;
    for (const Quaternion& q : expected) least = std::min(least, distance(g, theta, q));
    if (least < 1e-4) continue;
    ++compared;
    const SphericalPoses ours = k.forward_all(theta);
    ASSERT_EQ(ours.count, 8) << theta.transpose() << " distance " << least;
    for (const Quaternion& q : expected) {
      double nearest = 10.0;
      for (const Quaternion& other : ours.q) nearest = std::min(nearest, angle_between(other, q));
      worst = std::max(worst, nearest * least);
      ASSERT_LE(nearest * least, 1e-13) << theta.transpose();
    }
  }
  std::printf("error times the condition: %.2g rad\n", worst);
}

}  // namespace
}  // namespace longreach::spherical_solutions_test
