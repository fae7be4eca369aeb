// A mass between several contacts at once, pushed by a force: what it has more than before came from the
// force.

#include <gtest/gtest.h>

#include "common/core/random.hpp"
#include "deploy/lab/campaign_size.hpp"
#include "slave/simulation/scene/yielding.hpp"

namespace longreach::several_contacts_test {
namespace {

Vector3 normal3(Random& random) { return {random.normal(), random.normal(), random.normal()}; }

// A room of two to six walls about the origin, some of them balls and boxes, each of its own material.
struct Room {
  SceneConfig config;
  std::vector<HuntCrossley> laws;

  Room(Random& random, double stiffness) {
    const int walls = 2 + static_cast<int>(5.0 * random.uniform());
    config.tool_radius_m = random.uniform() < 0.5 ? 0.0 : 0.02;
    for (int i = 0; i < walls; ++i) {
      const std::string name = std::to_string(i);
      const double n = random.uniform() < 0.3 ? 1.0 : random.uniform(1.0, 3.0);
      const double a = random.uniform() < 0.3 ? 0.0 : random.uniform(0.0, 3.0);
      config.material.push_back({name, stiffness * std::pow(10.0, random.uniform(-1.0, 1.0)), 0.01, n, a});
      SurfaceConfig s{.name = name, .material = name};
      const Vector3 out = normal3(random).normalized();
      const double gap = config.tool_radius_m + 0.05 * random.uniform();
      if (i % 3 == 0) s.plane = PlaneConfig{-gap * out, out, false};
      if (i % 3 == 1) s.sphere = SphereConfig{-(gap + 0.2) * out, 0.2, false};
      if (i % 3 == 2) s.box = BoxConfig{-(gap + 0.3) * out, Vector3::Constant(0.5), normal3(random), false};
      config.surface.push_back(s);
    }
  }
};

// Elastic energy by the integral of the force along a straight line from where there is none would cost too
// much: the depths give it, one surface at a time.
double elastic_j(const Room& room, const Vector3& p) {
  double sum = 0.0;
  for (std::size_t i = 0; i < room.config.surface.size(); ++i) {
    SceneConfig alone = room.config;
    alone.surface = {room.config.surface[i]};
    const double depth = Scene(alone, Pose{}).contact({p, Vector3::Zero()}).depth_m;
    const MaterialConfig& m = room.config.material[i];
    sum += m.stiffness_n_per_m * 1e-4 * std::pow(depth / 0.01, m.exponent + 1.0) / (m.exponent + 1.0);
  }
  return sum;
}

TEST(SeveralContacts, EnergyComesFromTheForceOnly) {
  double rise_max = 0.0;
  long steps = 0, several = 0, open = 0;
  for (int seed = 0; seed < campaign(1000, 60); ++seed) {
    Random random(seed);
    const double mass = std::pow(10.0, random.uniform(-1.0, 2.0)),
                 dt = std::pow(10.0, random.uniform(-4.0, -2.0));
    const double kappa = std::pow(10.0, random.uniform(-4.0, 6.0));
    const Room room(random, kappa * mass / (dt * dt));
    const Scene scene(room.config, Pose{});
    const Vector3 push = mass * 0.5 / dt * 0.05 * normal3(random);
    Compliance compliance = Compliance::Zero();
    compliance.bottomRightCorner<3, 3>().diagonal().setConstant(dt * dt / (2.0 * mass));
    Vector3 p = Vector3::Zero(), v = 0.5 * normal3(random);
    double energy = 0.5 * mass * v.squaredNorm() + elastic_j(room, p);
    for (int n = 0; n < 150; ++n) {
      const ToolMotion from{.p_WE = p}, free{.p_WE = p + v * dt + push * dt * dt / (2.0 * mass)};
      const Yielded step = yield(scene, from, free, compliance, dt);
      const Vector3 before = p;
      p = step.to.p_WE;
      v += (push + step.wrench.tail<3>()) * dt / mass;
      const double after = 0.5 * mass * v.squaredNorm() + elastic_j(room, p);
      const double work = push.dot(p - before), scale = energy + after + std::abs(work);
      ASSERT_LE(after - energy - work, 1e-9 * scale)
          << "seed " << seed << " step " << n << " kappa " << kappa;
      rise_max = std::max(rise_max, (after - energy - work) / scale);
      open += step.converged ? 0 : 1;
      ASSERT_TRUE(p.allFinite() && v.allFinite());
      energy = after;
      ++steps;
      several += scene.contact({.p_WE = p}).contacts > 1 ? 1 : 0;
    }
  }
  EXPECT_GT(several, steps / 20);
  EXPECT_LE(open, steps / 100);
  std::printf("%ld steps, %ld in several contacts: generated energy at most %.2g; not converged: %ld\n",
              steps, several, rise_max, open);
}

}  // namespace
}  // namespace longreach::several_contacts_test
