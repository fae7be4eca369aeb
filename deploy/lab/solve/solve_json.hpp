#pragma once
// Parses the requests of `longreach-lab solve`. Unknown keys, non-finite numbers and arrays of the wrong
// shape are rejected.

#include <array>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

#include "common/spatial/spatial.hpp"

namespace longreach::solve_json {

using Json = nlohmann::json;

/// An invalid request. The message names the key.
class BadRequest : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Parses one line. Rejects anything other than an object, and duplicate keys.
Json parse(const std::string& line);

/// Rejects keys that are not in `known`. `where` is the name of the object, or "" for the request itself.
void require_known(const Json& object, std::string_view where, std::initializer_list<std::string_view> known);

const Json& member(const Json& object, const std::string& key);
const Json& object_member(const Json& object, const std::string& key);
double number(const Json& object, const std::string& key);
Vector3 vector3(const Json& object, const std::string& key);
Matrix3 matrix3(const Json& object, const std::string& key);      // array of rows
Quaternion rotation(const Json& object, const std::string& key);  // rejects matrices that are not rotations
std::string text(const Json& object, const std::string& key);

Json to_json(const Vector3& v);
Json to_json(const Matrix3& m);
/// Returns the two roots for each leg as a JSON array.
Json roots(const Vector3& first, const Vector3& second);

}  // namespace longreach::solve_json
