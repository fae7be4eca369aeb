#pragma once
// Identifies a Hunt-Crossley contact F = k xⁿ + λ xⁿ v with an estimator of this folder, or with an external
// one (estimator.hpp), and states which parameters are reliable. The surface is either known or identified
// with the parameters. If it is identified, positions may be relative to any fixed point, samples before the
// touch are included, and all depths are relative to the current estimate of the surface position. All
// estimators have these properties:
//   noise: the noise of the force is given, or it is estimated from differences of the samples and later from
//       the residuals.
//   hold: in a hold at rest, resolution, bias and drift repeat in every sample. Therefore only 25 of the
//       samples whose depths agree within 0.05 % or 3 sd of the position count, and a long hold causes no
//       wind-up.
//   change: if the force deviates by more than 8 % for 20 samples, and by much more than its noise, the tool
//       is on another object or layer, and the fit restarts. Only MAXIMUM_LIKELIHOOD detects this; the other
//       estimators have larger errors even without a change and are notified (watched_identifier.hpp).
//   slow touch: until the speed has changed, elastic and damping force are not distinguishable. Secant and
//       stiffness therefore assume a v = 0.01 ± 0.01 at the maximum speed unless the samples contradict.
//   verdict: a parameter is identified if its sd is below 5 % (k, stiffness), 0.05 (n), 20 % (λ) or 5 %/3
//       (secant) after 50 ms of contact. It is not identifiable if 1000 samples or a hold did not suffice, or
//       if the noise of the position exceeds 10 % of the depth, because such noise biases every method.
// Samples that are not finite or outside the ranges 1e-12..1e6 m, 1e6 m/s and 1e12 N are ignored and counted.

#include <cstdint>
#include <string_view>
#include <variant>

#include "schema/config_slave.hpp"
#include "schema/state_link.hpp"
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
  double exponent = 1.5;          // for FIXED_EXPONENT
  double forgetting = 1.0;        // factor by which each new sample discounts the older ones
  double force_noise_n = 0.0;     // standard deviation; 0: estimated from the samples
  double position_noise_m = 0.0;  // standard deviation; 0: estimated from the samples
  bool surface_known = true;      // positions are relative to the surface
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
  Identified secant;          // elastic force/depth at depth_m, N/m
  Identified stiffness;       // tangent d(elastic force)/dx at depth_m, N/m
  Identified surface;         // position of the surface, m
  double correlation = 0.0;   // correlation of the errors of k and λ
  double depth_m = 0.0;       // depth to which secant and stiffness refer
  double force_sd_n = 0.0;    // standard deviation of a force sample
  std::uint32_t changes = 0;  // number of detected changes
};

class Identifier {
 public:
  /// An external estimator `brought` is used in place of `config.kind`.
  explicit Identifier(const IdentifierConfig& config, std::unique_ptr<Estimator> brought = nullptr);

  /// Starts a new contact and discards everything about the previous one.
  void begin();
  /// Processes a sample, `dt` s after the previous one. Samples in front of a known surface are not used.
  void step(const PenetrationSample& sample, double dt);
  /// Restarts the fit because the tool is on a different object or layer.
  void renew();
  /// True for MAXIMUM_LIKELIHOOD of the slave.
  [[nodiscard]] bool by_likelihood() const { return by_likelihood_; }
  [[nodiscard]] std::uint32_t changes() const { return changes_; }  // number of detected changes
  /// Returns the estimate at the depth of the last sample in contact. It includes all samples or, if the
  /// surface is unknown, all except at most the last 128.
  [[nodiscard]] ContactAnswer answer();
  /// Returns the estimate at another depth, > 0.
  [[nodiscard]] ContactAnswer answer_at(double depth_m) const;
  /// Returns false if the force deviates from the law by more than its noise, which means that no power law
  /// fits. MAXIMUM_LIKELIHOOD only; always true for the other estimators.
  [[nodiscard]] bool law_fits() const;
  /// Returns the depth nearest to `depth_m` within the range covered by the samples of the fit.
  [[nodiscard]] double visited(double depth_m) const;
  /// Returns the depth at which the elastic force is `force_n` > 0; 0 if there is no fit.
  [[nodiscard]] double depth_of(double force_n) const;
  [[nodiscard]] std::uint64_t ignored() const { return ignored_; }

 private:
  using Held = std::variant<FixedExponent, MaximumLikelihood, ContactCurve, BroughtEstimator>;
  static Held estimator_of(const IdentifierConfig& config, std::unique_ptr<Estimator> brought);
  [[nodiscard]] const ContactFit& fit() const;
  [[nodiscard]] double force_variance() const;
  [[nodiscard]] double position_sd() const;
  bool still(double x_m);
  /// True if the standard deviation of the force at the current depth is below 5 %.
  [[nodiscard]] bool settled() const;
  [[nodiscard]] double foreseen_variance(const PenetrationSample& sample) const;
  void watch(const PenetrationSample& sample, double innovation_n);
  void restart();

  IdentifierConfig config_;
  bool by_likelihood_;
  Held estimator_;
  DifferenceNoise force_noise_;
  DifferenceNoise position_noise_;
  PenetrationSample last_{};  // last sample in contact
  double contact_s_ = 0.0;    // time in contact since the start of the fit
  double speed_max_ = 0.0;    // maximum speed since the start of the fit
  double force_max_n_ = 0.0;
  double residual_squares_ = 0.0;
  double residuals_ = 0.0;
  double drift_n_ = 0.0;                         // mean innovation of the last 20 samples
  double deepest_m_ = 0.0, shallowest_m_ = 0.0;  // range of the positions in contact
  double hold_m_ = 0.0;                          // position of the current hold
  int held_ = 0;                                 // number of samples in the current hold
  int samples_ = 0;                              // number of samples in the fit
  std::uint32_t steps_ = 0;                      // number of samples since the start of the fit
  double variance_n2_ = 0.0;                     // variance of the force, at the last evaluation
  bool settled_ = false;                         // settled() at the last evaluation
  std::uint32_t changes_ = 0;
  std::uint64_t ignored_ = 0;
};

/// For example "maximum-likelihood".
std::string_view name_of(EstimatorKind kind);
std::string_view text_of(Verdict verdict);

}  // namespace longreach
