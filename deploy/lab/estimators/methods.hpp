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

/// Returns a copy of `config` that selects this method.
IdentifierConfig by(Method method, IdentifierConfig config = {});

}  // namespace longreach
