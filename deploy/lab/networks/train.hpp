#pragma once
// `longreach-lab train KIND`: creates the weights of trained networks, reproducibly.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace longreach {

/// Names of the kinds.
std::vector<std::string> train_kinds();

/// Trains and writes the file; one line of progress per network on standard error. Throws std::runtime_error.
/// The same seed gives the same bytes.
void train(const std::string& kind, std::uint64_t seed, const std::filesystem::path& out);

}  // namespace longreach
