// Known answers: an independent Python transcription of SplitMix64 and xoshiro256++ that reproduces the
// published vectors (SplitMix64 of 1234567: 6457827717110365317; xoshiro256++ of {1, 2, 3, 4}: 41943041,
// 58720359).

#include "common/core/random.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace longreach::random_test {
namespace {

constexpr int kDraws = 200000;

struct Moments {
  double mean = 0.0, variance = 0.0, skew = 0.0, kurtosis = 0.0;
};

template <class Draw>
Moments moments(Draw draw) {
  double s1 = 0.0, s2 = 0.0, s3 = 0.0, s4 = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = draw();
    s1 += x;
    s2 += x * x;
    s3 += x * x * x;
    s4 += x * x * x * x;
  }
  return {s1 / kDraws, s2 / kDraws - (s1 / kDraws) * (s1 / kDraws), s3 / kDraws, s4 / kDraws};
}

TEST(Random, DrawsTheSameNumbersForEver) {
  Random random(42);
  EXPECT_EQ(random.next(), 15021278609987233951ULL);
  EXPECT_EQ(random.next(), 5881210131331364753ULL);
  EXPECT_EQ(random.next(), 18149643915985481100ULL);
  EXPECT_EQ(random.next(), 12933668939759105464ULL);
  EXPECT_EQ(Random(0).next(), 5987356902031041503ULL);
  EXPECT_EQ(Random(std::numeric_limits<std::uint64_t>::max()).next(), 6254647548650071986ULL);
}

TEST(Random, DrawsTheSameNormalDeviatesForEver) {
  Random random(42);
  EXPECT_DOUBLE_EQ(random.normal(), 0.9813983900724986);
  EXPECT_DOUBLE_EQ(random.normal(), -0.565720104673956);
}

TEST(Random, NamesAChildByTheWholePath) {
  EXPECT_EQ(Random(42).child("link").next(), 2651026622657967148ULL);
  EXPECT_EQ(Random(42).child("link").child("loss").next(), 13616607737010778929ULL);
}

TEST(Random, ChildDoesNotDependOnWhatItsParentDrew) {
  Random parent(7);
  Random early = parent.child("a");
  for (int i = 0; i < 100; ++i) parent.normal();
  Random late = parent.child("a");
  for (int i = 0; i < 100; ++i) ASSERT_EQ(early.next(), late.next());
}

TEST(Random, MakingAChildDoesNotAdvanceTheParent) {
  Random plain(7), parent(7);
  (void)parent.child("a").next();
  EXPECT_EQ(plain.next(), parent.next());
}

TEST(Random, ChildrenAreNotCorrelated) {
  Random a = Random(7).child("a"), b = Random(7).child("b");
  double product = 0.0;
  for (int i = 0; i < kDraws; ++i) product += a.normal() * b.normal();
  EXPECT_NEAR(product / kDraws, 0.0, 5.0 / std::sqrt(kDraws));
}

TEST(Random, UniformHasTheMomentsOfTheUniformDistribution) {
  Random random(1);
  double low = 1.0, high = 0.0;
  const Moments m = moments([&] {
    const double x = random.uniform();
    low = std::min(low, x);
    high = std::max(high, x);
    return x;
  });
  EXPECT_NEAR(m.mean, 0.5, 5.0 * std::sqrt(1.0 / 12.0 / kDraws));
  EXPECT_NEAR(m.variance, 1.0 / 12.0, 1e-3);
  EXPECT_GE(low, 0.0);
  EXPECT_LT(high, 1.0);
}

TEST(Random, UniformCoversItsBinsEvenly) {
  Random random(3);
  std::array<int, 50> bins{};
  for (int i = 0; i < kDraws; ++i) ++bins[static_cast<std::size_t>(random.uniform() * 50.0)];
  double chi_squared = 0.0;
  for (const int n : bins) chi_squared += std::pow(n - kDraws / 50.0, 2) / (kDraws / 50.0);
  EXPECT_LT(chi_squared, 99.0);  // 49 degrees of freedom: exceeded with a probability of 3e-5
}

TEST(Random, UniformKeepsToItsRange) {
  Random random(4);
  for (int i = 0; i < 1000; ++i) {
    const double x = random.uniform(-3.0, 5.0);
    ASSERT_GE(x, -3.0);
    ASSERT_LT(x, 5.0);
  }
}

TEST(Random, NormalHasTheMomentsOfTheNormalDistribution) {
  Random random(2);
  const Moments m = moments([&] { return random.normal(); });
  EXPECT_NEAR(m.mean, 0.0, 5.0 / std::sqrt(kDraws));
  EXPECT_NEAR(m.variance, 1.0, 5.0 * std::sqrt(2.0 / kDraws));
  EXPECT_NEAR(m.skew, 0.0, 5.0 * std::sqrt(15.0 / kDraws));
  EXPECT_NEAR(m.kurtosis, 3.0, 5.0 * std::sqrt(96.0 / kDraws));
}

TEST(Random, ChanceHitsWithItsProbabilityAndIsCertainAtTheEnds) {
  Random random(5);
  int hits = 0;
  for (int i = 0; i < kDraws; ++i) hits += random.chance(0.03) ? 1 : 0;
  EXPECT_NEAR(hits, 0.03 * kDraws, 5.0 * std::sqrt(0.03 * 0.97 * kDraws));
  for (int i = 0; i < 1000; ++i) {
    ASSERT_FALSE(random.chance(0.0));
    ASSERT_TRUE(random.chance(1.0));
    ASSERT_FALSE(random.chance(std::nan("")));
  }
}

}  // namespace
}  // namespace longreach::random_test
