#include "deploy/cli/paint.hpp"

#include <algorithm>
#include <array>

namespace longreach {
namespace {

struct Tone {
  std::string_view words, code;
};
constexpr auto kTones = std::to_array<Tone>({{"Engaged", "32"},
                                             {"Holding", "33"},
                                             {"Stopped", "31"},
                                             {"Fault", "31"},
                                             {"does not respond", "31"},
                                             {"clamped", "33"},
                                             {" reports: ", "33"}});

std::string in_code(std::string_view code, std::string_view text) {
  return "\x1b[" + std::string(code) + "m" + std::string(text) + "\x1b[0m";
}

}  // namespace

std::string painted(std::string_view row) {
  std::string out;
  // The label ends where the columns begin.
  const std::size_t label = row.starts_with(' ') ? std::string_view::npos : row.find("  ");
  if (label != std::string_view::npos) {
    out = in_code("2", row.substr(0, label));
    row.remove_prefix(label);
  }
  while (!row.empty()) {
    std::size_t at = std::string_view::npos;
    const Tone* first = nullptr;
    for (const Tone& tone : kTones) {
      const std::size_t found = row.find(tone.words);
      if (found < at) {
        at = found;
        first = &tone;
      }
    }
    out += row.substr(0, at);
    if (first == nullptr) break;
    out += in_code(first->code, first->words);
    row.remove_prefix(at + first->words.size());
  }
  return out;
}

}  // namespace longreach
