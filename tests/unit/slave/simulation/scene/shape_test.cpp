#include "slave/simulation/scene/shape.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/core/random.hpp"
#include "slave/simulation/scene/bounds_tree.hpp"

namespace longreach::shape_test {
namespace {

Vector3 normal3(Random& random) { return {random.normal(), random.normal(), random.normal()}; }

Shape random_shape(Random& random, int kind) {
  const Vector3 centre = normal3(random), axis = normal3(random).normalized();
  const double a = random.uniform(0.1, 2.0), b = random.uniform(0.1, 2.0), c = random.uniform(0.1, 2.0);
  if (kind == 0) return Ball{centre, a};
  if (kind == 1) return Block{centre, exp_rotation(normal3(random)).toRotationMatrix(), {a, b, c}};
  if (kind == 2) return Rod{centre, axis, a, b};
  return HalfSpace{centre, axis};
}

// The distance to the surface is where a sphere about the point first meets it: searched for in many
// directions, by whether points are inside, which each solid's definition says.
bool inside(const Shape& shape, const Vector3& p) {
  if (const auto* s = std::get_if<Ball>(&shape)) return (p - s->centre_m).norm() < s->radius_m;
  if (const auto* s = std::get_if<HalfSpace>(&shape)) return (p - s->point_m).dot(s->normal) < 0.0;
  if (const auto* s = std::get_if<Block>(&shape)) {
    const Vector3 q = s->R.transpose() * (p - s->centre_m);
    return std::abs(q.x()) < s->half_m.x() && std::abs(q.y()) < s->half_m.y() &&
           std::abs(q.z()) < s->half_m.z();
  }
  const auto& rod = std::get<Rod>(shape);
  const Vector3 q = p - rod.centre_m;
  return std::abs(q.dot(rod.axis)) < rod.half_m && q.cross(rod.axis).norm() < rod.radius_m;
}

TEST(Shape, DistanceIsThatOfTheNearestPointOfTheSurface) {
  for (int seed = 0; seed < 400; ++seed) {
    Random random(seed);
    const Shape shape = random_shape(random, seed % 4);
    const Vector3 p = 1.5 * normal3(random);
    const SurfaceSide s = side(shape, p);
    ASSERT_EQ(inside(shape, p), s.distance_m < 0.0) << seed;
    ASSERT_NEAR(s.normal.norm(), 1.0, 1e-12) << seed;
    // The point that it names is on the surface ...
    const Vector3 foot = p - s.distance_m * s.normal;
    EXPECT_TRUE(inside(shape, foot - 1e-6 * s.normal)) << seed;
    EXPECT_FALSE(inside(shape, foot + 1e-9 * s.normal)) << seed;
    // ... and none is nearer.
    for (int i = 0; i < 200; ++i) {
      const Vector3 near = p + (1.0 - 1e-9) * std::abs(s.distance_m) * normal3(random).normalized();
      ASSERT_EQ(inside(shape, near), inside(shape, p)) << seed;
    }
  }
}

TEST(Shape, BoundsHoldItTightly) {
  for (int seed = 0; seed < 60; ++seed) {
    Random random(seed);
    const Shape shape = random_shape(random, seed % 3);
    const Bounds b = bounds(shape);
    ASSERT_TRUE(b.finite());
    for (int axis = 0; axis < 3; ++axis) {
      // A half space beside the bounds does not reach the solid, one within does.
      double highest = -1e9;
      for (int i = 0; i < 20000; ++i) {
        Vector3 p;
        for (int k = 0; k < 3; ++k) p[k] = random.uniform(b.low[k], b.high[k]);
        if (inside(shape, p)) highest = std::max(highest, p[axis]);
        Vector3 beyond = p;
        beyond[axis] = b.high[axis] + 1e-9;
        ASSERT_FALSE(inside(shape, beyond)) << seed;
      }
      EXPECT_GT(highest, b.high[axis] - 0.35 * (b.high[axis] - b.low[axis])) << seed;
    }
  }
  EXPECT_FALSE(bounds(HalfSpace{}).finite());
}

TEST(Shape, HasAnAnswerInItsCentre) {
  EXPECT_EQ(side(Ball{}, Vector3::Zero()).distance_m, -1.0);
  EXPECT_EQ(side(Block{}, Vector3::Zero()).distance_m, -1.0);
  EXPECT_EQ(side(Rod{}, Vector3::Zero()).distance_m, -1.0);
  EXPECT_TRUE(side(Rod{}, Vector3::Zero()).normal.allFinite());
}

TEST(BoundsTree, FindsWhatALinearSearchFindsAndAsksFew) {
  Random random(3);
  std::vector<Bounds> all;
  for (int i = 0; i < 10000; ++i) {
    const Vector3 centre(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    all.push_back(bounds(Ball{centre, 0.02}));
  }
  const BoundsTree tree(all);
  long asked = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vector3 p(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    std::vector<std::uint32_t> expected, found;
    for (std::uint32_t k = 0; k < all.size(); ++k) {
      if (all[k].within(p, 0.01)) expected.push_back(k);
    }
    tree.find(p, 0.01, [&](std::uint32_t k) {
      ++asked;
      if (all[k].within(p, 0.01)) found.push_back(k);
    });
    std::sort(found.begin(), found.end());
    ASSERT_EQ(found, expected);
  }
  EXPECT_LT(asked / 1000, 40);
}

TEST(BoundsTree, FindsNothingInNothingAndNowhere) {
  const Vector3 nowhere = Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
  const auto never = [](std::uint32_t) { ADD_FAILURE(); };
  BoundsTree().find(Vector3::Zero(), 1.0, never);
  const std::vector<Bounds> one{bounds(Ball{})};
  BoundsTree(one).find(nowhere, 1.0, never);
}

}  // namespace
}  // namespace longreach::shape_test
