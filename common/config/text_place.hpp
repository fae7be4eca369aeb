#pragma once
// Where in a text file a field stands, for what is found wrong with it after it has been loaded.

#include <filesystem>
#include <string>

#include "common/config/field_path.hpp"

namespace longreach {

/// "FILE:LINE:COLUMN" of a field of the file's message, or of the nearest thing around it; "FILE" when the
/// file cannot be read again.
std::string place_in_file(const std::filesystem::path& file, const google::protobuf::Message& message,
                          const FieldPath& path);

}  // namespace longreach
