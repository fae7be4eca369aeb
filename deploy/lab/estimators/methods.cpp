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
std::unique_ptr<Estimator> of(const IdentifierConfig& c) {
  const Textbook estimator(c.forgetting);
  if (c.surface_known) return std::make_unique<Of<Textbook>>(estimator);
  using Behind = UnknownSurface<Textbook>;
  return std::make_unique<Of<Behind>>(Behind(estimator, c.forgetting));
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

std::unique_ptr<Estimator> brought(Method method, const IdentifierConfig& config) {
  switch (method) {
    case Method::kTwoStage:
      return of<TwoStage>(config);
    case Method::kLogLinear:
      return of<LogLinear>(config);
    case Method::kKelvinVoigt:
      return of<KelvinVoigt>(config);
    case Method::kWeightedLogLinear:
      return of<WeightedLogLinear>(config);
    case Method::kExtendedKalman:
      return of<ExtendedKalman>(config);
    case Method::kFixedExponent:
    case Method::kMaximumLikelihood:
      break;
  }
  return nullptr;
}

IdentifierConfig with_kind(Method method, IdentifierConfig config) {
  config.kind =
      method == Method::kFixedExponent ? EstimatorKind::kFixedExponent : EstimatorKind::kMaximumLikelihood;
  return config;
}

}  // namespace longreach
