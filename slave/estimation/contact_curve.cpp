#include "slave/estimation/contact_curve.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <limits>

namespace longreach {
namespace {

constexpr double kCurvePriorN = 1.5, kCurvePriorNSd = 0.5;
constexpr double kGivenNSd = 1e-6;
constexpr double kCurvePriorASd = 2.5;  // s/m
constexpr double kLowestN = 1.0, kHighestN = 3.0;
constexpr double kStepN = 0.5;      // at most
constexpr double kStepDepth = 0.5;  // of the depth, at most
constexpr double kFarthest = 1e3;   // depth, over the way that was seen
constexpr int kTrials = 3;          // of a step, before the samples to come are waited for
constexpr double kDampingLeast = 1e-6, kDampingMost = 1e6;
constexpr int kCurveShareUnused = 32;
constexpr int kUnusedMost = 128;  // at a long memory
constexpr int kUnusedLeast = 32;
constexpr int kCurveSamplesMin = 6;
constexpr double kPlaced = 0.2;  // of the depth, sd of the surface: until then it is looked for anew

// A bin behind the surface, with what the law makes of its place.
struct DepthRow {
  double w, v, vv, f, fv;
  double dv;         // Σ w (x - mean) v: else a tool that slows down on its way in looks like damping
  double g;          // ξⁿ
  double log_xi;     // ln ξ
  double per_depth;  // 1/m
};

struct Rows {
  std::array<DepthRow, DepthBins::kBins> row;
  int count = 0;
};

Rows behind(const DepthBins& bins, double x0, double n, double reference_m) {
  Rows rows;
  for (const DepthBin& b : bins.bins()) {
    if (!(b.w > 0.0)) continue;
    const double depth = b.x / b.w - x0;
    if (!(depth > 0.0)) continue;
    const double log_xi = std::log(depth / reference_m);
    const double g = std::exp(n * log_xi);
    rows.row[static_cast<std::size_t>(rows.count++)] = {
        b.w, b.v, b.vv, b.f, b.fv, b.xv - b.x / b.w * b.v, g, log_xi, 1.0 / depth};
  }
  return rows;
}

}  // namespace

struct ContactCurve::Fitted {
  bool valid = false;
  Place place;
  double reference_m = 0.0;  // greatest depth
  double c0 = 0.0, c1 = 0.0;
  double cost = std::numeric_limits<double>::infinity();  // less what depends on the samples alone
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();  // of (c0, c1, n, x0), times the variance
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();        // of half the cost by (n, x0), downhill
};

ContactCurve::ContactCurve(const Law& law)
    : law_(law),
      prior_n_(law.exponent > 0.0 ? law.exponent : kCurvePriorN),
      prior_n_sd_(law.exponent > 0.0 ? kGivenNSd : kCurvePriorNSd),
      memory_(
          static_cast<int>(std::clamp(1.0 / (1.0 - law.forgetting), double{kCurveShareUnused * kUnusedLeast},
                                      double{kCurveShareUnused * kUnusedMost}))) {
  place_.n = prior_n_;
}

ContactCurve::Fitted ContactCurve::fitted(const Place& place, double variance) const {
  Fitted result;
  result.place = place;
  result.reference_m = deepest_m_ - place.x0;
  if (!(result.reference_m > 0.0)) return result;
  const Rows rows = behind(bins_, place.x0, place.n, result.reference_m);
  double S0 = 0.0, S1 = 0.0, S2 = 0.0, R0 = 0.0, R1 = 0.0;
  for (int i = 0; i < rows.count; ++i) {
    const DepthRow& r = rows.row[static_cast<std::size_t>(i)];
    S0 += r.w * r.g * r.g;
    S1 += r.g * r.g * (r.v + place.n * r.per_depth * r.dv);
    S2 += r.vv * r.g * r.g;
    R0 += r.f * r.g;
    R1 += r.fv * r.g;
  }
  const double c = S0 > 0.0 ? R0 / S0 : 0.0;
  const double ridge =
      variance / (c * c * kCurvePriorASd * kCurvePriorASd + std::numeric_limits<double>::min());
  const double determinant = S0 * (S2 + ridge) - S1 * S1;
  // No material gives energy back.
  const double free_c1 = (R1 * S0 - R0 * S1) / determinant;
  const double c1 = std::max(free_c1, 0.0);
  const double c0 = free_c1 < 0.0 ? c : (R0 * (S2 + ridge) - R1 * S1) / determinant;
  if (!(determinant > 0.0) || !(c0 > 0.0) || !std::isfinite(c1)) return result;
  result.c0 = c0;
  result.c1 = c1;
  const double prior = variance / (prior_n_sd_ * prior_n_sd_);
  const double off = place.n - prior_n_;
  result.cost = prior * off * off - c0 * R0 - c1 * R1;

  Eigen::Matrix4d& A = result.information;
  for (int i = 0; i < rows.count; ++i) {
    const DepthRow& r = rows.row[static_cast<std::size_t>(i)];
    // Columns of the law in its parameters: u + w v.
    const double d = r.g * c1;  // the damping moves with the surface and n
    const double slope = -place.n * r.per_depth;
    const double u[4] = {r.g, 0.0, r.g * c0 * r.log_xi, r.g * c0 * slope};
    const double w[4] = {0.0, r.g, d * r.log_xi, d * slope};
    const double g_slope = place.n * r.per_depth * r.g;
    const double miss_1 = r.f - r.g * c0 * r.w - c1 * (r.g * r.v + g_slope * r.dv);    // Σ (F - model)
    const double miss_v = r.fv - c0 * (r.g * r.v + g_slope * r.dv) - r.g * c1 * r.vv;  // Σ (F - model) v
    for (int p = 0; p < 4; ++p) {
      for (int q = p; q < 4; ++q) {
        A(p, q) += u[p] * u[q] * r.w + (u[p] * w[q] + w[p] * u[q]) * r.v + w[p] * w[q] * r.vv;
      }
      if (p >= 2) result.slope[p - 2] += u[p] * miss_1 + w[p] * miss_v;
    }
  }
  A(1, 1) += ridge;
  A(2, 2) += prior;
  result.slope[0] -= prior * off;
  A.triangularView<Eigen::StrictlyLower>() = A.transpose();
  result.valid = A.allFinite();
  return result;
}

double ContactCurve::step(const PenetrationSample& sample, double force_variance_n2) {
  const double innovation = fit_.valid ? sample.force_n - fit_.force_at(sample) : std::nan("");
  if (samples_ == 0) shallowest_m_ = deepest_m_ = sample.x_m;
  shallowest_m_ = std::min(shallowest_m_, sample.x_m);
  deepest_m_ = std::max(deepest_m_, sample.x_m);
  bins_.add(sample, law_.forgetting);
  samples_ = std::min(samples_ + 1, memory_);
  if (++unused_ * kCurveShareUnused >= samples_ && samples_ >= kCurveSamplesMin) refresh(force_variance_n2);
  return innovation;
}

// A straight line through the samples, weighed by their force, has the contact's slope T and force F at their
// middle; a contact of exponent n with these begins n F/T before it.
void ContactCurve::search(double variance) {
  double w = 0.0, x = 0.0, f = 0.0, xx = 0.0, xf = 0.0;
  for (const DepthBin& b : bins_.bins()) {
    if (!(b.w > 0.0)) continue;
    const double share = std::max(b.f, 0.0), at = b.x / b.w - deepest_m_, force = b.f / b.w;
    w += share;
    x += share * at;
    f += share * force;
    xx += share * at * at;
    xf += share * at * force;
  }
  x /= w;
  f /= w;
  const double slope = (xf / w - x * f) / (xx / w - x * x);
  if (!(slope > 0.0) || !std::isfinite(slope)) return;
  Fitted best;
  for (const double tried : {1.0, 1.5, 2.0, 2.5}) {
    const double n = law_.exponent > 0.0 ? law_.exponent : tried;
    const Fitted one = fitted({n, deepest_m_ + x - n * f / slope}, variance);
    if (one.valid && one.cost < best.cost) best = one;
  }
  if (fit_.valid) {
    const Fitted present = fitted(place_, variance);
    if (present.valid && present.cost <= best.cost) best = present;
  }
  if (!best.valid) return;
  place_ = best.place;
  sought_ = true;
}

void ContactCurve::refresh(double force_variance_n2) {
  unused_ = 0;
  const double variance = force_variance_n2 * bins_.weight();
  const bool placed = fit_.valid && fit_.covariance(3, 3) < std::pow(kPlaced * fit_.reference_m, 2);
  if (!placed) search(variance);
  if (!sought_) return;
  Fitted now = fitted(place_, variance);
  if (!now.valid) {
    fit_.valid = false;
    return;
  }
  for (int i = 0; i < kTrials; ++i) {
    // Of (n, x0), with c0 and c1 free.
    const Eigen::Matrix2d cross = now.information.topRightCorner<2, 2>();
    const Eigen::Matrix2d H = now.information.bottomRightCorner<2, 2>() -
                              cross.transpose() * now.information.topLeftCorner<2, 2>().inverse() * cross;
    Eigen::Matrix2d damped = H;
    damped.diagonal() *= 1.0 + damping_;
    Eigen::Vector2d step = damped.inverse() * now.slope;
    const double n_next = place_.n + step[0];
    if (n_next < kLowestN || n_next > kHighestN) {  // as far as that, and the surface by itself
      step[0] = std::clamp(n_next, kLowestN, kHighestN) - place_.n;
      step[1] = (now.slope[1] - H(1, 0) * step[0]) / damped(1, 1);
    }
    if (!step.allFinite()) break;
    const double depth = deepest_m_ - place_.x0;
    Place next;
    next.n = place_.n + std::clamp(step[0], -kStepN, kStepN);
    next.x0 = std::max(place_.x0 + std::clamp(step[1], -2.0 * depth, kStepDepth * depth),
                       deepest_m_ - kFarthest * (deepest_m_ - shallowest_m_));
    const Fitted trial = fitted(next, variance);
    if (trial.valid && trial.cost <= now.cost) {
      place_ = next;
      now = trial;
      damping_ = std::max(0.1 * damping_, kDampingLeast);
      break;
    }
    damping_ = std::min(10.0 * damping_, kDampingMost);
  }
  publish(now, variance);
}

void ContactCurve::publish(const Fitted& now, double variance) {
  const Eigen::Vector4d scale = now.information.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::Matrix4d inner = (scale.asDiagonal() * now.information * scale.asDiagonal()).eval().inverse();
  const double a = now.c1 / now.c0;
  Eigen::Matrix4d J = Eigen::Matrix4d::Zero();  // of (ln f, n, a, x0) by (c0, c1, n, x0)
  J(0, 0) = 1.0 / now.c0;
  J(1, 2) = 1.0;
  J(2, 0) = -a / now.c0;
  J(2, 1) = 1.0 / now.c0;
  J(3, 3) = 1.0;
  J = J * scale.asDiagonal();
  fit_.reference_m = now.reference_m;
  fit_.surface_m = now.place.x0;
  fit_.force_n = now.c0;
  fit_.n = now.place.n;
  fit_.a_s_per_m = a;
  fit_.covariance = bins_.variance_share() * variance * J * inner * J.transpose();
  fit_.valid = fit_.covariance.allFinite() && (fit_.covariance.diagonal().array() >= 0.0).all();
}

}  // namespace longreach
