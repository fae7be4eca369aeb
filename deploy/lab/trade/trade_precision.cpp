// float against double: the same textbook formula in both types, compared with long double.

#include <array>
#include <cmath>
#include <vector>

#include "common/core/random.hpp"
#include "deploy/lab/trade/cost.hpp"
#include "deploy/lab/trade/trade.hpp"

namespace longreach {
namespace {

constexpr int kCases = 512;

/// The six inputs of a case, each from 0 to 1.
using Case = std::array<double, 6>;

/// Motor angle of a leg of a DELTA device: a cos θ + b sin θ + c = 0.
template <class T>
T delta_leg(const Case& u) {
  const T x = T(0.05) * (T(u[0]) - T(0.5)), y = T(0.05) * (T(u[1]) - T(0.5)), z = T(0.13) + T(0.05) * T(u[2]);
  const T arm = T(0.11), rod = T(0.2), d = x - T(0.06);
  const T a = T(-2) * arm * d, b = T(-2) * arm * z, c = d * d + y * y + z * z + arm * arm - rod * rod;
  return T(2) * std::atan((-b - std::sqrt(a * a + b * b - c * c)) / (c - a));
}

/// Where a six-joint arm of 15 m reaches, along x.
template <class T>
T arm_forward(const Case& u) {
  constexpr double kLink_m[] = {0.0, 6.38, 7.06, 0.46, 0.76, 0.66};
  T x = 0, y = 0, angle = 0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    angle += T(u[i]);
    x += T(kLink_m[i]) * std::cos(angle);
    y += T(kLink_m[i]) * std::sin(angle);
  }
  return x + y;
}

template <class T>
T hunt_crossley(const Case& u) {
  return T(1e4) * std::pow(T(1e-2) * T(u[0]) + T(1e-4), T(1) + T(u[1])) * (T(1) + T(u[2]));
}

/// k by recursive least squares from 2000 samples of F = k x + λ v, forgetting 0.9998.
template <class T>
T least_squares(const Case& u) {
  T k = 0, l = 0, p11 = T(1e8), p12 = 0, p22 = T(1e8);
  for (int i = 0; i < 2000; ++i) {
    const double t = 1e-3 * i, phase = 6.28 * u[1];
    const double x = 2e-3 + 1e-3 * std::sin(8.0 * t + phase), v = 8e-3 * std::cos(8.0 * t + phase);
    const T f = T((800.0 + 1e3 * u[0]) * x + 20.0 * v), a = T(x), b = T(v), keep = T(0.9998);
    const T g1 = p11 * a + p12 * b, g2 = p12 * a + p22 * b, s = keep + a * g1 + b * g2;
    const T e = (f - k * a - l * b) / s;
    k += g1 * e;
    l += g2 * e;
    p11 = (p11 - g1 * g1 / s) / keep;
    p12 = (p12 - g1 * g2 / s) / keep;
    p22 = (p22 - g2 * g2 / s) / keep;
  }
  return k;
}

/// Position of a handle after a minute of ticks of 1 ms at up to 0.1 m/s.
template <class T>
T integrate(const Case& u) {
  T x = T(u[0]);
  for (int i = 0; i < 60000; ++i) x += T(1e-3) * T(0.1) * T(u[1]);
  return x;
}

struct Kernel {
  const char* name;
  float (*in_float)(const Case&);
  double (*in_double)(const Case&);
  long double (*exact)(const Case&);
  int cases;
};

constexpr Kernel kKernels[] = {
    {"delta_leg", delta_leg<float>, delta_leg<double>, delta_leg<long double>, kCases},
    {"arm_forward", arm_forward<float>, arm_forward<double>, arm_forward<long double>, kCases},
    {"hunt_crossley", hunt_crossley<float>, hunt_crossley<double>, hunt_crossley<long double>, kCases},
    {"least_squares", least_squares<float>, least_squares<double>, least_squares<long double>, 8},
    {"integrate", integrate<float>, integrate<double>, integrate<long double>, 4},
};

template <class T>
TradePoint point_of(const char* series, const Kernel& kernel, T (*compute)(const Case&),
                    const std::vector<Case>& cases) {
  TradePoint point{series, kernel.name};
  point.standard = sizeof(T) == sizeof(double);
  for (const Case& c : cases) {
    const long double exact = kernel.exact(c);
    point.error = std::max(point.error, static_cast<double>(std::abs((compute(c) - exact) / exact)));
  }
  T sum = 0;  // prevents the compiler from removing the computation
  const auto call = [&](int i) { sum += compute(cases[static_cast<std::size_t>(i) % cases.size()]); };
  point.cost = cost_ns(kernel.cases, call);
  if (!std::isfinite(sum)) point.error = 1.0;
  return point;
}

std::vector<TradePoint> measure_precision(const ExperimentRun& run) {
  Random random = Random(run.seed).child("trade precision");
  std::vector<TradePoint> points;
  for (const Kernel& kernel : kKernels) {
    std::vector<Case> cases(static_cast<std::size_t>(kernel.cases));
    for (Case& c : cases)
      for (double& u : c) u = random.uniform();
    points.push_back(point_of("float", kernel, kernel.in_float, cases));
    points.push_back(point_of("double", kernel, kernel.in_double, cases));
  }
  return points;
}

}  // namespace

TradeStage trade_precision() {
  return {.name = "precision",
          .title = "Float versus double: leg, arm, contact, least squares, integration",
          .cost = "time per call",
          .cost_unit = "ns",
          .error = "maximum relative error",
          .error_unit = "1",
          .series = {"float", "double"},
          .measure = measure_precision};
}

}  // namespace longreach
