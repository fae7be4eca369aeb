#pragma once
// The estimators that the laboratory compares: the two estimators of the slave, and published estimators in
// their best form. Their headers state which parts are published and which were added.

#include <optional>
#include <string_view>

#include "slave/estimation/identifier.hpp"

namespace longreach {

enum class Method : std::uint8_t {
  kFixedExponent,
  kTwoStage,
  kLogLinear,
  kKelvinVoigt,
  kMaximumLikelihood,
  kWeightedLogLinear,
  kExtendedKalman
};

/// All methods in the order of their enumerators.
inline constexpr Method kAllMethods[] = {
    Method::kFixedExponent,     Method::kTwoStage,          Method::kLogLinear,     Method::kKelvinVoigt,
    Method::kMaximumLikelihood, Method::kWeightedLogLinear, Method::kExtendedKalman};

/// Returns the name of a method, for example "maximum-likelihood".
std::string_view name_of(Method method);
/// Returns the method with this name, or std::nullopt if there is none.
std::optional<Method> method_of(std::string_view name);

/// Returns a copy of `config` with the kind of this method, if it is one of the slave's two.
IdentifierConfig with_kind(Method method, IdentifierConfig config);
/// Returns the laboratory's own estimator of this method; nullptr for the two of the slave.
std::unique_ptr<Estimator> brought(Method method, const IdentifierConfig& config);

/// Returns an identifier (Identifier or WatchedIdentifier) that uses this method.
template <class Any = Identifier>
Any by(Method method, const IdentifierConfig& config = {}) {
  return Any(with_kind(method, config), brought(method, config));
}

}  // namespace longreach
