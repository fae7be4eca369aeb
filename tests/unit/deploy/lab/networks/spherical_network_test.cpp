#include "deploy/lab/networks/spherical_network.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "common/core/geometry_error.hpp"
#include "common/core/random.hpp"
#include "deploy/lab/devices/spherical_catalog.hpp"
#include "master/devices/spherical/spherical_kinematics.hpp"
#include "master/devices/spherical/spherical_statics.hpp"

namespace longreach::spherical_network_test {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// g = offset + M (θ - home), by three units that are used where they are straight.
SphericalPerceptron straight(const Matrix3& M, const Vector3& home, const Vector3& offset) {
  constexpr double kSmall = 1e-6;
  SphericalPerceptron net;
  for (std::size_t u = 0; u < 3; ++u) {
    const auto i = static_cast<Eigen::Index>(u);
    net.in[u][u] = kSmall;
    net.bias[u] = -kSmall * home[i];
    for (std::size_t row = 0; row < 3; ++row) net.out[row][u] = M(static_cast<Eigen::Index>(row), i) / kSmall;
    net.offset[u] = offset[i];
  }
  return net;
}

/// Networks that know the slope at home: right to first order, so their error is known. Cell i answers with
/// i * mark added to g.x, which tells who has answered.
SphericalNetworkConfig about_home(double mark = 0.0) {
  const SphericalKinematics k(reconstructed_spherical());
  SphericalNetworkConfig c;
  c.axes.alpha1 = c.axes.alpha2 = std::acos(0.0);
  for (int i = 0; i < 3; ++i) {
    c.axes.u.row(i) = k.geometry().leg(i).u;
    c.axes.v.row(i) = k.geometry().leg(i).v;
    c.axes.w0.row(i) = k.geometry().leg(i).w_axial + k.geometry().leg(i).w_cos;
  }
  c.workspace.home_rad = k.inverse(Quaternion::Identity()).theta_rad;
  c.workspace.common_rad = c.workspace.differential_rad = 0.3;
  const SphericalVelocity at = velocity(k.geometry(), c.workspace.home_rad, Quaternion::Identity());
  const Matrix3 slope = 0.5 * inverse_jacobian(at).matrix;
  c.cells = {3, Vector3::Constant(0.1), 0.2};
  c.rough = straight(slope, c.workspace.home_rad, Vector3::Zero());
  for (int i = 0; i < 27; ++i)
    c.fine.push_back(straight(slope, c.workspace.home_rad, Vector3(mark * i, 0.0, 0.0)));
  return c;
}

const SphericalKinematics& kinematics() {
  static const SphericalKinematics k(reconstructed_spherical());
  return k;
}
SphericalNetwork network(double mark = 0.0) { return {reconstructed_spherical(), about_home(mark)}; }
Vector3 motors(const Vector3& turn_rad) { return kinematics().inverse(exp_rotation(turn_rad)).theta_rad; }
double angle(const Quaternion& a, const Quaternion& b) { return 2.0 * (a.conjugate() * b).vec().norm(); }

std::string refusal(const SphericalGeometry& geometry, const SphericalNetworkConfig& config) {
  try {
    const SphericalNetwork net(geometry, config);
  } catch (const GeometryError& e) {
    return e.what();
  }
  return "";
}

// The sum as the header has it, unit after unit.
TEST(SphericalNetwork, ComputesItsFormula) {
  Random random(3);
  SphericalNetworkConfig c = about_home();
  c.cells.width.setConstant(10.0);
  for (int trial = 0; trial < 100; ++trial) {
    SphericalPerceptron& net = c.fine[13];
    for (std::size_t u = 0; u < SphericalPerceptron::kUnits; ++u) {
      net.bias[u] = random.normal();
      for (std::size_t i = 0; i < 3; ++i)
        net.in[i][u] = random.normal(), net.out[i][u] = 0.1 * random.normal();
    }
    const Vector3 theta =
        c.workspace.home_rad + 0.1 * Vector3(random.uniform(), random.uniform(), random.uniform());
    Vector3 g(net.offset[0], net.offset[1], net.offset[2]);
    for (std::size_t u = 0; u < SphericalPerceptron::kUnits; ++u) {
      double z = net.bias[u];
      for (std::size_t i = 0; i < 3; ++i) z += net.in[i][u] * theta[static_cast<Eigen::Index>(i)];
      const double s = z * (27.0 + z * z) / (27.0 + 9.0 * z * z);
      for (std::size_t i = 0; i < 3; ++i) g[static_cast<Eigen::Index>(i)] += net.out[i][u] * s;
    }
    const SphericalEstimate estimate = SphericalNetwork(reconstructed_spherical(), c).forward(theta);
    ASSERT_EQ(estimate.status, SolutionStatus::kFound);
    EXPECT_LE((estimate.q.vec() / estimate.q.w() - g).norm(), 1e-13);
  }
}

TEST(SphericalNetwork, RefusesAnotherGeometryByTheAxisThatDiffers) {
  EXPECT_EQ(refusal(reconstructed_spherical(), about_home()), "");
  EXPECT_NE(refusal(agile_eye(), about_home()).find("the base axis of leg 1 differs"), std::string::npos);
  EXPECT_NE(refusal(compact_spherical(), about_home()).find("alpha2 differs"), std::string::npos);
}

TEST(SphericalNetwork, RefusesWhatIsNoNetwork) {
  const auto refused = [](auto change) {
    SphericalNetworkConfig c = about_home();
    change(c);
    return refusal(reconstructed_spherical(), c) != "";
  };
  EXPECT_TRUE(refused([](auto& c) { c.fine.pop_back(); }));
  EXPECT_TRUE(refused([](auto& c) { c.cells.per_axis = 2; }));
  EXPECT_TRUE(refused([](auto& c) { c.cells.width.y() = 0.0; }));
  EXPECT_TRUE(refused([](auto& c) { c.cells.overlap = 0.6; }));
  EXPECT_TRUE(refused([](auto& c) { c.workspace.common_rad = kNaN; }));
  EXPECT_TRUE(refused([](auto& c) { c.workspace.q_home = Quaternion(2.0, 0.0, 0.0, 0.0); }));
  EXPECT_TRUE(refused([](auto& c) { c.fine[26].out[2][23] = kInf; }));
  EXPECT_TRUE(refused([](auto& c) { c.rough.in[0][0] = kNaN; }));
}

TEST(SphericalNetwork, GivesNoOrientationOutsideOfItsWorkspace) {
  const SphericalNetwork net = network();
  const Vector3 home = net.config().workspace.home_rad;
  const double values[] = {0.0, 1e-9, 1e-310, 0.31, -0.31, 6.283185307179586, 1e9, -1e300, kInf, -kInf, kNaN};
  int inside = 0;
  for (const double x : values) {
    for (const double y : values) {
      for (const double z : values) {
        const Vector3 theta = home + Vector3(x, y, z);
        // |mean| and the distance from it, written differently.
        const double mean = (x + y + z) / 3.0;
        const bool is_inside = std::abs(mean) <= 0.3 && std::hypot(x - mean, y - mean, z - mean) <= 0.3;
        inside += is_inside ? 1 : 0;
        for (const SphericalEstimate& e :
             {net.rough(theta), net.forward(theta), net.forward(theta, {SolutionStatus::kFound, {}, 13}),
              net.refined(theta, net.forward(theta))}) {
          EXPECT_TRUE(e.q.coeffs().allFinite());
          if (is_inside) continue;
          EXPECT_EQ(e.status, SolutionStatus::kNoSolution) << x << " " << y << " " << z;
          EXPECT_EQ(e.cell, -1);
        }
      }
    }
  }
  EXPECT_GE(inside, 27);
}

TEST(SphericalNetwork, TakesAnyPreviousCell) {
  const SphericalNetwork net = network();
  const Vector3 theta = motors(Vector3(0.05, 0.0, 0.0));
  for (const int cell : {-1, -2000000000, 27, 2000000000, 0}) {
    EXPECT_EQ(net.forward(theta, {SolutionStatus::kFound, Quaternion::Identity(), cell}).q.coeffs(),
              net.forward(theta).q.coeffs());
  }
}

// Cells are 0.1 wide about home: the border of the middle one is at g = 0.05, half of the overlap at 0.06.
TEST(SphericalNetwork, ChangesCellInOverlapWithHysteresis) {
  const SphericalNetwork net = network();
  SphericalEstimate estimate = net.forward(motors(Vector3::Zero()));
  double there = 0.0, back = 0.0;
  const auto tick = [&](double g) {
    const int before = estimate.cell;
    estimate = net.forward(motors(Vector3(2.0 * std::atan(g), 0.0, 0.0)), estimate);
    EXPECT_EQ(estimate.status, SolutionStatus::kFound);
    return estimate.cell != before;
  };
  for (double g = 0.0; g < 0.1; g += 1e-4) there = tick(g) ? g : there;
  EXPECT_EQ(estimate.cell, 22);
  for (double g = 0.1; g > 0.0; g -= 1e-4) back = tick(g) ? g : back;
  EXPECT_EQ(estimate.cell, 13);
  EXPECT_NEAR(there, 0.06, 0.005);
  EXPECT_NEAR(back, 0.04, 0.005);
}

// The mark in g.x is 1e-4 a cell: who has answered?
TEST(SphericalNetwork, AsksOnlyThePreviousCellInContinuousMotion) {
  const SphericalNetwork net = network(1e-4);
  const Vector3 theta = motors(Vector3(2.0 * std::atan(0.056), 0.0, 0.0));
  const SphericalEstimate fresh = net.forward(theta);
  const SphericalEstimate stays = net.forward(theta, {SolutionStatus::kFound, Quaternion::Identity(), 13});
  EXPECT_NEAR(2.0 * std::atan((fresh.q.x() - stays.q.x())), 2.0 * 9e-4, 1e-5);  // cell 22 against 13
  EXPECT_EQ(stays.cell, 13);
}

TEST(SphericalNetwork, FindsAJumpFromNothing) {
  const SphericalNetwork net = network();
  const Vector3 theta = motors(Vector3(0.2, -0.2, 0.0));
  const SphericalEstimate far = net.forward(theta, {SolutionStatus::kFound, Quaternion::Identity(), 0});
  EXPECT_EQ(far.status, SolutionStatus::kFound);
  EXPECT_EQ(far.q.coeffs(), net.forward(theta).q.coeffs());
}

TEST(SphericalNetwork, SaysSoWhenItsNetworksDoNotAgree) {
  SphericalNetworkConfig c = about_home();
  c.fine[13].offset[0] = 0.2;  // an answer far outside of its cell
  const SphericalNetwork net(reconstructed_spherical(), c);
  const SphericalEstimate e = net.forward(c.workspace.home_rad);
  EXPECT_EQ(e.status, SolutionStatus::kNotConverged);
  EXPECT_EQ(net.refined(c.workspace.home_rad, e).status, SolutionStatus::kNotConverged);
}

TEST(SphericalNetwork, SquaresTheErrorByOneNewtonStep) {
  const SphericalNetwork net = network();
  Random random(5);
  for (int n = 0; n < 1000; ++n) {
    const Vector3 turn = 0.2 * Vector3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    const Vector3 theta = motors(turn);
    const SphericalEstimate estimate = net.forward(theta);
    ASSERT_EQ(estimate.status, SolutionStatus::kFound);
    const double error = angle(exp_rotation(turn), estimate.q);
    const double refined = angle(exp_rotation(turn), net.refined(theta, estimate).q);
    EXPECT_LE(refined, 2.0 * error * error + 1e-15);
  }
}

TEST(SphericalNetwork, TakesNoStepFromTheOtherSideOfASingularity) {
  const SphericalNetwork net = network();
  const Vector3 theta = motors(Vector3(0.1, 0.0, 0.1));
  const SphericalPoses all = kinematics().forward_all(theta);
  int other = 0;
  for (int n = 0; n < all.count; ++n) {
    const Quaternion& q = all.q[static_cast<std::size_t>(n)];
    const SphericalVelocity at = velocity(kinematics().geometry(), theta, q);
    if (at.normals.determinant() *
            velocity(kinematics().geometry(), net.config().workspace.home_rad, Quaternion::Identity())
                .normals.determinant() >
        0.0)
      continue;
    ++other;
    EXPECT_EQ(net.refined(theta, {SolutionStatus::kFound, q, 0}).status, SolutionStatus::kSingular);
  }
  EXPECT_GT(other, 0);
}

}  // namespace
}  // namespace longreach::spherical_network_test
