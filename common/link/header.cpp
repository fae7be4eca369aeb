#include "common/link/header.hpp"

#include <endian.h>

#include <cstring>

#include "common/core/check.hpp"

namespace longreach {
namespace {

void put(std::uint64_t value, std::span<std::byte> to) {
  value = htobe64(value);
  std::memcpy(to.data(), &value, sizeof value);
}

std::uint64_t get(std::span<const std::byte> from) {
  std::uint64_t value = 0;
  std::memcpy(&value, from.data(), sizeof value);
  return be64toh(value);
}

constexpr bool known(std::uint8_t type) {
  return type >= static_cast<std::uint8_t>(DatagramType::kMotionCommand) &&
         type <= static_cast<std::uint8_t>(kDatagramTypes);
}

}  // namespace

void write_header(const Header& header, std::span<std::byte> datagram) {
  CHECK(datagram.size() >= kHeaderBytes);
  datagram[0] = std::byte{kWireVersion};
  datagram[1] = static_cast<std::byte>(header.type);
  put(header.session, datagram.subspan(2));
  put(header.sequence, datagram.subspan(10));
}

std::variant<Header, Rejection> read_header(std::span<const std::byte> datagram) {
  if (datagram.size() < kOverheadBytes || datagram.size() > kDatagramMaxBytes) return Rejection::kLength;
  if (std::to_integer<std::uint8_t>(datagram[0]) != kWireVersion) return Rejection::kVersion;
  const auto type = std::to_integer<std::uint8_t>(datagram[1]);
  if (!known(type)) return Rejection::kType;
  return Header{.type = static_cast<DatagramType>(type),
                .session = get(datagram.subspan(2)),
                .sequence = get(datagram.subspan(10))};
}

}  // namespace longreach
