#pragma once
// Reads numbers and strings from the content of an MCAP record, with bounds checks.

#include <cstdint>
#include <string>
#include <string_view>

#include "common/recording/byte_buffer.hpp"
#include "common/recording/recording_error.hpp"

namespace longreach {

class McapCursor {
 public:
  explicit McapCursor(std::string_view content) : left_(content) {}

  template <class Integer>
  Integer take() {
    const std::string_view bytes = take_bytes(sizeof(Integer));
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < sizeof(Integer); ++i)
      value |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[i])) << (8 * i);
    return static_cast<Integer>(value);
  }
  std::string_view take_text() { return take_bytes(take<std::uint32_t>()); }
  std::string_view take_bytes(std::uint64_t size) {
    if (size > left_.size()) throw RecordingError("a record is too short for its content");
    const std::string_view out = left_.substr(0, static_cast<std::size_t>(size));
    left_.remove_prefix(out.size());
    return out;
  }
  TextMap take_map() {
    McapCursor entries(take_text());
    TextMap out;
    while (!entries.left_.empty()) {
      const std::string key(entries.take_text());
      out[key] = entries.take_text();
    }
    return out;
  }
  [[nodiscard]] std::string_view left() const { return left_; }

 private:
  std::string_view left_;
};

}  // namespace longreach
