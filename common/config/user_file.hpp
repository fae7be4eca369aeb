#pragma once
// Reads files that a user names: configuration, robots, scenes, MJCF, meshes, devices. Only regular files of
// limited size are read, because reading a FIFO could block forever, and a device may have no end. The type
// is checked after opening, so the file cannot be swapped after the check.

#include <cstddef>
#include <filesystem>
#include <string>

namespace longreach {

inline constexpr std::size_t kUserFileMaxBytes = std::size_t{64} << 20U;

/// Returns the content of the whole file. Throws ConfigError "FILE: ..." with the reason.
std::string read_user_file(const std::filesystem::path& file, std::size_t max_bytes = kUserFileMaxBytes);

}  // namespace longreach
