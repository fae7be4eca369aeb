#pragma once
// A file that only grows, in complete pieces: a piece that cannot be written, because the disk is full, is
// removed again, and nothing is written after that. Appended data has been passed to the system: it survives
// the end of this program, but not a crash of the machine.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace longreach {

class RecordingFile {
 public:
  /// Creates the file. Throws RecordingError, also if the file exists: no recording is overwritten.
  explicit RecordingFile(const std::filesystem::path& path);
  ~RecordingFile();
  RecordingFile(const RecordingFile&) = delete;
  RecordingFile& operator=(const RecordingFile&) = delete;

  /// Returns false if it was not written; error() gives the reason.
  bool append(std::span<const std::byte> bytes);

  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] bool failed() const { return !error_.empty(); }
  [[nodiscard]] const std::string& error() const { return error_; }  // reason of the failure; empty: none
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  std::string error_;
};

}  // namespace longreach
