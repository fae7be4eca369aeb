// The force law against Simbody's Hunt-Crossley force: a sphere that is pressed into a half space, n = 1.5.
//   f = (4/3) √R E x^1.5 (1 + 1.5 c v);  two surfaces of one stiffness E0 make E = E0/2^1.5, of one
//   dissipation c.

#include <gtest/gtest.h>

#include <cmath>

#include "common/core/random.hpp"
#include "slave/simulation/scene/scene.hpp"
#include "tests/oracle/simbody/simbody_ball.hpp"

namespace longreach::simbody_contact_test {
namespace {

std::array<double, 3> numbers(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

TEST(SimbodyOracle, BallOnHalfSpaceHasTheSameForce) {
  double error_max = 0.0;
  int touching = 0, pulled = 0;
  for (int seed = 0; seed < 60; ++seed) {
    Random random(seed);
    const double radius = std::pow(10.0, random.uniform(-2.0, 0.0));
    const double modulus = std::pow(10.0, random.uniform(3.0, 10.0)), dissipation = random.uniform(0.0, 2.0);
    oracle::SimbodyBall theirs(radius, modulus, dissipation);

    SceneConfig config;
    const double k = 4.0 / 3.0 * std::sqrt(radius) * modulus / std::pow(2.0, 1.5);
    config.material = {{"m", k, 1.0, 1.5, 1.5 * dissipation}};
    config.tool_radius_m = radius;
    config.surface.push_back({.name = "floor", .material = "m"});
    config.surface[0].plane = PlaneConfig{Vector3::Zero(), Vector3::UnitZ(), false};
    const Scene ours(config, Pose{});

    for (int i = 0; i < 200; ++i) {
      // From where the rounding of positions of 1 m no longer counts.
      const double deep = std::pow(10.0, random.uniform(-5.0, std::log10(0.3 * radius)));
      const double depth = i % 10 == 0 ? -deep : deep;
      const Vector3 p(random.normal(), random.normal(), radius - depth);
      const Vector3 v(random.normal(), random.normal(), random.normal());
      const Vector3 expected(theirs.force_n(numbers(p), numbers(v)).data());
      const Vector3 force = ours.contact({p, v}).force_n;
      ASSERT_NEAR((force - expected).norm(), 0.0, 1e-10 * expected.norm()) << "seed " << seed << " " << i;
      if (expected.norm() > 0.0) error_max = std::max(error_max, (force - expected).norm() / expected.norm());
      touching += expected.norm() > 0.0 ? 1 : 0;
      pulled += depth > 0.0 && expected.norm() == 0.0 ? 1 : 0;
    }
  }
  EXPECT_GT(touching, 5000);
  EXPECT_GT(pulled, 100);  // where damping would pull neither does
  std::printf("against Simbody: %d forces, error at most %.2g of the force\n", touching, error_max);
}

}  // namespace
}  // namespace longreach::simbody_contact_test
