#pragma once
// Parser of the requests of `longreach-lab solve`: rejects unknown keys, non-finite numbers and wrong shapes.

#include <array>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

#include "common/spatial/spatial.hpp"

namespace longreach::solve_json {

using Json = nlohmann::json;

/// An invalid request; the text names the key.
class BadRequest : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Parses one line. Refuses anything but an object, and duplicate keys.
Json parse(const std::string& line);

/// Refuses keys that are not in `known`. `where`: name of the object, "" for the request.
void require_known(const Json& object, std::string_view where, std::initializer_list<std::string_view> known);

const Json& member(const Json& object, const std::string& key);
const Json& object_member(const Json& object, const std::string& key);
double number(const Json& object, const std::string& key);
Vector3 vector3(const Json& object, const std::string& key);
Matrix3 matrix3(const Json& object, const std::string& key);      // rows
Quaternion rotation(const Json& object, const std::string& key);  // refuses anything but a rotation
std::string text(const Json& object, const std::string& key);

Json to_json(const Vector3& v);
Json to_json(const Matrix3& m);
/// Two roots per leg.
Json roots(const Vector3& first, const Vector3& second);

}  // namespace longreach::solve_json
