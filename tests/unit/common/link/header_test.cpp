#include "common/link/header.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace longreach::header_test {
namespace {

using Bytes = std::vector<std::byte>;

Bytes datagram(const Header& header, std::size_t body) {
  Bytes bytes(kOverheadBytes + body);
  for (std::size_t i = kHeaderBytes; i < bytes.size(); ++i) bytes[i] = static_cast<std::byte>(i * 37);
  write_header(header, bytes);
  return bytes;
}

Rejection rejection(const Bytes& bytes) { return std::get<Rejection>(read_header(bytes)); }

TEST(Header, LiesInTheBytesBigEndian) {
  const Bytes bytes = datagram({DatagramType::kTelemetry, 0x0102030405060708, 0x1112131415161718}, 0);
  ASSERT_EQ(bytes.size(), 34U);
  EXPECT_EQ(std::to_integer<int>(bytes[0]), kWireVersion);
  EXPECT_EQ(std::to_integer<int>(bytes[1]), 3);
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(std::to_integer<int>(bytes[static_cast<std::size_t>(2 + i)]), i + 1);
    EXPECT_EQ(std::to_integer<int>(bytes[static_cast<std::size_t>(10 + i)]), i + 0x11);
  }
}

TEST(Header, ComesBackAsItWasWritten) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
  for (const auto type : {DatagramType::kMotionCommand, DatagramType::kStiffnessReport,
                          DatagramType::kTelemetry, DatagramType::kBodyPoses}) {
    for (const std::uint64_t number : {std::uint64_t{1}, std::uint64_t{0x8000000000000000}, kMost}) {
      for (const std::size_t body : {std::size_t{0}, std::size_t{1}, kDatagramMaxBytes - kOverheadBytes}) {
        const auto read = read_header(datagram({type, number, kMost - number}, body));
        ASSERT_TRUE(std::holds_alternative<Header>(read));
        EXPECT_EQ(std::get<Header>(read).type, type);
        EXPECT_EQ(std::get<Header>(read).session, number);
        EXPECT_EQ(std::get<Header>(read).sequence, kMost - number);
      }
    }
  }
}

TEST(Header, NamesTheFirstThingThatIsWrong) {
  const Bytes good = datagram({DatagramType::kStiffnessReport, 5, 6}, 40);
  EXPECT_EQ(rejection(Bytes(good.begin(), good.begin() + 33)), Rejection::kLength);
  EXPECT_EQ(rejection({}), Rejection::kLength);
  EXPECT_EQ(rejection(Bytes(509)), Rejection::kLength);
  EXPECT_EQ(rejection(Bytes(65507)), Rejection::kLength);
  Bytes other_version = good;
  other_version[0] = std::byte{1};
  other_version[1] = std::byte{9};
  EXPECT_EQ(rejection(other_version), Rejection::kVersion);
  for (const int type : {0, 5, 255}) {
    Bytes other_type = good;
    other_type[1] = static_cast<std::byte>(type);
    EXPECT_EQ(rejection(other_type), Rejection::kType);
  }
}

}  // namespace
}  // namespace longreach::header_test
