#pragma once
// Reading of the requests of `longreach-lab solve`: every key is known, every number finite, every shape
// right.

#include <array>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

#include "common/spatial/spatial.hpp"

namespace longreach::solve_json {

using Json = nlohmann::json;

/// A request that cannot be answered; the text names the key.
class BadRequest : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Parses one line. Refuses what is not an object and keys that occur twice.
Json parse(const std::string& line);

/// Refuses keys that are not among `known`. `where`: name of the object, "" for the request.
void require_known(const Json& object, std::string_view where, std::initializer_list<std::string_view> known);

const Json& member(const Json& object, const std::string& key);
const Json& object_member(const Json& object, const std::string& key);
double number(const Json& object, const std::string& key);
Vector3 vector3(const Json& object, const std::string& key);
Matrix3 matrix3(const Json& object, const std::string& key);      // rows
Quaternion rotation(const Json& object, const std::string& key);  // refuses what is not a rotation
std::string text(const Json& object, const std::string& key);

Json to_json(const Vector3& v);
Json to_json(const Matrix3& m);
/// Two roots a leg.
Json roots(const Vector3& first, const Vector3& second);

}  // namespace longreach::solve_json
