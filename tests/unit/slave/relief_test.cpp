#include "slave/command/relief.hpp"

#include <gtest/gtest.h>

namespace longreach {
namespace {

TEST(Relief, WithoutAnswerItEndsAfterTwentyMillimetres) {
  Relief relief;
  EXPECT_TRUE(relief.may_go_on(30.0));
  double way_m = 0.0;
  while (relief.may_go_on(30.0) && way_m < 1.0) {
    relief.go(1e-4, 30.0);
    way_m += 1e-4;
  }
  EXPECT_NEAR(way_m, 0.02, 2.1e-4);
  EXPECT_FALSE(relief.may_go_on(30.0));
}

TEST(Relief, GoesAsFarAsTheForceAnswers) {
  for (const double stiffness : {50.0, 90.0, 110.0, 1000.0}) {
    Relief relief;
    double force_n = 30.0, way_m = 0.0;
    for (; relief.may_go_on(force_n) && force_n > 5.0; way_m += 1e-4) {
      relief.go(1e-4, force_n);
      force_n -= 1e-4 * stiffness;
    }
    EXPECT_EQ(force_n <= 5.0, stiffness > 100.0) << stiffness;
    EXPECT_LE(way_m, 0.02 + (30.0 - force_n) / 100.0 + 1e-9) << stiffness;
  }
}

TEST(Relief, TheLargestForceOnTheWayIsWhatItFallsFrom) {
  Relief relief;
  relief.go(0.01, 10.0);
  relief.go(0.01, 12.0);
  EXPECT_LT(relief.left_m(12.0), 1e-9);
  EXPECT_NEAR(relief.left_m(10.5), 0.01, 1e-12) << "1.5 N less but for the noise of 0.5 N";
  EXPECT_LT(relief.left_m(11.6), 1e-9) << "that is noise";
}

TEST(Relief, AWayBackInIsWayThatIsLeftAgainButNeverMoreThanAtFirst) {
  Relief relief;
  relief.go(0.015, 20.0);
  relief.go(-0.005, 20.0);
  EXPECT_NEAR(relief.left_m(20.0), 0.01, 1e-12);
  relief.go(-0.5, 20.0);
  EXPECT_NEAR(relief.left_m(20.0), 0.02, 1e-12);
  relief.go(0.02, 20.0);
  relief.reset();
  EXPECT_NEAR(relief.left_m(20.0), 0.02, 1e-12);
}

}  // namespace
}  // namespace longreach
