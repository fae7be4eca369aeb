#include "deploy/cli/view/page_command.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>

namespace longreach {
namespace {

using Json = nlohmann::json;
using Kind = PageCommand::Kind;

constexpr std::size_t kNameMax = 64;

bool is_name(const std::string& word) {
  return !word.empty() && word.size() <= kNameMax &&
         std::all_of(word.begin(), word.end(),
                     [](unsigned char c) { return std::isalnum(c) != 0 || c == '-' || c == '_'; });
}

template <class Field>
bool read_vector(const Json& json, Field& out) {
  if (!json.is_array() || json.size() != 3) return false;
  for (const Json& number : json) {
    if (!number.is_number() || !std::isfinite(number.get<double>())) return false;
    out.Add(number.get<double>());
  }
  return true;
}

bool read_flag(const Json& json, const char* name) {
  const auto found = json.find(name);
  return found != json.end() && found->is_boolean() && found->get<bool>();
}

std::optional<PageCommand> read_aim(const Json& json) {
  PageCommand page_command{Kind::kAim};
  if (!read_vector(json["aim"], *page_command.aim.mutable_position_m())) return std::nullopt;
  if (json.contains("turn") && !read_vector(json["turn"], *page_command.aim.mutable_rotation_rad()))
    return std::nullopt;
  page_command.aim.set_clutch(read_flag(json, "clutch"));
  page_command.aim.set_grip(read_flag(json, "grip"));
  return page_command;
}

std::optional<PageCommand> read_word(const std::string& name, const std::string& word) {
  PageCommand page_command;
  if (name == "do" && (word == "engage" || word == "stop")) {
    page_command.kind = word == "stop" ? Kind::kStop : Kind::kEngage;
  } else if (name == "mode" && (word == "rate" || word == "position")) {
    page_command.kind = Kind::kMode;
    page_command.mode = word == "rate" ? proto::RATE : proto::POSITION;
  } else if (name == "link" && is_name(word)) {
    page_command.kind = Kind::kLink;
    page_command.link = word;
  } else {
    return std::nullopt;
  }
  return page_command;
}

}  // namespace

std::optional<PageCommand> read_page_command(std::string_view text) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object() || json.empty()) return std::nullopt;
  if (json.contains("aim")) return read_aim(json);
  if (json.size() != 1) return std::nullopt;
  const std::string& name = json.begin().key();
  const Json& value = json.begin().value();
  if (name == "take" && value.is_boolean()) return PageCommand{value.get<bool>() ? Kind::kTake : Kind::kGive};
  if ((name == "scale" || name == "kv") && value.is_number()) {
    PageCommand page_command{name == "kv" ? Kind::kKv : Kind::kScale};
    page_command.value = value.get<double>();
    return page_command;
  }
  if (value.is_string()) return read_word(name, value.get<std::string>());
  return std::nullopt;
}

}  // namespace longreach
