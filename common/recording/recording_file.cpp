#include "common/recording/recording_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "common/recording/recording_error.hpp"

namespace longreach {

RecordingFile::RecordingFile(const std::filesystem::path& path) : path_(path) {
  // A limit of the file's size is an error like a full disk, not the end of a program that moves a robot.
  std::signal(SIGXFSZ, SIG_IGN);
  descriptor_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (descriptor_ >= 0) return;
  const std::string why =
      errno == EEXIST ? "the file already exists; choose another name" : std::strerror(errno);
  throw RecordingError("cannot record into " + path.string() + ": " + why);
}

RecordingFile::~RecordingFile() { ::close(descriptor_); }

bool RecordingFile::append(std::span<const std::byte> bytes) {
  if (failed()) return false;
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ::ssize_t written = ::write(descriptor_, bytes.data() + done, bytes.size() - done);
    if (written > 0) {
      done += static_cast<std::size_t>(written);
    } else if (written == 0 || errno != EINTR) {
      error_ = written == 0 ? "nothing could be written" : std::strerror(errno);
      if (::ftruncate(descriptor_, static_cast<::off_t>(size_)) != 0)
        error_ += ", and the end of the file is damaged";
      return false;
    }
  }
  size_ += bytes.size();
  return true;
}

}  // namespace longreach
