#pragma once
// A file that only grows, in whole pieces: a piece that cannot be written, because the disk is full, is taken
// back, and nothing is written any more. What was appended is with the system: it outlives this program, if
// not the machine.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace longreach {

class RecordingFile {
 public:
  /// Makes the file. Throws RecordingError, also when there is one of this name: no recording is overwritten.
  explicit RecordingFile(const std::filesystem::path& path);
  ~RecordingFile();
  RecordingFile(const RecordingFile&) = delete;
  RecordingFile& operator=(const RecordingFile&) = delete;

  /// False: not written, error() says why.
  bool append(std::span<const std::byte> bytes);

  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] bool failed() const { return !error_.empty(); }
  [[nodiscard]] const std::string& error() const { return error_; }  // in words; empty: none
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  std::string error_;
};

}  // namespace longreach
