#pragma once
// Writes a CSV file of numbers with nine significant digits: a header line with column names that end with
// their units, and one row per call. All functions throw std::runtime_error if the file cannot be written.

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace longreach {

class Trace {
 public:
  /// Creates FOLDER/NAME.csv. If `folder` is an empty path, no file is written.
  Trace(const std::filesystem::path& folder, std::string_view name,
        const std::vector<std::string_view>& columns);

  void row(const std::vector<double>& values);
  /// Closes the file and throws if anything could not be written.
  void close();

 private:
  std::filesystem::path file_;
  std::ofstream stream_;
  std::size_t columns_;
  std::string line_;
};

}  // namespace longreach
