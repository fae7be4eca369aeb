#pragma once
// `longreach-lab train KIND`: trains networks and writes their weights, reproducibly.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace longreach {

/// Returns the names of the kinds.
std::vector<std::string> train_kinds();

/// Trains and writes the file, with one line of progress per network on standard error. The same seed gives
/// the same bytes. Throws std::runtime_error.
void train(const std::string& kind, std::uint64_t seed, const std::filesystem::path& out);

}  // namespace longreach
