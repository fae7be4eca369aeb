#include "slave/estimation/identifier.hpp"

#include <algorithm>
#include <cmath>

namespace longreach {
namespace {

constexpr double kDepthMinM = 1e-12, kDepthMaxM = 1e6, kSpeedMax = 1e6, kForceMaxN = 1e12;
constexpr double kPriorSamples = 200.0;      // weight of the noise that was given
constexpr double kResidualSamples = 2000.0;  // memory of the residual variance
constexpr double kFirstNoise = 0.02;         // of the largest force, while nothing tells it
constexpr double kForceFloor = 1e-6;         // of the largest force: no sensor is better
constexpr double kStill = 5e-4;              // of the depth
constexpr double kStillNoise = 3.0;          // sd of the position: it moves by itself
constexpr std::uint32_t kOften = 16;         // samples between looks at what hardly changes
constexpr int kHeldMax = 25;
constexpr double kDriftSamples = 20.0;
constexpr double kDriftSd = 2.5;      // of the mean over 20 samples, white: sd 0.16
constexpr double kDriftShare = 0.08;  // of the force; less is not felt
constexpr double kDriftFloor = 0.25;  // of the force at the reference: shallower contact counts as that
constexpr double kClipSd = 10.0, kClipShare = 0.5;  // of one innovation: a single one is no change
constexpr double kSlowTouch = 0.01;                 // a v at the fastest: this, with an sd of this
constexpr int kEnoughSamples = 1000;                // samples that should have told everything
constexpr double kJudgedResiduals = 500.0;
constexpr double kMisfitVariance = 1.5, kMisfit = 0.01;  // of the noise; of the force at the reference
constexpr double kPositionShare = 0.1;
constexpr double kShareSd = 0.05, kExponentSd = 0.05, kDampingShareSd = 0.2;
constexpr double kSecantSd = 0.0155;  // 3 of them within 5 %, and some room
constexpr double kContactMinS = 0.05;

bool usable(const PenetrationSample& s) {  // false for NaN
  return std::abs(s.x_m) <= kDepthMaxM && std::abs(s.v_m_per_s) <= kSpeedMax &&
         std::abs(s.force_n) <= kForceMaxN;
}

double sd_along(const Eigen::Matrix4d& covariance, const Eigen::Vector4d& h) {
  return std::sqrt(std::max(h.dot(covariance * h), 0.0));
}

// At the touch, while the speed has hardly changed, elastic and damping force are not distinguishable. What
// helps is that contacts are met slowly. Given up as soon as the samples contradict. a may be far off and a v
// not small, so this is done where the law is nearly linear: in b = d ln F/dv and ln F at the mean speed,
// which does not depend on b.
ContactFit slow_touch(const ContactFit& f, double speed_max) {
  const Eigen::Matrix4d& P = f.covariance;
  const double ratio = -P(0, 2) / P(2, 2);
  const double share = 1.0 - f.a_s_per_m * ratio;  // 1/(1 + a v) at the mean speed
  if (!(speed_max > 0.0) || !(share > 0.0) || !std::isfinite(share)) return f;
  const double speed = ratio / share;
  const double b = f.a_s_per_m * share;
  const double variance = P(2, 2) * std::pow(share, 4);
  const double mean = kSlowTouch / speed_max;
  const double off = mean - b;
  if (off * off > 16.0 * (variance + mean * mean)) return f;
  const double b_new = b + variance / (variance + mean * mean) * off;
  const double share_new = 1.0 - b_new * speed;
  if (!(share_new > 0.0)) return f;
  const double n_by_b = P(1, 2) / (P(2, 2) * share * share);
  const Eigen::Vector4d along(-speed / share_new, n_by_b, 1.0 / (share_new * share_new), 0.0);
  ContactFit g = f;
  g.force_n = f.force_n * share_new / share;
  g.n = f.n + n_by_b * (b_new - b);
  g.a_s_per_m = b_new / share_new;
  g.covariance = P - P.col(2) * P.row(2) / P(2, 2) +
                 variance * mean * mean / (variance + mean * mean) * along * along.transpose();
  return g;
}

}  // namespace

Identifier::Identifier(const IdentifierConfig& config, std::unique_ptr<Estimator> brought)
    : config_(config),
      by_likelihood_(config.kind == EstimatorKind::kMaximumLikelihood && !brought),
      estimator_(estimator_of(config, std::move(brought))) {}

Identifier::Held Identifier::estimator_of(const IdentifierConfig& c, std::unique_ptr<Estimator> brought) {
  if (brought) return BroughtEstimator(std::move(brought));
  const double exponent = c.kind == EstimatorKind::kFixedExponent ? c.exponent : 0.0;
  if (!c.surface_known) return ContactCurve({exponent, c.forgetting});
  if (exponent > 0.0) return FixedExponent(exponent, c.forgetting);
  return MaximumLikelihood(c.forgetting);
}

void Identifier::begin() {
  restart();
  residual_squares_ = residuals_ = force_max_n_ = 0.0;
  changes_ = 0;
}

void Identifier::restart() {
  std::visit([](auto& e) { e.reset(); }, estimator_);
  contact_s_ = drift_n_ = speed_max_ = 0.0;
  held_ = samples_ = 0;
  deepest_m_ = -kDepthMaxM;
  shallowest_m_ = kDepthMaxM;
  steps_ = 0;
  settled_ = false;
}

const ContactFit& Identifier::fit() const {
  return std::visit([](const auto& e) -> const ContactFit& { return e.fit(); }, estimator_);
}

double Identifier::force_variance() const {
  const double given = config_.force_noise_n > 0.0
                           ? config_.force_noise_n * config_.force_noise_n
                           : force_noise_.cautious_variance(kFirstNoise * force_max_n_);
  const double floor = kForceFloor * force_max_n_;
  return std::max((kPriorSamples * given + residual_squares_) / (kPriorSamples + residuals_), floor * floor);
}

double Identifier::position_sd() const {
  return config_.position_noise_m > 0.0 ? config_.position_noise_m : std::sqrt(position_noise_.variance());
}

bool Identifier::still(double x_m) {
  const double off = x_m - hold_m_;
  // Of the depth, which may still be a wild guess: then of the way that was seen.
  const double share = kStill * std::min(hold_m_ - fit().surface_m,
                                         config_.surface_known ? kDepthMaxM : deepest_m_ - shallowest_m_);
  const double noise = config_.position_noise_m > 0.0 ? config_.position_noise_m * config_.position_noise_m
                                                      : position_noise_.variance();
  if (held_ > 0 && off * off <= std::max(share * share, kStillNoise * kStillNoise * noise)) {
    held_ = std::min(held_ + 1, kHeldMax + 1);
  } else {
    hold_m_ = x_m;
    held_ = 1;
  }
  return held_ > kHeldMax;
}

bool Identifier::settled() const {
  const ContactFit& f = fit();
  const double log_depth = std::log((last_.x_m - f.surface_m) / f.reference_m);
  return f.valid && sd_along(f.covariance, {1.0, log_depth, 0.0, 0.0}) < kShareSd;
}

void Identifier::step(const PenetrationSample& sample, double dt) {
  if (!usable(sample)) {
    ++ignored_;
    return;
  }
  force_noise_.add(sample.force_n);
  position_noise_.add(sample.x_m);
  const bool placed = config_.surface_known || fit().valid;
  if (placed && sample.x_m - fit().surface_m < kDepthMinM) {
    held_ = 0;
    if (!config_.surface_known) std::visit([&](auto& e) { e.step(sample, variance_n2_); }, estimator_);
    return;
  }
  last_ = sample;
  deepest_m_ = std::max(deepest_m_, sample.x_m);
  shallowest_m_ = std::min(shallowest_m_, sample.x_m);
  contact_s_ += dt;
  force_max_n_ = std::max(force_max_n_, std::abs(sample.force_n));
  speed_max_ = std::max(speed_max_, std::abs(sample.v_m_per_s));
  if (++steps_ < kOften || steps_ % kOften == 0) {
    variance_n2_ = force_variance();
    settled_ = settled();
  }
  double innovation = 0.0;
  if (still(sample.x_m)) {
    const ContactFit& known = fit();
    if (!known.valid) return;
    innovation = sample.force_n - known.force_at(sample);
  } else {
    innovation = std::visit([&](auto& e) { return e.step(sample, variance_n2_); }, estimator_);
    samples_ = std::min(samples_ + 1, kEnoughSamples);
  }
  if (settled_ && std::isfinite(innovation)) watch(sample, innovation);
}

// Of the force that the fit foresees, by what is not known of its parameters.
double Identifier::foreseen_variance(const PenetrationSample& s) const {
  const ContactFit& f = fit();
  const double depth_m = s.x_m - f.surface_m;
  if (!(depth_m > 0.0)) return 0.0;
  const double log_depth = std::log(depth_m / f.reference_m), elastic = f.force_n * std::exp(f.n * log_depth);
  const double speed = f.kelvin_voigt ? 0.0 : f.a_s_per_m * s.v_m_per_s, force = elastic * (1.0 + speed);
  const double by_a = (f.kelvin_voigt ? f.force_n : elastic) * s.v_m_per_s;
  const Eigen::Vector4d h(force, force * log_depth, by_a, -f.n * force / depth_m);
  return std::max(h.dot(f.covariance * h), 0.0);
}

void Identifier::watch(const PenetrationSample& sample, double innovation_n) {
  const double foreseen_n = sample.force_n - innovation_n;
  const double variance = variance_n2_;
  const double force = std::max(std::abs(foreseen_n), kDriftFloor * fit().force_n);
  const double square = innovation_n * innovation_n;
  residuals_ = std::min(residuals_ + 1.0, kResidualSamples);
  residual_squares_ += std::min(square, kClipSd * variance) -
                       (residuals_ < kResidualSamples ? 0.0 : residual_squares_ / kResidualSamples);
  // One sample that is far off is no change.
  const double clip = std::max(kClipSd * std::sqrt(variance), kClipShare * force);
  drift_n_ += (std::clamp(innovation_n, -clip, clip) - drift_n_) / kDriftSamples;
  const bool far =
      drift_n_ * drift_n_ > kDriftSd * kDriftSd * variance && std::abs(drift_n_) > kDriftShare * force;
  if (far && by_likelihood_ && settled() &&
      drift_n_ * drift_n_ > kDriftSd * kDriftSd * foreseen_variance(sample))
    renew();
}

void Identifier::renew() {
  ++changes_;
  restart();
}

// What the fit leaves, against the noise that the samples show, and against what is felt.
bool Identifier::law_fits() const {
  if (!by_likelihood_ || residuals_ < kJudgedResiduals) return true;
  const double noise = std::max(config_.force_noise_n * config_.force_noise_n, force_noise_.variance());
  const double felt = kMisfit * fit().force_n;
  return residual_squares_ / residuals_ < kMisfitVariance * noise + felt * felt;
}

ContactAnswer Identifier::answer() {
  if (auto* e = std::get_if<MaximumLikelihood>(&estimator_)) e->refresh(force_variance());
  return answer_at(last_.x_m - fit().surface_m);
}

double Identifier::depth_of(double force_n) const {
  const ContactFit& f = fit();
  return f.valid ? f.reference_m * std::pow(force_n / f.force_n, 1.0 / f.n) : 0.0;
}

double Identifier::visited(double depth_m) const {
  const double surface_m = fit().surface_m;
  return std::min(std::max(depth_m, shallowest_m_ - surface_m), deepest_m_ - surface_m);
}

ContactAnswer Identifier::answer_at(double depth_m) const {
  ContactAnswer a;
  a.force_sd_n = std::sqrt(force_variance());
  a.changes = changes_;
  const ContactFit& f = fit();
  if (!f.valid || !(depth_m > 0.0)) return a;
  const Eigen::Matrix4d& P = f.covariance;
  const double log_reference = std::log(f.reference_m), log_depth = std::log(depth_m) - log_reference;
  const Eigen::Vector4d to_metre(1.0, -log_reference, 0.0, 0.0);
  a.depth_m = depth_m;
  a.surface = {f.surface_m, std::sqrt(P(3, 3))};
  a.n = {f.n, std::sqrt(P(1, 1))};
  a.k.value = f.force_n * std::exp(-f.n * log_reference);
  const double log_k_sd = sd_along(P, to_metre);
  a.k.sd = a.k.value * log_k_sd;
  const double amplitude = f.kelvin_voigt ? f.force_n : a.k.value;
  const Eigen::Vector4d damping(f.a_s_per_m, f.kelvin_voigt ? 0.0 : -f.a_s_per_m * log_reference, 1.0, 0.0);
  const double damping_sd = sd_along(P, damping);
  a.lambda = {amplitude * f.a_s_per_m, amplitude * damping_sd};
  if (log_k_sd > 0.0 && damping_sd > 0.0) {
    a.correlation = std::clamp(to_metre.dot(P * damping) / (log_k_sd * damping_sd), -1.0, 1.0);
  }

  const bool slow = config_.surface_known && !f.kelvin_voigt;
  const ContactFit elastic = slow ? slow_touch(f, speed_max_) : f;
  const double by_n = log_depth, tangent_by_n = log_depth + 1.0 / elastic.n;
  const double by_surface = -(elastic.n - 1.0) / depth_m;  // at this place, wherever the surface is
  a.secant.value = elastic.force_n * std::exp(elastic.n * log_depth) / depth_m;
  a.secant.sd = a.secant.value * sd_along(elastic.covariance, {1.0, by_n, 0.0, by_surface});
  a.stiffness.value = elastic.n * a.secant.value;
  a.stiffness.sd = a.stiffness.value * sd_along(elastic.covariance, {1.0, tangent_by_n, 0.0, by_surface});

  const bool biased = position_sd() > kPositionShare * f.reference_m;
  const bool enough = biased || samples_ >= kEnoughSamples || held_ > kHeldMax;
  const auto judge = [&](Identified& p, double limit, bool early) {
    const bool known = !biased && !early && p.sd <= limit;
    p.verdict = known ? Verdict::kIdentified : enough ? Verdict::kNotIdentifiable : Verdict::kNotYet;
  };
  const bool early = contact_s_ < kContactMinS;
  judge(a.k, kShareSd * a.k.value, early);
  judge(a.lambda, kDampingShareSd * std::abs(a.lambda.value), early);
  judge(a.n, kExponentSd, early);
  judge(a.surface, kShareSd * depth_m, early);
  if (!biased && !law_fits()) a.k.verdict = a.lambda.verdict = a.n.verdict = Verdict::kNoPowerLaw;
  judge(a.secant, kSecantSd * a.secant.value, early);
  judge(a.stiffness, kShareSd * a.stiffness.value, early);
  a.valid = std::isfinite(a.k.value) && std::isfinite(a.k.sd) && std::isfinite(a.lambda.sd) &&
            std::isfinite(a.stiffness.sd) && a.stiffness.value > 0.0;
  return a.valid ? a : ContactAnswer{};
}

std::string_view name_of(EstimatorKind kind) {
  return kind == EstimatorKind::kFixedExponent ? "fixed-exponent" : "maximum-likelihood";
}

std::string_view text_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::kNotYet:
      return "not yet";
    case Verdict::kIdentified:
      return "identified";
    case Verdict::kNotIdentifiable:
      return "not identifiable";
    case Verdict::kNoPowerLaw:
      return "no power law fits";
  }
  return "";
}

}  // namespace longreach
