#include "common/text/nearest_name.hpp"

#include <algorithm>
#include <numeric>

namespace longreach {
namespace {

// One row of the distance table at a time.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

std::optional<std::string> nearest_name(std::string_view word, const Names& names) {
  // Longer than any name: nothing can be near, and the table stays small.
  if (word.empty() || word.size() > 100) return std::nullopt;
  const std::string wanted = lower_case(word);
  const auto continues = [&](const std::string& name) { return lower_case(name).starts_with(wanted + "_"); };
  if (std::ranges::count_if(names, continues) == 1) return *std::ranges::find_if(names, continues);

  std::optional<std::string> nearest;
  std::size_t least = 0;
  for (const std::string& name : names) {
    const std::size_t distance = edit_distance(wanted, lower_case(name));
    const std::size_t allowed = std::max<std::size_t>(1, std::max(word.size(), name.size()) / 3);
    if (distance >= std::min(word.size(), name.size()) || distance > allowed) continue;
    if (nearest && distance >= least) continue;
    nearest = name;
    least = distance;
  }
  return nearest;
}

std::string did_you_mean(std::string_view word, const Names& names) {
  const auto nearest = nearest_name(word, names);
  return nearest ? "; did you mean \"" + *nearest + "\"?" : "";
}

std::string instead_of(std::string_view word, const Names& names, const std::string& lead) {
  const std::string meant = did_you_mean(word, names);
  if (meant.empty()) return "; " + lead + ": " + list_names(names);
  std::string begin = lead;
  begin.front() = static_cast<char>(begin.front() - 'a' + 'A');
  return meant + " " + begin + ": " + list_names(names);
}

std::string list_names(const Names& names) {
  if (names.empty()) return "none";
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

}  // namespace longreach
