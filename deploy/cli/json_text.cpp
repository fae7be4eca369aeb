#include "deploy/cli/json_text.hpp"

#include <google/protobuf/util/json_util.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <stdexcept>

#include "common/text/number_text.hpp"
#include "common/text/utf8.hpp"

namespace longreach {
namespace {

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
std::string age_json(const SideReport& report) {
  return report.status ? format_number(report.age_s) : "null";
}

}  // namespace

std::string json_string(std::string_view text) {
  std::string json = "\"";
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
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
  if (!status.ok())
    throw std::runtime_error("the response cannot be converted to JSON: " + status.ToString());
  return json;
}

std::string status_json(const BothReports& reports) {
  std::string error;
  for (const SideReport* report : {&reports.master, &reports.slave})
    if (!report->status) error += (error.empty() ? "" : "; ") + report->error;
  return "{\"master\":" + side_json(reports.master) + ",\"slave\":" + side_json(reports.slave) +
         ",\"age_s\":{\"master\":" + age_json(reports.master) + ",\"slave\":" + age_json(reports.slave) +
         "}" + (error.empty() ? "" : ",\"error\":" + json_string(error)) + "}";
}

}  // namespace longreach
