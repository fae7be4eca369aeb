#include "common/link/header.hpp"

#include <array>

#include "common/core/check.hpp"

namespace longreach {
namespace {

constexpr std::size_t kChecksumAt = 18;

constexpr std::array<std::uint32_t, 256> make_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t i = 0; i < table.size(); ++i) {
    std::uint32_t c = i;
    for (int bit = 0; bit < 8; ++bit) c = (c & 1U) != 0 ? 0xEDB88320U ^ (c >> 1) : c >> 1;
    table[i] = c;
  }
  return table;
}

constexpr std::array<std::uint32_t, 256> kTable = make_table();

template <class Integer>
void put(Integer value, std::span<std::byte> to) {
  for (std::size_t i = 0; i < sizeof(Integer); ++i) {
    to[i] = static_cast<std::byte>(value >> (8 * (sizeof(Integer) - 1 - i)));
  }
}

template <class Integer>
Integer get(std::span<const std::byte> from) {
  Integer value = 0;
  for (std::size_t i = 0; i < sizeof(Integer); ++i) value = (value << 8) | std::to_integer<Integer>(from[i]);
  return value;
}

std::uint32_t checksum(std::span<const std::byte> datagram) {
  return crc32(datagram.subspan(kHeaderBytes), crc32(datagram.first(kChecksumAt)));
}

constexpr bool known(std::uint8_t type) {
  return type >= static_cast<std::uint8_t>(DatagramType::kMotionCommand) &&
         type <= static_cast<std::uint8_t>(DatagramType::kTelemetry);
}

}  // namespace

std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t before) {
  std::uint32_t c = ~before;
  for (const std::byte b : bytes) c = kTable[(c ^ std::to_integer<std::uint32_t>(b)) & 0xFFU] ^ (c >> 8);
  return ~c;
}

void write_header(const Header& header, std::span<std::byte> datagram) {
  CHECK(datagram.size() >= kHeaderBytes);
  datagram[0] = std::byte{kWireVersion};
  datagram[1] = static_cast<std::byte>(header.type);
  put(header.session, datagram.subspan(2));
  put(header.sequence, datagram.subspan(10));
  put(checksum(datagram), datagram.subspan(kChecksumAt));
}

std::variant<Header, Rejection> read_header(std::span<const std::byte> datagram) {
  if (datagram.size() < kHeaderBytes || datagram.size() > kDatagramMaxBytes) return Rejection::kLength;
  if (std::to_integer<std::uint8_t>(datagram[0]) != kWireVersion) return Rejection::kVersion;
  const auto type = std::to_integer<std::uint8_t>(datagram[1]);
  if (!known(type)) return Rejection::kType;
  if (get<std::uint32_t>(datagram.subspan(kChecksumAt)) != checksum(datagram)) return Rejection::kChecksum;
  return Header{.type = static_cast<DatagramType>(type),
                .session = get<std::uint64_t>(datagram.subspan(2)),
                .sequence = get<std::uint64_t>(datagram.subspan(10))};
}

}  // namespace longreach
