#pragma once
// A CSV file of numbers: a header line of names that end with their unit, one row per call. Nine significant
// digits. Throws std::runtime_error if the file cannot be written.

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace longreach {

class Trace {
 public:
  /// With an empty folder nothing is written.
  Trace(const std::filesystem::path& folder, std::string_view name,
        const std::vector<std::string_view>& columns);

  void row(const std::vector<double>& values);
  /// Flushes; throws if anything could not be written.
  void close();

 private:
  std::filesystem::path file_;
  std::ofstream stream_;
  std::size_t columns_;
  std::string line_;
};

}  // namespace longreach
