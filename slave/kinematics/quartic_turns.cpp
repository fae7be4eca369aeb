#include "slave/kinematics/quartic_turns.hpp"

#include <algorithm>
#include <cmath>

namespace longreach {
namespace {

constexpr double kTouchRounding = 2e-14;  // of the terms, in F at a touch

using Coefficients = std::array<double, 5>;  // of t^0 .. t^4

struct Value {
  double f, slope;
};

Value evaluate(const Coefficients& a, int degree, double t) {
  Value v{0.0, 0.0};
  for (int i = degree; i >= 0; --i) {
    const auto n = static_cast<std::size_t>(i);
    v.slope = v.slope * t + v.f;
    v.f = v.f * t + a[n];
  }
  return v;
}

// The zero between two places of opposite sign.
double bracketed(const Coefficients& a, int degree, double low, double high, bool rises) {
  constexpr int kStepsMax = 60;
  double t = 0.5 * (low + high);
  for (int i = 0; i < kStepsMax; ++i) {
    const Value v = evaluate(a, degree, t);
    if (v.f == 0.0) break;
    ((v.f > 0.0) == rises ? high : low) = t;
    double next = t - v.f / v.slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const double moved = std::abs(next - t);
    t = next;
    if (moved <= 1e-16 * std::max(std::abs(t), 1e-3)) break;
  }
  return t;
}

struct Zeros {
  int count = 0;
  std::array<double, QuarticTurns::kMax> t{};
  void add(double x) { t[static_cast<std::size_t>(count++)] = x; }
};

// Those of `a` within (-bound, bound), where `turns` are the zeros of its derivative in rising order.
Zeros between(const Coefficients& a, int degree, double bound, const Zeros& turns, double touch) {
  Zeros found;
  double low = -bound;
  double f_low = evaluate(a, degree, low).f;
  for (int i = 0; i <= turns.count; ++i) {
    const bool last = i == turns.count;
    const double high = last ? bound : turns.t[static_cast<std::size_t>(i)];
    const Value v = evaluate(a, degree, high);
    const bool touches = !last && std::abs(v.f) <= touch * (1.0 + high * high) * (1.0 + high * high);
    if ((f_low < 0.0) != (v.f < 0.0)) found.add(bracketed(a, degree, low, high, v.f > f_low));
    if (touches) {
      // Rounding hides how far apart the two zeros are.
      const double curvature = std::abs(2.0 * a[2] + high * (6.0 * a[3] + 12.0 * high * a[4]));
      const double aside =
          std::sqrt(kTouchRounding / kTouch * touch * (1.0 + high * high) * (1.0 + high * high) / curvature);
      found.add(high);
      if (aside < 0.1) found.add(high - aside), found.add(high + aside);
    }
    low = high;
    f_low = v.f;
  }
  return found;
}

Zeros real_zeros(const Coefficients& a, double touch) {
  double largest = 0.0;
  for (std::size_t i = 0; i < 4; ++i) largest = std::max(largest, std::abs(a[i]));
  const double bound = 1.0 + largest / std::abs(a[4]);  // Cauchy
  std::array<Coefficients, 5> derivative{};
  derivative[4] = a;
  for (std::size_t d = 4; d > 1; --d) {
    for (std::size_t i = 0; i < d; ++i)
      derivative[d - 1][i] = static_cast<double>(i + 1) * derivative[d][i + 1];
  }
  Zeros zeros;
  zeros.add(-derivative[1][0] / derivative[1][1]);
  for (int d = 2; d <= 4; ++d)
    zeros = between(derivative[static_cast<std::size_t>(d)], d, bound, zeros, d == 4 ? touch : -1.0);
  return zeros;
}

}  // namespace

Trig2 squared(const Trig& f, double weight) {
  const double cc = f.c * f.c, ss = f.s * f.s;
  return {weight * (f.k * f.k + 0.5 * (cc + ss)), weight * 2.0 * f.k * f.c, weight * 2.0 * f.k * f.s,
          weight * 0.5 * (cc - ss), weight * f.c * f.s};
}

QuarticTurns zeros(const Trig2& F, double size) {
  constexpr double kHalf = 0.70710678118654752440;
  constexpr std::array<Turn, 8> kSamples{
      {{1, 0}, {kHalf, kHalf}, {0, 1}, {-kHalf, kHalf}, {-1, 0}, {-kHalf, -kHalf}, {0, -1}, {kHalf, -kHalf}}};
  Turn largest;
  double most = -1.0;
  for (const Turn& x : kSamples) {
    const double f =
        std::abs(F.A + F.B * x.c + F.C * x.s + F.D * (x.c - x.s) * (x.c + x.s) + 2.0 * F.E * x.c * x.s);
    if (f > most) most = f, largest = x;
  }
  if (!(most > 0.0)) return {};
  const Turn middle{-largest.c, -largest.s};  // χ = 0
  const double B = F.B * middle.c + F.C * middle.s, C = F.C * middle.c - F.B * middle.s;
  const double c2 = (middle.c - middle.s) * (middle.c + middle.s), s2 = 2.0 * middle.c * middle.s;
  const double D = F.D * c2 + F.E * s2, E = F.E * c2 - F.D * s2;
  const Zeros t = real_zeros(
      {F.A + B + D, 2.0 * C + 4.0 * E, 2.0 * F.A - 6.0 * D, 2.0 * C - 4.0 * E, F.A - B + D}, kTouch * size);
  QuarticTurns result;
  for (int i = 0; i < t.count; ++i) {
    const double x = t.t[static_cast<std::size_t>(i)], scale = 1.0 / (1.0 + x * x);
    const double c = (1.0 - x) * (1.0 + x) * scale, s = 2.0 * x * scale;
    result.turn[static_cast<std::size_t>(result.count++)] = {c * middle.c - s * middle.s,
                                                             s * middle.c + c * middle.s};
  }
  return result;
}

}  // namespace longreach
