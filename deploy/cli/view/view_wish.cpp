#include "deploy/cli/view/view_wish.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>

namespace longreach {
namespace {

using Json = nlohmann::json;
using Kind = ViewWish::Kind;

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

std::optional<ViewWish> read_aim(const Json& json) {
  ViewWish wish{Kind::kAim};
  if (!read_vector(json["aim"], *wish.aim.mutable_position_m())) return std::nullopt;
  if (json.contains("turn") && !read_vector(json["turn"], *wish.aim.mutable_rotation_rad()))
    return std::nullopt;
  wish.aim.set_clutch(read_flag(json, "clutch"));
  wish.aim.set_grip(read_flag(json, "grip"));
  return wish;
}

std::optional<ViewWish> read_word(const std::string& name, const std::string& word) {
  ViewWish wish;
  if (name == "do" && (word == "engage" || word == "stop")) {
    wish.kind = word == "stop" ? Kind::kStop : Kind::kEngage;
  } else if (name == "mode" && (word == "rate" || word == "position")) {
    wish.kind = Kind::kMode;
    wish.mode = word == "rate" ? proto::Mapping::RATE : proto::Mapping::POSITION;
  } else if (name == "link" && is_name(word)) {
    wish.kind = Kind::kLink;
    wish.link = word;
  } else {
    return std::nullopt;
  }
  return wish;
}

}  // namespace

std::optional<ViewWish> read_wish(std::string_view text) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object() || json.empty()) return std::nullopt;
  if (json.contains("aim")) return read_aim(json);
  if (json.size() != 1) return std::nullopt;
  const std::string& name = json.begin().key();
  const Json& value = json.begin().value();
  if (name == "take" && value.is_boolean()) return ViewWish{value.get<bool>() ? Kind::kTake : Kind::kGive};
  if (name == "scale" && value.is_number()) {
    ViewWish wish{Kind::kScale};
    wish.scale = value.get<double>();
    return wish;
  }
  if (value.is_string()) return read_word(name, value.get<std::string>());
  return std::nullopt;
}

}  // namespace longreach
