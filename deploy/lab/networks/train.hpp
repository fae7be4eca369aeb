#pragma once
// `longreach-lab train KIND`: trains networks reproducibly and writes their weights.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace longreach {

/// Returns the names of the kinds.
std::vector<std::string> train_kinds();

/// Trains the networks and writes the file. Prints one line of progress per network on standard error. The
/// same seed always gives the same file. Throws std::runtime_error.
void train(const std::string& kind, std::uint64_t seed, const std::filesystem::path& out);

}  // namespace longreach
