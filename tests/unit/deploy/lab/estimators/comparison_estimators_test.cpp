// The estimators that the slave's own are compared with (deploy/lab/estimators): each has to be as
// good as it can be, or the comparison says nothing.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "deploy/lab/contact/contact_record.hpp"
#include "deploy/lab/estimators/methods.hpp"

namespace longreach::comparison_estimators_test {
namespace {

using test::ContactCell;
using test::Excitation;

constexpr double kDt = 1e-3;

ContactAnswer identified(Method method, const ContactCell& cell, const test::Samples& record) {
  Identifier identifier = by(method, {.exponent = cell.n});
  for (const PenetrationSample& sample : record) identifier.step(sample, kDt);
  return identifier.answer();
}

double tangent(double k, double n, double x) { return k * n * std::pow(x, n - 1.0); }

std::string words(const ContactCell& c) {
  return "k " + std::to_string(c.k) + " n " + std::to_string(c.n) + " a " + std::to_string(c.a);
}

class EachComparison : public ::testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(Kind, EachComparison, ::testing::ValuesIn(kAllMethods), [](const auto& kind) {
  std::string name(name_of(kind.param));
  std::erase(name, '-');
  return name;
});

/// Of the law that the estimator assumes. a v is at most 0.05, so that ln(1 + a v) is nearly a v, and λ is
/// judged where it reaches 0.005: on stiffer contacts it hardly acts.
TEST_P(EachComparison, IsRightOnExactRecords) {
  const Method method = GetParam();
  double worst_k = 0.0, worst_n = 0.0, worst_lambda = 0.0;
  for (const double k : {1e1, 1e2, 1e4, 1e6, 1e8}) {
    for (const double n : {1.0, 1.5, 2.0, 3.0}) {
      ContactCell cell{k, n, 0.0, 0.0, Excitation::kProbe};
      const double speed_max = 5.0 * cell.deepest_m();
      cell.a = std::min(0.15, 0.05 / speed_max);
      test::Samples record = test::exact_record(cell);
      if (method == Method::kKelvinVoigt) {
        for (PenetrationSample& s : record) s.force_n = k * s.x_m + cell.lambda() * s.v_m_per_s;
      }
      const ContactAnswer a = identified(method, cell, record);
      ASSERT_TRUE(a.valid) << words(cell);
      worst_k = std::max(worst_k, std::abs(a.k.value / k - 1.0));
      if (cell.a * speed_max > 0.005)
        worst_lambda = std::max(worst_lambda, std::abs(a.lambda.value / cell.lambda() - 1.0));
      if (method != Method::kKelvinVoigt) worst_n = std::max(worst_n, std::abs(a.n.value - n));
    }
  }
  std::printf("%s: k off by at most %.2g %%, lambda %.2g %%, n %.2g\n", std::string(name_of(method)).c_str(),
              100.0 * worst_k, 100.0 * worst_lambda, worst_n);
  EXPECT_LT(worst_k, 0.005);
  EXPECT_LT(worst_lambda, 0.03);
  EXPECT_LT(worst_n, 0.002);
}

/// From a touch at a depth of 0, over every stiffness; and what excites nothing: constant speed, no force.
TEST_P(EachComparison, IsFiniteAtExtremes) {
  const auto expect_finite = [](const ContactAnswer& a) {
    for (const Identified* p : {&a.k, &a.lambda, &a.n, &a.secant, &a.stiffness})
      EXPECT_TRUE(std::isfinite(p->value) && std::isfinite(p->sd));
  };
  for (const double k : {1e1, 1e3, 1e6, 1e8}) {
    for (const double n : {1.0, 2.0, 3.0}) {
      for (const double noise : {0.0, 0.25}) {
        SCOPED_TRACE("k " + std::to_string(k) + " n " + std::to_string(n));
        const ContactCell cell{k, n, 0.15, noise, Excitation::kTouchCycles};
        Random random(1);
        const test::Samples touches = test::with_noise(test::exact_record(cell), noise, random);
        const double deepest = cell.deepest_m();
        test::Samples constant_speed, no_force, no_depth;
        for (int i = 1; i <= 2000; ++i) {
          const double x = deepest * i / 2000.0, v = deepest / 2.0;
          constant_speed.push_back({x, v, cell.force(x, v) + noise * random.normal()});
          no_force.push_back({x, v, 0.0});
          no_depth.push_back({1e-12 * (1.0 + i % 2), v, noise * random.normal()});
        }
        for (const test::Samples& record : {touches, constant_speed, no_force, no_depth})
          expect_finite(identified(GetParam(), cell, record));
      }
    }
  }
}

/// sd of the tangent at the deepest over the bound of it.
double over_bound(Method method, const ContactCell& cell, int records) {
  const test::Samples exact = test::exact_record(cell);
  Random random(1);
  double squares = 0.0;
  for (int i = 0; i < records; ++i) {
    const ContactAnswer a = identified(method, cell, test::with_noise(exact, cell.noise_n, random));
    const double right = tangent(cell.k, cell.n, cell.deepest_m());
    const double error = a.valid ? tangent(a.k.value, a.n.value, cell.deepest_m()) / right - 1.0 : 1.0;
    squares += error * error / records;
  }
  return std::sqrt(squares) / test::cramer_rao(cell, exact).stiffness;
}

struct Limit {
  Method method;
  double at_least, at_most;
};

/// 200 records: the ratio is known to 5 %.
TEST(Comparison, ReachesBoundInTheCellOfTrade) {
  for (const Limit& l :
       {Limit{Method::kMaximumLikelihood, 0.9, 1.1}, Limit{Method::kExtendedKalman, 0.9, 1.1},
        Limit{Method::kWeightedLogLinear, 0.9, 1.1}, Limit{Method::kTwoStage, 0.9, 1.3},
        Limit{Method::kLogLinear, 1.8, 3.0}}) {  // the control: samples all alike
    const double ratio = over_bound(l.method, {}, 200);
    std::printf("%s: %.3f of the bound\n", std::string(name_of(l.method)).c_str(), ratio);
    EXPECT_GT(ratio, l.at_least) << name_of(l.method);
    EXPECT_LT(ratio, l.at_most) << name_of(l.method);
  }
}

/// a v from -1.4 to 1.4, and many forces that are not positive.
TEST(Comparison, KalmanFilterNeedsNoSmallDamping) {
  const ContactCell cell{1e2, 2.0, 0.8, 0.25, Excitation::kTouchCycles};
  const double kalman = over_bound(Method::kExtendedKalman, cell, 100);
  const double unweighted = over_bound(Method::kLogLinear, cell, 100);
  std::printf("extended-kalman: %.2f of the bound, two-stage %.1f, log-linear %.1f\n", kalman,
              over_bound(Method::kTwoStage, cell, 100), unweighted);
  EXPECT_LT(kalman, 1.6);
  EXPECT_GT(unweighted, 10.0);
}

TEST(Comparison, WeightedLogLinearIsNotBiasedByDamping) {
  const ContactCell cell{800.0, 1.5, 3.0, 0.0, Excitation::kProbe};
  const test::Samples record = test::exact_record(cell);
  const double mended = identified(Method::kWeightedLogLinear, cell, record).k.value / cell.k - 1.0;
  const double published = identified(Method::kLogLinear, cell, record).k.value / cell.k - 1.0;
  std::printf("k off by %.3g %%, about a v = 0 by %.3g %%\n", 100.0 * mended, 100.0 * published);
  EXPECT_LT(std::abs(mended), 0.015);  // of the samples before a was known
  EXPECT_GT(std::abs(published), 0.04);
}

}  // namespace
}  // namespace longreach::comparison_estimators_test
