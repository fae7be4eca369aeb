#pragma once
// Suggestion for a mistyped name: the known name with the minimum edit distance (Levenshtein 1966), if it is
// small.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace longreach {

using Names = std::vector<std::string>;

/// Returns the nearest of `names`, if at most a third of the letters differ or if it is the only one that
/// continues `word` with "_" (a missing unit: "delay" for "delay_s"). Case is ignored.
std::optional<std::string> nearest_name(std::string_view word, const Names& names);

/// Returns "; did you mean "NAME"?" or an empty string.
std::string did_you_mean(std::string_view word, const Names& names);

/// Returns the alternatives: "; did you mean "NAME"? It has: a, b" or "; it has: a, b", with the lower-case
/// `lead` for "it has".
std::string instead_of(std::string_view word, const Names& names, const std::string& lead);

/// Returns "a, b, c"; "none" if there are no names.
std::string list_names(const Names& names);

/// Converts ASCII to lower case.
std::string lower_case(std::string_view text);

}  // namespace longreach
