#pragma once
// Concept for the structs in the field lists of struct_fields.hpp, which are visited for reading (const) or
// writing.

#include <concepts>
#include <type_traits>

namespace longreach {

/// Satisfied by T and const T.
template <class S, class T>
concept Is = std::same_as<std::remove_const_t<S>, T>;

}  // namespace longreach
