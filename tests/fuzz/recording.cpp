// Any bytes as a recording: refused with a readable error, or read to its end. A damaged chunk costs only its own
// messages.

#include <sys/mman.h>
#include <unistd.h>

#include "common/recording/mcap_reader.hpp"
#include "common/recording/recording_error.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace {

/// A file in memory with these bytes.
class MemoryFile {
 public:
  MemoryFile(const std::uint8_t* bytes, std::size_t size)
      : descriptor_(::memfd_create("recording", MFD_CLOEXEC)) {
    longreach::fuzz::require(
        descriptor_ >= 0 && ::write(descriptor_, bytes, size) == static_cast<ssize_t>(size),
        "memory for a file");
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace longreach;
  const MemoryFile file(bytes, size);
  std::size_t taken = 0;
  try {
    McapReader reader(file.path());
    while (const auto message = reader.next()) {
      fuzz::require(message->channel != nullptr, "a message has a channel");
      ++taken;
    }
    fuzz::require(reader.lost().empty() || taken > 0,
                  "a file without any message is refused if it is damaged");
    for (const LostChunk& lost : reader.lost()) fuzz::require(!lost.why.empty(), "a loss has a reason");
    const std::string sentence = lost_sentence(reader.lost(), 0);
    fuzz::require(sentence.empty() == reader.lost().empty(), "a loss is named");
    (void)mcap_figures(file.path());
  } catch (const RecordingError& error) {
    fuzz::require(std::string_view(error.what()).find(file.path()) != std::string_view::npos,
                  "an error names the file");
  }
  return 0;
}
