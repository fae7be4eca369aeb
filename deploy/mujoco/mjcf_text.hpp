#pragma once
// Changes an MJCF file in memory.

#include <tinyxml2.h>

#include <string>

#include "common/text/number_text.hpp"

namespace longreach {

/// Returns the numbers, separated by spaces.
template <class Numbers>
std::string list_of(const Numbers& numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : " ") + format_number(number);
  return text;
}

/// Reads a file, and replaces each <include> by the contents of the file that it names. Throws std::invalid_argument
/// "FILE: reason" if a file is not XML.
void read_mjcf(const std::string& file, tinyxml2::XMLDocument& out);

/// Appends to the lists of positions and speeds of each key frame.
void continue_keys(tinyxml2::XMLElement& root, const std::string& positions, const std::string& speeds);

/// Returns the text of a document.
std::string text_of(const tinyxml2::XMLDocument& document);

}  // namespace longreach
