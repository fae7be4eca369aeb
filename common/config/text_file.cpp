// Configuration from protobuf text files.

#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/text_format.h>

#include <algorithm>
#include <memory>
#include <string_view>

#include "common/config/config.hpp"
#include "common/config/parse_error.hpp"
#include "common/config/text_place.hpp"
#include "common/config/user_file.hpp"
#include "common/config/violation.hpp"
#include "common/text/utf8.hpp"

namespace longreach {
namespace {

using google::protobuf::Message;
using google::protobuf::TextFormat;
namespace fs = std::filesystem;

// Keeps the first error; what follows it is mostly its consequence.
class FirstError : public google::protobuf::io::ErrorCollector {
 public:
  void AddError(int line, int column, const std::string& message) override {
    if (!error) error = ParseError{{std::max(line, 0), std::max(column, 0)}, message};
  }
  void AddWarning(int, int, const std::string&) override {}
  std::optional<ParseError> error;
};

std::string place(const std::string& name, TextPosition position) {
  return name + ":" + std::to_string(position.line + 1) + ":" + std::to_string(position.column + 1);
}

[[noreturn]] void fail(const std::string& name, TextPosition position, const std::string& text) {
  throw ConfigError(place(name, position) + ": " + text);
}

// Where the field stands in the text, or the nearest thing around it that does.
TextPosition locate(const TextFormat::ParseInfoTree& root, const FieldPath& path) {
  TextPosition position;
  const TextFormat::ParseInfoTree* tree = &root;
  for (const PathStep& step : path) {
    // Of a list in brackets only the beginning is known, as its element 0.
    const int last = step.field->is_repeated() ? std::max(step.index, 0) : -1;
    for (int i = last; i >= (last < 0 ? -1 : 0); --i) {
      const auto location = tree->GetLocation(step.field, i);
      if (location.line < 0) continue;
      position = {location.line, location.column};
      break;
    }
    if (holds_messages(*step.field)) tree = tree->GetTreeForNested(step.field, last);
    if (tree == nullptr) break;
  }
  return position;
}

}  // namespace

std::string place_in_file(const fs::path& file, const Message& message, const FieldPath& path) {
  const std::unique_ptr<Message> again(message.New());
  TextFormat::Parser parser;
  TextFormat::ParseInfoTree locations;
  FirstError ignored;
  parser.RecordErrorsTo(&ignored);
  parser.WriteLocationsTo(&locations);
  try {
    if (!parser.ParseFromString(read_user_file(file), again.get())) return file.string();
  } catch (const ConfigError&) {
    return file.string();
  }
  return place(file.string(), locate(locations, path));
}

void load_text_file(const fs::path& file, Message& message) {
  load_text(file.string(), read_user_file(file), message);
}

void load_text(const std::string& name, const std::string& whole, Message& message) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  const std::string text = whole.starts_with(kByteOrderMark) ? whole.substr(kByteOrderMark.size()) : whole;
  if (is_utf16(text)) throw ConfigError(name + ": the file is in UTF-16; save it in UTF-8");
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
    throw ConfigError(name +
                      ": the file is empty; a file that uses only defaults must contain at least a "
                      "comment");
  const std::unique_ptr<Message> loaded(message.New());
  TextFormat::Parser parser;
  TextFormat::ParseInfoTree locations;
  FirstError first;
  parser.RecordErrorsTo(&first);
  parser.WriteLocationsTo(&locations);
  const bool parsed = parser.ParseFromString(text, loaded.get());
  if (first.error) {
    const ParseError error = reword(*first.error, text, *message.GetDescriptor());
    fail(name, error.position, error.text);
  }
  if (!parsed) throw ConfigError(name + ": the file is not in protobuf text format");
  if (const auto violation = find_any_violation(*loaded)) {
    fail(name, locate(locations, violation->path), sentence(*loaded, *violation));
  }
  message.GetReflection()->Swap(&message, loaded.get());
}

}  // namespace longreach
