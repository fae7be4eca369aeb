#pragma once
// Suggests a correction for a mistyped name: the known name with the smallest edit distance (Levenshtein
// 1966), if that distance is small enough.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace longreach {

using Names = std::vector<std::string>;

/// Returns the nearest of `names` if at most a third of its letters differ, or if it is the only name that
/// continues `word` with "_" (the unit is missing, as in "delay" for "delay_s"). Ignores case.
std::optional<std::string> nearest_name(std::string_view word, const Names& names);

/// Returns "; did you mean "NAME"?" or an empty string.
std::string did_you_mean(std::string_view word, const Names& names);

/// Returns the end of an error message: did_you_mean(), then `lead` (in lower case, e.g. "it has") and the
/// list of names.
std::string instead_of(std::string_view word, const Names& names, const std::string& lead);

/// Returns the names as "a, b, c", or "none" if there are none.
std::string list_names(const Names& names);

/// Converts ASCII to lower case.
std::string lower_case(std::string_view text);

}  // namespace longreach
