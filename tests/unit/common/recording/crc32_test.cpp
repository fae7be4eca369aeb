// CRC-32 against zlib's.
#include "common/recording/crc32.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <vector>

#include "common/core/random.hpp"

namespace longreach::crc32_test {
namespace {

std::uint32_t of_zlib(std::span<const std::byte> bytes) {
  return static_cast<std::uint32_t>(
      ::crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
}

TEST(Crc32, IsThatOfZlib) {
  Random random(1);
  std::vector<std::byte> bytes;
  for (int i = 0; i < 2000; ++i) {
    ASSERT_EQ(crc32(bytes), of_zlib(bytes)) << i;
    bytes.push_back(static_cast<std::byte>(random.next()));
  }
}

TEST(Crc32, GoesOnWhereItWas) {
  Random random(2);
  std::vector<std::byte> bytes(1000);
  for (auto& b : bytes) b = static_cast<std::byte>(random.next());
  const auto all = std::span<const std::byte>(bytes);
  for (std::size_t cut = 0; cut <= bytes.size(); ++cut)
    ASSERT_EQ(crc32(all.subspan(cut), crc32(all.first(cut))), of_zlib(all)) << cut;
}

}  // namespace
}  // namespace longreach::crc32_test
