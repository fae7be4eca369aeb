#pragma once
// Identifies a Hunt-Crossley contact F = k xⁿ + λ xⁿ v with an estimator of this folder, or one that is
// brought (estimator.hpp), and says what it may be trusted in. The surface is known, or identified with the
// rest; then positions count from any fixed point, samples from before the touch belong to it, and all depths
// are those behind the surface as known now. What the estimators share:
//   noise: of the force as given, or from differences of the samples; then from the residuals.
//   hold: resolution, bias and drift repeat themselves in each sample of a still hold, so only 25 samples
//   within 0.05 % of a depth, or 3 sd of the position, count: nothing winds up, however long it lasts.
//   change: the force is off by over 8 % for 20 samples and far outside its noise: another object or layer;
//   the fit begins anew. MAXIMUM_LIKELIHOOD only: the others are off by more than that by themselves, and are
//   told (watched_identifier.hpp).
//   slow touch: secant and stiffness use that a v at the greatest speed is 0.01 ± 0.01 unless the samples
//   contradict. Until the speed has changed, nothing else tells elastic from damping force.
//   verdict: identified is a parameter with an sd below 5 % (k, stiffness), 0.05 (n), 20 % (λ), 5 %/3
//   (secant), after 50 ms of contact; not identifiable what 1000 samples or a hold have not told, and
//   everything when the noise of the position is above 10 % of the depth: it biases every method.
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
  double forgetting = 1.0;        // share of the past that is kept a sample
  double force_noise_n = 0.0;     // sd; 0: from the samples
  double position_noise_m = 0.0;  // sd; 0: from the samples
  bool surface_known = true;      // positions count from it
  /// Makes an estimator in place of `kind`'s.
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
  bool valid = false;  // there is a fit; else all else is zero
  Identified k;        // N/mⁿ; Kelvin-Voigt: N/m
  Identified lambda;   // N s/m^(n+1); Kelvin-Voigt: N s/m
  Identified n;
  Identified secant;          // elastic force over depth, N/m, at depth_m
  Identified stiffness;       // tangent, d(elastic force)/dx, N/m
  Identified surface;         // m, where positions count from
  double correlation = 0.0;   // of k and λ
  double depth_m = 0.0;       // that it is told for
  double force_sd_n = 0.0;    // of a sample
  std::uint32_t changes = 0;  // that were found
};

class Identifier {
 public:
  explicit Identifier(const IdentifierConfig& config);

  /// Another contact: nothing of the one before is kept.
  void begin();
  /// In front of a surface that is known is free space. `dt` since the sample before, s.
  void step(const PenetrationSample& sample, double dt);
  /// Another object or layer under the tool: the fit begins anew.
  void renew();
  [[nodiscard]] std::uint32_t changes() const { return changes_; }  // that were found
  /// At the depth of the last sample in contact. Everything up to the last sample; with an unknown surface up
  /// to the last 128.
  [[nodiscard]] ContactAnswer answer();
  /// The same of another depth, > 0.
  [[nodiscard]] ContactAnswer answer_at(double depth_m) const;
  /// False where the force is off the law by more than its noise: no power law fits. MAXIMUM_LIKELIHOOD only.
  [[nodiscard]] bool law_fits() const;
  /// The depth nearest to `depth_m` that the samples of the fit have seen.
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
  [[nodiscard]] bool settled() const;  // the force at the present depth is known to 5 %
  [[nodiscard]] double foreseen_variance(const PenetrationSample& sample) const;
  void watch(const PenetrationSample& sample, double innovation_n);
  void restart();

  IdentifierConfig config_;
  Held estimator_;
  DifferenceNoise force_noise_;
  DifferenceNoise position_noise_;
  PenetrationSample last_{};  // in contact
  double contact_s_ = 0.0;    // since the fit began
  double speed_max_ = 0.0;    // since then
  double force_max_n_ = 0.0;
  double residual_squares_ = 0.0;
  double residuals_ = 0.0;
  double drift_n_ = 0.0;                         // mean innovation of the last 20 samples
  double deepest_m_ = 0.0, shallowest_m_ = 0.0;  // positions in contact
  double hold_m_ = 0.0;                          // position of the present hold
  int held_ = 0;                                 // samples in it
  int samples_ = 0;                              // in the fit
  std::uint32_t steps_ = 0;                      // since the fit began
  double variance_n2_ = 0.0;                     // of the force, as looked at last
  bool settled_ = false;                         // likewise
  std::uint32_t changes_ = 0;
  std::uint64_t ignored_ = 0;
};

/// "maximum-likelihood" and so on.
std::string_view name_of(EstimatorKind kind);
std::string_view text_of(Verdict verdict);

}  // namespace longreach
