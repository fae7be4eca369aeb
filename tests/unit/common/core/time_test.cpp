#include "common/core/time.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <type_traits>

namespace longreach::time_test {
namespace {

template <class A, class B>
concept Subtractable = requires(A a, B b) {
  a - b;
};

static_assert(!Subtractable<Time, PeerTime>, "instants of the two sides must not be compared");
static_assert(Subtractable<Time, Time>);
static_assert(!std::is_convertible_v<PeerTime, Time>);

TEST(Time, RoundsToTheNearestNanosecond) {
  EXPECT_EQ(from_seconds(0.0).count(), 0);
  EXPECT_EQ(from_seconds(1.0).count(), 1000000000);
  EXPECT_EQ(from_seconds(0.1).count(), 100000000);
  EXPECT_EQ(from_seconds(1.4e-9).count(), 1);
  EXPECT_EQ(from_seconds(1.6e-9).count(), 2);
  EXPECT_EQ(from_seconds(-1.6e-9).count(), -2);
  EXPECT_EQ(from_seconds(4e-10).count(), 0);
  EXPECT_EQ(from_seconds(std::numeric_limits<double>::denorm_min()).count(), 0);
}

TEST(Time, SurvivesSecondsThatAreNoTime) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(from_seconds(std::numeric_limits<double>::quiet_NaN()).count(), 0);
  EXPECT_EQ(from_seconds(kInfinity).count(), 4600000000000000000);
  EXPECT_EQ(from_seconds(-kInfinity).count(), -4600000000000000000);
  EXPECT_EQ(from_seconds(1e300), from_seconds(kInfinity));
  EXPECT_EQ(from_seconds(-1e300), from_seconds(-kInfinity));
}

TEST(Time, GoesToSecondsAndBack) {
  for (const std::int64_t ns : {0LL, 1LL, -1LL, 999999999LL, 123456789012345LL, -86400000000000LL}) {
    EXPECT_EQ(from_seconds(to_seconds(Duration{ns})).count(), ns);
  }
}

}  // namespace
}  // namespace longreach::time_test
