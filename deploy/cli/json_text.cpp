#include "deploy/cli/json_text.hpp"

#include <google/protobuf/util/json_util.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <stdexcept>

namespace longreach {
namespace {

/// Length of the well-formed UTF-8 character at the front (RFC 3629); 0 if there is none.
std::size_t character_length(std::string_view text) {
  const auto byte = [text](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint8_t first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xC2 && first < 0xE0   ? 2
                             : first >= 0xE0 && first < 0xF0 ? 3
                             : first >= 0xF0 && first < 0xF5 ? 4
                                                             : 0;
  if (length == 0 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xC0U) != 0x80U) return 0;
  // Longer than needed, surrogates, beyond U+10FFFF.
  const std::uint8_t second = byte(1);
  if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) ||
      (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F))
    return 0;
  return length;
}

std::string escaped(char c) {
  switch (c) {
    case '"':
      return "\\\"";
    case '\\':
      return "\\\\";
    case '\n':
      return "\\n";
    case '\t':
      return "\\t";
    default:
      break;
  }
  if (static_cast<std::uint8_t>(c) >= 0x20) return std::string(1, c);
  std::array<char, 8> code{};
  std::snprintf(code.data(), code.size(), "\\u%04x", static_cast<unsigned>(static_cast<std::uint8_t>(c)));
  return code.data();
}

std::string side_json(const SideReport& report) {
  return report.status ? json_object(*report.status) : "null";
}

}  // namespace

std::string json_string(std::string_view text) {
  std::string json = "\"";
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    if (length == 0) json += "\\ufffd";
    if (length == 1) json += escaped(text.front());
    if (length > 1) json += text.substr(0, length);
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return json + "\"";
}

std::string json_object(const google::protobuf::Message& message) {
  google::protobuf::util::JsonPrintOptions options;
  options.preserve_proto_field_names = true;
  options.always_print_primitive_fields = true;
  std::string json;
  const auto status = google::protobuf::util::MessageToJsonString(message, &json, options);
  if (!status.ok()) throw std::runtime_error("the answer cannot be written as JSON: " + status.ToString());
  return json;
}

std::string status_json(const BothReports& reports) {
  std::string error;
  for (const SideReport* report : {&reports.master, &reports.slave})
    if (!report->status) error += (error.empty() ? "" : "; ") + report->error;
  return "{\"master\":" + side_json(reports.master) + ",\"slave\":" + side_json(reports.slave) +
         (error.empty() ? "" : ",\"error\":" + json_string(error)) + "}";
}

}  // namespace longreach
