#pragma once
// The estimators that the laboratory compares: the two of the slave, and published ones in their best form.
// Their headers state which parts are published and which are added.

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

/// Ordered by number.
inline constexpr Method kAllMethods[] = {
    Method::kFixedExponent,     Method::kTwoStage,          Method::kLogLinear,     Method::kKelvinVoigt,
    Method::kMaximumLikelihood, Method::kWeightedLogLinear, Method::kExtendedKalman};

/// "maximum-likelihood" and so on.
std::string_view name_of(Method method);
/// Returns none for any other name.
std::optional<Method> method_of(std::string_view name);

/// Returns `config` for this method.
IdentifierConfig by(Method method, IdentifierConfig config = {});

}  // namespace longreach
