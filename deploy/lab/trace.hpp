#pragma once
// A CSV file of numbers: one header line of names that end in their unit, one row a call. Nine significant
// digits. Throws std::runtime_error when the file cannot be written.

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace longreach {

class Trace {
 public:
  /// An empty folder: rows go nowhere.
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
