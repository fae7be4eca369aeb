#include "deploy/lab/solve/solve_json.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <vector>

namespace longreach::solve_json {
namespace {

double finite(const Json& value, const std::string& name) {
  if (!value.is_number()) throw BadRequest("\"" + name + "\" must be a number");
  const double x = value.get<double>();
  if (!std::isfinite(x)) throw BadRequest("\"" + name + "\" is not a finite number");
  return x;
}

std::string rounded(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2g", value);
  return text.data();
}

Vector3 three(const Json& value, const std::string& name) {
  if (!value.is_array() || value.size() != 3)
    throw BadRequest("\"" + name + "\" must be a list of three numbers");
  return {finite(value[0], name), finite(value[1], name), finite(value[2], name)};
}

}  // namespace

Json parse(const std::string& line) {
  std::vector<std::set<std::string>> open;  // keys of the objects that are being read
  std::string twice;
  const auto watch = [&](int, Json::parse_event_t event, Json& value) {
    if (event == Json::parse_event_t::object_start) open.emplace_back();
    if (event == Json::parse_event_t::object_end && !open.empty()) open.pop_back();
    if (event == Json::parse_event_t::key && !open.back().insert(value.get<std::string>()).second)
      twice = value.get<std::string>();
    return true;
  };
  Json request;
  try {
    request = Json::parse(line, watch);
  } catch (const Json::out_of_range&) {
    throw BadRequest("a number is not finite");
  } catch (const Json::parse_error& e) {
    const bool literal =
        e.byte > 0 && e.byte <= line.size() && line.find_first_of("NI", e.byte - 1) <= e.byte;
    throw BadRequest("invalid JSON at byte " + std::to_string(e.byte) +
                     (literal ? ": NaN and Infinity are not allowed" : ""));
  }
  if (!request.is_object()) throw BadRequest("each line must be one JSON object");
  if (!twice.empty()) throw BadRequest("key \"" + twice + "\" is given twice");
  return request;
}

void require_known(const Json& object, std::string_view where,
                   std::initializer_list<std::string_view> known) {
  for (const auto& item : object.items()) {
    if (std::find(known.begin(), known.end(), item.key()) != known.end()) continue;
    throw BadRequest("unknown key \"" + item.key() + "\"" +
                     (where.empty() ? "" : " in \"" + std::string(where) + "\""));
  }
}

const Json& member(const Json& object, const std::string& key) {
  const auto found = object.find(key);
  if (found == object.end()) throw BadRequest("key \"" + key + "\" is missing");
  return *found;
}

const Json& object_member(const Json& object, const std::string& key) {
  const Json& value = member(object, key);
  if (!value.is_object()) throw BadRequest("\"" + key + "\" must be an object");
  return value;
}

double number(const Json& object, const std::string& key) { return finite(member(object, key), key); }

Vector3 vector3(const Json& object, const std::string& key) { return three(member(object, key), key); }

Matrix3 matrix3(const Json& object, const std::string& key) {
  const Json& value = member(object, key);
  if (!value.is_array() || value.size() != 3)
    throw BadRequest("\"" + key + "\" must be a list of three rows");
  Matrix3 m;
  for (std::size_t i = 0; i < 3; ++i) m.row(static_cast<Eigen::Index>(i)) = three(value[i], key);
  return m;
}

Quaternion rotation(const Json& object, const std::string& key) {
  constexpr double kGiven = 1e-6;  // tolerance for unit length and orthogonality of the rows
  const Matrix3 R = matrix3(object, key);
  const double off = (R * R.transpose() - Matrix3::Identity()).cwiseAbs().maxCoeff();
  if (!(off <= kGiven))
    throw BadRequest("\"" + key + "\" is not a rotation matrix: R R^T differs from the identity by " +
                     rounded(off) + ", but only " + rounded(kGiven) + " is allowed; give more digits");
  if (R.determinant() < 0.0)
    throw BadRequest("\"" + key + "\" is not a rotation matrix but a reflection: its determinant is -1");
  return Quaternion(R).normalized();
}

std::string text(const Json& object, const std::string& key) {
  const Json& value = member(object, key);
  if (!value.is_string()) throw BadRequest("\"" + key + "\" must be a string");
  return value.get<std::string>();
}

Json to_json(const Vector3& v) { return Json::array({v.x(), v.y(), v.z()}); }

Json to_json(const Matrix3& m) {
  return Json::array({to_json(Vector3(m.row(0))), to_json(Vector3(m.row(1))), to_json(Vector3(m.row(2)))});
}

Json roots(const Vector3& first, const Vector3& second) {
  Json legs = Json::array();
  for (int i = 0; i < 3; ++i) legs.push_back(Json::array({first[i], second[i]}));
  return legs;
}

}  // namespace longreach::solve_json
