#pragma once
// Concept for the structs that proto/structs.cpp writes from the schema. Each has a function
//
//   template <class Visitor, Is<T> S> void visit_fields(Visitor& visit, S& s)
//
// which calls the visitor with the name of each field in the schema and the member: a number, flag, string, enum, vector,
// struct, optional struct, or list of structs.

#include <concepts>
#include <type_traits>

namespace longreach {

/// Satisfied by T and const T: the same function visits for reading and for writing.
template <class S, class T>
concept Is = std::same_as<std::remove_const_t<S>, T>;

/// One more than the largest number of an enum of the schema.
template <class Enum>
inline constexpr int kCountOf = 0;

}  // namespace longreach
