#pragma once
// Identifies a Hunt-Crossley contact F = k xⁿ + λ xⁿ v with an estimator of this folder, or an external one
// (estimator.hpp), and states which parameters are reliable. The surface is known, or identified with the
// parameters; in that case positions count from any fixed point, samples before the touch are included, and
// all depths are relative to the present estimate of the surface. Common to the estimators:
//   noise: of the force as given, or from differences of the samples; then from the residuals.
//   hold: resolution, bias and drift repeat in each sample of a still hold, so only 25 samples within 0.05 %
//   of a depth, or 3 sd of the position, count: there is no wind-up, however long the hold lasts.
//   change: the force differs by over 8 % for 20 samples and far beyond its noise: another object or layer;
//   the fit restarts. MAXIMUM_LIKELIHOOD only: the other estimators have larger errors by themselves, and
//   are notified (watched_identifier.hpp).
//   slow touch: secant and stiffness assume that a v at the maximum speed is 0.01 ± 0.01 unless the samples
//   contradict. Until the speed has changed, elastic and damping force are not distinguishable otherwise.
//   verdict: a parameter is identified if its sd is below 5 % (k, stiffness), 0.05 (n), 20 % (λ), 5 %/3
//   (secant), after 50 ms of contact; it is not identifiable if 1000 samples or a hold did not suffice, or if
//   the noise of the position is above 10 % of the depth, which biases every method.
// Samples outside 1e-12..1e6 m, 1e6 m/s, 1e12 N, or not finite, are ignored and counted.

#include <cstdint>
#include <string_view>
#include <variant>

#include "common/link/telemetry.hpp"
#include "slave/config/estimator_config.hpp"
#include "slave/estimation/contact_curve.hpp"
#include "slave/estimation/difference_noise.hpp"
#include "slave/estimation/estimator.hpp"
#include "slave/estimation/fixed_exponent.hpp"
#include "slave/estimation/maximum_likelihood.hpp"

namespace longreach {

inline constexpr EstimatorKind kEstimatorKinds[] = {EstimatorKind::kFixedExponent,
                                                    EstimatorKind::kMaximumLikelihood};

struct IdentifierConfig {
  EstimatorKind kind = EstimatorKind::kMaximumLikelihood;
  double exponent = 1.5;          // of FIXED_EXPONENT
  double forgetting = 1.0;        // share of the past that is kept per sample
  double force_noise_n = 0.0;     // sd; 0: estimated from the samples
  double position_noise_m = 0.0;  // sd; 0: estimated from the samples
  bool surface_known = true;      // positions count from it
  /// Creates an estimator in place of the one of `kind`.
  std::unique_ptr<Estimator> (*make)(const IdentifierConfig&) = nullptr;

  [[nodiscard]] bool by_likelihood() const {
    return kind == EstimatorKind::kMaximumLikelihood && make == nullptr;
  }
};

struct Identified {
  double value = 0.0;
  double sd = 0.0;
  Verdict verdict = Verdict::kNotYet;
};

struct ContactAnswer {
  bool valid = false;  // there is a fit; otherwise all values are zero
  Identified k;        // N/mⁿ; Kelvin-Voigt: N/m
  Identified lambda;   // N s/m^(n+1); Kelvin-Voigt: N s/m
  Identified n;
  Identified secant;          // elastic force over depth, N/m, at depth_m
  Identified stiffness;       // tangent, d(elastic force)/dx, N/m
  Identified surface;         // m, in the coordinate of the positions
  double correlation = 0.0;   // of k and λ
  double depth_m = 0.0;       // depth of these values
  double force_sd_n = 0.0;    // of a sample
  std::uint32_t changes = 0;  // detected changes
};

class Identifier {
 public:
  explicit Identifier(const IdentifierConfig& config);

  /// Starts another contact: discards everything of the previous one.
  void begin();
  /// The space in front of a known surface is free space. `dt` since the previous sample, s.
  void step(const PenetrationSample& sample, double dt);
  /// Restarts the fit for another object or layer under the tool.
  void renew();
  [[nodiscard]] std::uint32_t changes() const { return changes_; }  // number of detected changes
  /// At the depth of the last sample in contact. Includes all samples; with an unknown surface all but the
  /// last 128 at most.
  [[nodiscard]] ContactAnswer answer();
  /// The same for another depth, > 0.
  [[nodiscard]] ContactAnswer answer_at(double depth_m) const;
  /// Returns false if the force deviates from the law by more than its noise: no power law fits.
  /// MAXIMUM_LIKELIHOOD only.
  [[nodiscard]] bool law_fits() const;
  /// Returns the depth nearest to `depth_m` that the samples of the fit have reached.
  [[nodiscard]] double visited(double depth_m) const;
  /// Depth at which the elastic force is `force_n` > 0; 0 without a fit.
  [[nodiscard]] double depth_of(double force_n) const;
  [[nodiscard]] std::uint64_t ignored() const { return ignored_; }

 private:
  using Held = std::variant<FixedExponent, MaximumLikelihood, ContactCurve, BroughtEstimator>;
  static Held estimator_of(const IdentifierConfig& config);
  [[nodiscard]] const ContactFit& fit() const;
  [[nodiscard]] double force_variance() const;
  [[nodiscard]] double position_sd() const;
  bool still(double x_m);
  [[nodiscard]] bool settled() const;  // the force at the present depth is known within 5 %
  [[nodiscard]] double foreseen_variance(const PenetrationSample& sample) const;
  void watch(const PenetrationSample& sample, double innovation_n);
  void restart();

  IdentifierConfig config_;
  Held estimator_;
  DifferenceNoise force_noise_;
  DifferenceNoise position_noise_;
  PenetrationSample last_{};  // in contact
  double contact_s_ = 0.0;    // since the start of the fit
  double speed_max_ = 0.0;    // since then
  double force_max_n_ = 0.0;
  double residual_squares_ = 0.0;
  double residuals_ = 0.0;
  double drift_n_ = 0.0;                         // mean innovation of the last 20 samples
  double deepest_m_ = 0.0, shallowest_m_ = 0.0;  // positions in contact
  double hold_m_ = 0.0;                          // position of the present hold
  int held_ = 0;                                 // samples in it
  int samples_ = 0;                              // in the fit
  std::uint32_t steps_ = 0;                      // since the start of the fit
  double variance_n2_ = 0.0;                     // of the force, as last evaluated
  bool settled_ = false;                         // likewise
  std::uint32_t changes_ = 0;
  std::uint64_t ignored_ = 0;
};

/// "maximum-likelihood" and so on.
std::string_view name_of(EstimatorKind kind);
std::string_view text_of(Verdict verdict);

}  // namespace longreach
