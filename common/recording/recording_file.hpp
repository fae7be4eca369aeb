#pragma once
// An append-only file to which data is written in complete pieces. If a piece cannot be written completely, for
// example because the disk is full, the partial piece is removed, and nothing more is written. Appended data is
// passed to the operating system immediately, so it survives a crash of this program, but not of the machine.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace longreach {

class RecordingFile {
 public:
  /// Creates the file. Creates the file. Throws RecordingError if that fails or the file already exists, so
  /// that no recording is overwritten.
  explicit RecordingFile(const std::filesystem::path& path);
  ~RecordingFile();
  RecordingFile(const RecordingFile&) = delete;
  RecordingFile& operator=(const RecordingFile&) = delete;

  /// Returns false if the bytes were not written; error() then returns the reason.
  bool append(std::span<const std::byte> bytes);

  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] bool failed() const { return !error_.empty(); }
  /// Returns the reason for the failure; empty if there was none.
  [[nodiscard]] const std::string& error() const { return error_; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  std::string error_;
};

}  // namespace longreach
