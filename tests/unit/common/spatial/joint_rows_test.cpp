// Rows of any chain of axes: they place the tool as the axes do.

#include "common/spatial/joint_rows.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "common/core/random.hpp"

namespace longreach::joint_rows_test {
namespace {

using Axes = std::array<JointAxis, 6>;
using Joints = std::array<double, 6>;

Pose about(const JointAxis& axis, double q) {
  if (axis.slides) return {q * axis.direction, Quaternion::Identity()};
  return Pose{axis.point_m, exp_rotation(q * axis.direction)} * Pose{-axis.point_m, Quaternion::Identity()};
}

/// Product of exponentials (Brockett 1984).
Pose by_axes(const Axes& axes, const Pose& X_WE, const Joints& q) {
  Pose X;
  for (std::size_t i = 0; i < axes.size(); ++i) X = X * about(axes[i], q[i]);
  return X * X_WE;
}

Pose by_rows(const Axes& axes, const JointRows& rows, const Joints& q) {
  Pose X = rows.base;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const JointRow& row = rows.row[i];
    const double turn = axes[i].slides ? 0.0 : q[i], along = axes[i].slides ? q[i] : 0.0;
    X = X * Pose{Vector3::Zero(), exp_rotation({0, 0, turn + row.theta_rad})} *
        Pose{{row.a_m, 0, row.d_m + along}, Quaternion(rotation_behind(row))};
  }
  return X * rows.tool;
}

double apart(const Pose& a, const Pose& b) {
  return std::max((a.p - b.p).norm(), (a.q.toRotationMatrix() - b.q.toRotationMatrix()).norm());
}

Vector3 draw(Random& random, double most) {
  return {most * (2.0 * random.uniform() - 1.0), most * (2.0 * random.uniform() - 1.0),
          most * (2.0 * random.uniform() - 1.0)};
}

/// `aside`: by how much each axis is off the direction of the one before; 0: exactly parallel.
Axes axes(Random& random, double aside, bool slides) {
  Axes all;
  Vector3 direction = draw(random, 1.0).normalized();
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i] = {draw(random, 1.0), direction, slides && random.uniform() < 0.3};
    const Vector3 next = i == 2 ? draw(random, 1.0) : Vector3(direction + aside * draw(random, 1.0));
    direction = (random.uniform() < 0.5 ? 1.0 : -1.0) * next.normalized();
  }
  return all;
}

TEST(JointRows, PlaceTheToolAsTheAxesDo) {
  Random random(7);
  for (const double aside : {3.0, 0.3, 1e-2, 8e-4, 1e-6, 1e-9, 1e-13, 0.0}) {
    for (int arm = 0; arm < 200; ++arm) {
      const Axes chain = axes(random, aside, arm % 2 == 0);
      const Pose tool{draw(random, 1.0), exp_rotation(draw(random, 1.7))};
      const JointRows rows = joint_rows(chain, tool);
      ASSERT_EQ(rows.row.size(), 6u);
      for (const JointRow& row : rows.row) {
        EXPECT_LE(std::abs(row.beta_rad), 0.11);
        EXPECT_LE(std::hypot(row.a_m, row.d_m), 60.0) << "no length is much greater than the arm";
      }
      for (int n = 0; n < 20; ++n) {
        Joints q;
        for (double& x : q) x = 4.0 * random.uniform() - 2.0;
        ASSERT_LT(apart(by_rows(chain, rows, q), by_axes(chain, tool, q)), 2e-13) << aside << ' ' << arm;
      }
    }
  }
}

// A table that is written as people write it is found again.
TEST(JointRows, OfAnUprightArmAreThoseOfItsMaker) {
  const Axes ur{{{{0, 0, 0}, {0, 0, 1}, false},
                 {{0, 0, 0.1}, {0, 1, 0}, false},
                 {{0, 0, 0.7}, {0, 1, 0}, false},
                 {{0, 0, 1.2}, {0, 1, 0}, false},
                 {{0, 0.16, 1.2}, {0, 0, 1}, false},
                 {{0, 0.16, 1.3}, {0, 1, 0}, false}}};
  const JointRows rows =
      joint_rows(ur, {{0, 0.25, 1.3}, Quaternion::FromTwoVectors(Vector3::UnitZ(), Vector3::UnitY())});
  EXPECT_EQ(rows.base.p, Vector3::Zero());
  EXPECT_EQ(rows.row[0].d_m, 0.1);
  EXPECT_NEAR(rows.row[1].a_m, 0.6, 1e-15);
  EXPECT_NEAR(rows.row[2].a_m, 0.5, 1e-15);
  EXPECT_EQ(rows.row[1].alpha_rad, 0.0);
  EXPECT_EQ(rows.row[2].alpha_rad, 0.0);
  EXPECT_NEAR(rows.row[3].d_m, 0.16, 1e-15);
  EXPECT_NEAR(rows.row[4].d_m, 0.1, 1e-15);
  EXPECT_NEAR(rows.row[5].d_m, 0.09, 1e-15);
  EXPECT_EQ(rows.tool.p, Vector3::Zero()) << "the tool is on the last axis";
  for (const JointRow& row : rows.row) EXPECT_EQ(row.beta_rad, 0.0);
}

}  // namespace
}  // namespace longreach::joint_rows_test
