#pragma once
// Which struct a list of fields belongs to, read (const) or written.

#include <concepts>
#include <type_traits>

namespace longreach {

/// T, const or not.
template <class S, class T>
concept Is = std::same_as<std::remove_const_t<S>, T>;

}  // namespace longreach
