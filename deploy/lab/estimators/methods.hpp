#pragma once
// The estimators that the laboratory compares: the slave's own two, and published ones in their best form.
// Their headers say what is published and what is added.

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

/// In the order of their numbers.
inline constexpr Method kAllMethods[] = {
    Method::kFixedExponent,     Method::kTwoStage,          Method::kLogLinear,     Method::kKelvinVoigt,
    Method::kMaximumLikelihood, Method::kWeightedLogLinear, Method::kExtendedKalman};

/// "maximum-likelihood" and so on.
std::string_view name_of(Method method);
/// Nothing for any other name.
std::optional<Method> method_of(std::string_view name);

/// `config` of this method.
IdentifierConfig by(Method method, IdentifierConfig config = {});

}  // namespace longreach
