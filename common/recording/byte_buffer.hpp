#pragma once
// Buffer for the bytes of MCAP records, with little-endian numbers and length-prefixed strings. It grows as
// needed and reuses its memory.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace longreach {

using TextMap = std::map<std::string, std::string>;

class ByteBuffer {
 public:
  void clear() { bytes_.clear(); }
  [[nodiscard]] std::size_t size() const { return bytes_.size(); }
  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

  template <class Integer>
  void add(Integer value) {
    for (std::size_t i = 0; i < sizeof(Integer); ++i)
      bytes_.push_back(static_cast<std::byte>(static_cast<std::uint64_t>(value) >> (8 * i)));
  }
  void add_text(std::string_view text) {
    add(static_cast<std::uint32_t>(text.size()));
    add_bytes(std::as_bytes(std::span(text)));
  }
  void add_map(const TextMap& map) {
    const std::size_t at = begin_length();
    for (const auto& [key, value] : map) {
      add_text(key);
      add_text(value);
    }
    end_length(at);
  }
  void add_bytes(std::span<const std::byte> bytes) {
    std::copy(bytes.begin(), bytes.end(), extend(bytes.size()));
  }
  /// Adds `size` bytes and returns a pointer to them. The caller must write them.
  std::byte* extend(std::size_t size) {
    bytes_.resize(bytes_.size() + size);
    return bytes_.data() + bytes_.size() - size;
  }

  /// Reserves space for a length of 4 or 8 bytes. end_length() fills it in when the content is complete.
  template <class Length = std::uint32_t>
  std::size_t begin_length() {
    add(Length{0});
    return bytes_.size();
  }
  template <class Length = std::uint32_t>
  void end_length(std::size_t begin) {
    const auto length = static_cast<Length>(bytes_.size() - begin);
    for (std::size_t i = 0; i < sizeof(Length); ++i)
      bytes_[begin - sizeof(Length) + i] =
          static_cast<std::byte>(static_cast<std::uint64_t>(length) >> (8 * i));
  }

 private:
  std::vector<std::byte> bytes_;
};

}  // namespace longreach
