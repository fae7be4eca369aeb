#pragma once
// Files that a user named: configuration, robots, scenes, MJCF, meshes, devices. A FIFO would wait for
// whoever writes into it and a device has no end, so only regular files of a bounded size are read; that is
// looked at on the open descriptor.

#include <cstddef>
#include <filesystem>
#include <string>

namespace longreach {

inline constexpr std::size_t kUserFileMaxBytes = std::size_t{64} << 20U;

/// The whole file. Throws ConfigError "FILE: ..." with the reason.
std::string read_user_file(const std::filesystem::path& file, std::size_t max_bytes = kUserFileMaxBytes);

}  // namespace longreach
