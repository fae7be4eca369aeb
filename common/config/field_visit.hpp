#pragma once
// Struct of a list of fields, for reading (const) or writing.

#include <concepts>
#include <type_traits>

namespace longreach {

/// T, const or not.
template <class S, class T>
concept Is = std::same_as<std::remove_const_t<S>, T>;

}  // namespace longreach
