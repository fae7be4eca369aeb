#include "common/config/user_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "common/config/config.hpp"

namespace longreach {
namespace {

class OpenFile {
 public:
  explicit OpenFile(const std::filesystem::path& file)
      : number_(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC)) {}
  ~OpenFile() {
    if (number_ >= 0) (void)::close(number_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
};

std::string cannot_be_read(int error) {
  return error == ENOENT || error == ENOTDIR ? "there is no such file"
                                             : std::string("cannot be read: ") + std::strerror(error);
}

/// Why it is not read, or nothing.
std::string why_not(int descriptor, std::size_t max_bytes) {
  struct stat status {};
  if (descriptor < 0 || ::fstat(descriptor, &status) != 0) return cannot_be_read(errno);
  if (S_ISDIR(status.st_mode)) return "is a folder; name a file in it";
  if (!S_ISREG(status.st_mode)) return "is not a regular file";
  if (static_cast<std::size_t>(status.st_size) <= max_bytes) return "";
  const bool whole = max_bytes % (1U << 20U) == 0;
  return "is longer than " +
         (whole ? std::to_string(max_bytes >> 20U) + " MiB" : std::to_string(max_bytes) + " bytes");
}

}  // namespace

std::string read_user_file(const std::filesystem::path& file, std::size_t max_bytes) {
  const auto fail = [&file](const std::string& why) { throw ConfigError(file.string() + ": " + why); };
  const OpenFile descriptor(file);
  if (const std::string why = why_not(descriptor.number(), max_bytes); !why.empty()) fail(why);
  constexpr std::size_t kBlock = 1U << 16U;
  std::string text;
  // One byte more than is allowed: it may grow while it is read.
  while (text.size() <= max_bytes) {
    const std::size_t had = text.size(), room = std::min(kBlock, max_bytes + 1 - had);
    text.resize(had + room);
    const ssize_t got = ::read(descriptor.number(), text.data() + had, room);
    text.resize(had + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    if (got < 0 && errno != EINTR) fail(cannot_be_read(errno));
    if (got == 0) return text;
  }
  fail("grew beyond " + std::to_string(max_bytes) + " bytes while it was being read");
  return {};
}

}  // namespace longreach
