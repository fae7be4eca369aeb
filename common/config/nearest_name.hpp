#pragma once
// What a mistyped name was meant to be: the known name of the least edit distance (Levenshtein 1966), if it
// is near.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace longreach {

using Names = std::vector<std::string>;

/// The nearest of `names`, when at most a third of the letters differ or when it is the only one that
/// continues `word` with "_" (a forgotten unit: "delay" for "delay_s"). Letters compare without case.
std::optional<std::string> nearest_name(std::string_view word, const Names& names);

/// "; did you mean "NAME"?" or nothing.
std::string did_you_mean(std::string_view word, const Names& names);

/// What to write instead: "; did you mean "NAME"? It has: a, b" or "; it has: a, b", with the lower-case
/// `lead` for "it has".
std::string instead_of(std::string_view word, const Names& names, const std::string& lead);

/// "a, b, c"; "none" for no names.
std::string list_names(const Names& names);

/// ASCII lower case.
std::string lower_case(std::string_view text);

}  // namespace longreach
