#include "deploy/lab/estimators/methods.hpp"

#include "deploy/lab/estimators/extended_kalman.hpp"
#include "deploy/lab/estimators/kelvin_voigt.hpp"
#include "deploy/lab/estimators/log_linear.hpp"
#include "deploy/lab/estimators/two_stage.hpp"
#include "deploy/lab/estimators/unknown_surface.hpp"
#include "deploy/lab/estimators/weighted_log_linear.hpp"

namespace longreach {
namespace {

template <class Textbook>
class Of final : public Estimator {
 public:
  explicit Of(const Textbook& estimator) : it_(estimator) {}
  void reset() override { it_.reset(); }
  double step(const PenetrationSample& sample, double force_variance_n2) override {
    return it_.step(sample, force_variance_n2);
  }
  [[nodiscard]] const ContactFit& fit() const override { return it_.fit(); }

 private:
  Textbook it_;
};

template <class Textbook>
std::unique_ptr<Estimator> for_unknown_surface(const Textbook& estimator, const IdentifierConfig& c) {
  if (c.surface_known) return std::make_unique<Of<Textbook>>(estimator);
  using Behind = UnknownSurface<Textbook>;
  return std::make_unique<Of<Behind>>(Behind(estimator, c.forgetting));
}

std::unique_ptr<Estimator> two_stage(const IdentifierConfig& c) {
  return for_unknown_surface(TwoStage(c.forgetting), c);
}
std::unique_ptr<Estimator> log_linear(const IdentifierConfig& c) {
  return for_unknown_surface(LogLinear(c.forgetting), c);
}
std::unique_ptr<Estimator> weighted_log_linear(const IdentifierConfig& c) {
  return for_unknown_surface(WeightedLogLinear(c.forgetting), c);
}
std::unique_ptr<Estimator> extended_kalman(const IdentifierConfig& c) {
  return for_unknown_surface(ExtendedKalman(c.forgetting), c);
}
std::unique_ptr<Estimator> kelvin_voigt(const IdentifierConfig& c) {
  if (c.surface_known) return std::make_unique<Of<KelvinVoigt>>(KelvinVoigt(c.forgetting));
  return std::make_unique<Of<ContactCurve>>(ContactCurve({1.0, c.forgetting, true}));
}

}  // namespace

std::string_view name_of(Method method) {
  switch (method) {
    case Method::kFixedExponent:
      return name_of(EstimatorKind::kFixedExponent);
    case Method::kTwoStage:
      return "two-stage";
    case Method::kLogLinear:
      return "log-linear";
    case Method::kKelvinVoigt:
      return "kelvin-voigt";
    case Method::kWeightedLogLinear:
      return "weighted-log-linear";
    case Method::kExtendedKalman:
      return "extended-kalman";
    case Method::kMaximumLikelihood:
      break;
  }
  return name_of(EstimatorKind::kMaximumLikelihood);
}

std::optional<Method> method_of(std::string_view name) {
  for (const Method method : kAllMethods)
    if (name_of(method) == name) return method;
  return {};
}

IdentifierConfig by(Method method, IdentifierConfig config) {
  switch (method) {
    case Method::kFixedExponent:
      config.kind = EstimatorKind::kFixedExponent;
      break;
    case Method::kTwoStage:
      config.make = two_stage;
      break;
    case Method::kLogLinear:
      config.make = log_linear;
      break;
    case Method::kKelvinVoigt:
      config.make = kelvin_voigt;
      break;
    case Method::kWeightedLogLinear:
      config.make = weighted_log_linear;
      break;
    case Method::kExtendedKalman:
      config.make = extended_kalman;
      break;
    case Method::kMaximumLikelihood:
      config.kind = EstimatorKind::kMaximumLikelihood;
  }
  return config;
}

}  // namespace longreach
