#pragma once
// Finds the position of a field in a text file, for errors that are detected after the file was loaded.

#include <filesystem>
#include <string>

#include "common/config/field_path.hpp"

namespace longreach {

/// Returns "FILE:LINE:COLUMN" for a field of the message in the file, or for the nearest enclosing field if
/// the file does not set it. Returns "FILE" if the file can no longer be read.
std::string place_in_file(const std::filesystem::path& file, const google::protobuf::Message& message,
                          const FieldPath& path);

}  // namespace longreach
