#include "slave/sensing/free_moment.hpp"

#include <gtest/gtest.h>

#include "common/core/random.hpp"

namespace longreach::free_moment_test {
namespace {

Vector3 vector(Random& random, double most) {
  return {random.uniform(-most, most), random.uniform(-most, most), random.uniform(-most, most)};
}

TEST(FreeMoment, AForceAtALeverLeavesNone) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vector3 force_n = 0.5 * Vector3::UnitX() + vector(random, 20.0), lever_m = vector(random, 0.17);
    const Wrench wrench{lever_m.cross(force_n), force_n};
    if (force_n.norm() <= kForceSeen_n) continue;
    EXPECT_LT(free_moment_nm(wrench).norm(), 1e-12);
  }
}

TEST(FreeMoment, AboutTheForceItIsAllFree) {
  const Wrench wrench{{0.0, 0.0, 2.0}, {0.0, 0.0, 20.0}};
  EXPECT_EQ(free_moment_nm(wrench), wrench.moment);
}

TEST(FreeMoment, WhatNoLeverIsLongEnoughForIsFree) {
  const Vector3 free_nm = free_moment_nm({{8.0, 0.0, 0.0}, {0.0, 0.0, 10.0}});
  EXPECT_NEAR(free_nm.x(), 8.0 - 10.0 * kToolLever_m, 1e-12);
  EXPECT_NEAR(free_nm.tail<2>().norm(), 0.0, 1e-12);
}

TEST(FreeMoment, AForceThatMayBeNoiseExplainsNothing) {
  const Wrench wrench{{0.04, 0.0, 0.0}, {0.0, 0.0, 0.15}};
  EXPECT_EQ(free_moment_nm(wrench), wrench.moment);
}

}  // namespace
}  // namespace longreach::free_moment_test
