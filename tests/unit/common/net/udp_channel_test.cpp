// Real sockets on loopback. A datagram on loopback is there when send() returns, so nothing waits.
#include "common/net/udp_channel.hpp"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <vector>

#include "common/net/address.hpp"

namespace longreach::udp_channel_test {
namespace {

std::vector<std::byte> datagram(int content) {
  return std::vector<std::byte>(40, static_cast<std::byte>(content));
}

TEST(Address, ReadsNumbersNamesAndBrackets) {
  EXPECT_EQ(to_string(parse_udp_address("127.0.0.1:47001")), "127.0.0.1:47001");
  EXPECT_EQ(to_string(parse_udp_address("0.0.0.0:0")), "0.0.0.0:0");
  EXPECT_EQ(to_string(parse_udp_address("[::1]:65535")), "[::1]:65535");
  EXPECT_EQ(to_string(parse_udp_address("localhost:80")), "127.0.0.1:80");
}

TEST(Address, RefusesEverythingElseWithASentenceThatNamesIt) {
  for (const std::string text :
       {"", ":", "127.0.0.1", "127.0.0.1:", "127.0.0.1:65536", "127.0.0.1:-1", ":47001", "127.0.0.1:47001x",
        "::1:47001", "[]:1", "a.invalid:1", "127.0.0.1: 1"}) {
    try {
      parse_udp_address(text);
      FAIL() << "accepted '" << text << "'";
    } catch (const AddressError& e) {
      EXPECT_NE(std::string(e.what()).find("'" + text + "'"), std::string::npos) << e.what();
    }
  }
}

/// What has come by now, also where a batch has ended.
std::optional<std::size_t> next(UdpChannel& channel, std::span<std::byte> buffer) {
  const auto size = channel.receive(buffer);
  return size ? size : channel.receive(buffer);
}

TEST(UdpChannel, TakesManyDatagramsInTheirOrder) {
  UdpChannel slave("127.0.0.1:0");
  UdpChannel master("127.0.0.1:0", slave.local_address());
  std::array<std::byte, 508> buffer{};
  for (const std::size_t count : {1u, 31u, 32u, 33u, 64u, 100u}) {
    for (std::size_t i = 0; i < count; ++i) master.send(std::vector<std::byte>(1 + i, std::byte{9}));
    for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(slave.receive(buffer), 1 + i) << count;
    EXPECT_FALSE(slave.receive(buffer)) << count;
  }
}

TEST(UdpChannel, CarriesDatagramsBothWays) {
  UdpChannel slave("127.0.0.1:0");
  UdpChannel master("127.0.0.1:0", slave.local_address());
  std::array<std::byte, 508> buffer{};
  EXPECT_FALSE(slave.receive(buffer));
  const auto sent = datagram(7);
  master.send(sent);
  ASSERT_EQ(slave.receive(buffer), sent.size());
  EXPECT_TRUE(std::equal(sent.begin(), sent.end(), buffer.begin()));
  EXPECT_FALSE(slave.receive(buffer));
  slave.answer_to(slave.origin());
  slave.send(sent);
  EXPECT_EQ(master.receive(buffer), sent.size());
}

TEST(UdpChannel, WorksOverIpv6) {
  if (!std::filesystem::exists("/proc/net/if_inet6")) {
    EXPECT_THROW(UdpChannel("[::1]:0"), std::runtime_error);
    return;
  }
  UdpChannel slave("[::]:0");
  const std::string port = slave.local_address().substr(4);
  std::array<std::byte, 508> buffer{};
  for (const std::string& peer : {"[::1]" + port, "127.0.0.1" + port}) {
    UdpChannel master("[::]:0", peer);
    master.send(datagram(7));
    ASSERT_TRUE(next(slave, buffer)) << peer;
    slave.answer_to(slave.origin());
    slave.send(datagram(9));
    EXPECT_TRUE(master.receive(buffer)) << peer;
  }
}

TEST(UdpChannel, TellsTheTrueSizeOfWhatWasCut) {
  UdpChannel slave("127.0.0.1:0");
  UdpChannel master("127.0.0.1:0", slave.local_address());
  std::array<std::byte, 508> buffer{};
  for (const std::size_t size : {509u, 2000u, 65507u}) {
    master.send(std::vector<std::byte>(size));
    EXPECT_EQ(next(slave, buffer), size);
  }
  master.send({});
  EXPECT_EQ(next(slave, buffer), 0u);
}

// The system itself would answer from 127.0.0.1, or from the first address of the interface.
TEST(UdpChannel, AnswersFromTheAddressThatWasAsked) {
  std::array<std::byte, 508> buffer{};
  for (const std::string listen : {"0.0.0.0:0", "[::]:0"}) {
    if (listen.front() == '[' && !std::filesystem::exists("/proc/net/if_inet6")) continue;
    UdpChannel slave(listen);
    const std::string port = slave.local_address().substr(slave.local_address().rfind(':'));
    for (const std::string host : {"127.0.0.9", "127.3.4.5"}) {
      UdpChannel master("127.0.0.1:0", host + port);
      master.send(datagram(7));
      ASSERT_TRUE(next(slave, buffer)) << host;
      slave.answer_to(slave.origin());
      EXPECT_EQ(slave.peer_address()->substr(slave.peer_address()->rfind(':')),
                master.local_address().substr(9));
      slave.send(datagram(9));
      EXPECT_TRUE(master.receive(buffer)) << listen << " asked as " << host;
      EXPECT_EQ(master.unknown_peers(), 0U);
    }
    EXPECT_EQ(slave.unsent(), 0U);
  }
}

TEST(UdpChannel, AnswersNobodyUntilItIsToldWhom) {
  UdpChannel slave("127.0.0.1:0");
  UdpChannel master("127.0.0.1:0", slave.local_address());
  UdpChannel unknown_peer("127.0.0.1:0", slave.local_address());
  std::array<std::byte, 508> buffer{};
  slave.send(datagram(1));
  master.send(datagram(7));
  ASSERT_TRUE(next(slave, buffer));
  const Origin genuine = slave.origin();
  EXPECT_FALSE(slave.peer_address());
  unknown_peer.send(datagram(8));
  ASSERT_TRUE(next(slave, buffer));
  slave.answer_to(genuine);
  EXPECT_EQ(slave.peer_address(), master.local_address());
  slave.answer_to(slave.origin());
  EXPECT_EQ(slave.peer_address(), unknown_peer.local_address());
  slave.answer_to(kNowhere);
  EXPECT_FALSE(slave.peer_address());
  EXPECT_FALSE(master.receive(buffer));
}

TEST(UdpChannel, TheCallingSideKeepsItsPeer) {
  UdpChannel slave("127.0.0.1:0");
  UdpChannel master("127.0.0.1:0", slave.local_address());
  master.answer_to(kNowhere);
  EXPECT_EQ(master.peer_address(), slave.local_address());
}

TEST(UdpChannel, TheCallingSideDropsAndCountsStrangers) {
  UdpChannel slave("127.0.0.1:0");
  UdpChannel master("127.0.0.1:0", slave.local_address());
  UdpChannel unknown_peer("127.0.0.1:0", master.local_address());
  std::array<std::byte, 508> buffer{};
  for (int i = 0; i < 3; ++i) unknown_peer.send(datagram(9));
  EXPECT_FALSE(master.receive(buffer));
  EXPECT_EQ(master.unknown_peers(), 3u);
}

TEST(UdpChannel, SaysWhatToDoWhenThePortIsTaken) {
  UdpChannel first("127.0.0.1:0");
  try {
    UdpChannel second(first.local_address());
    FAIL() << "bound twice";
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("link.listen"), std::string::npos) << e.what();
  }
}

TEST(UdpChannel, RefusesPeersThatItCannotReach) {
  EXPECT_THROW(UdpChannel("127.0.0.1:0", "[::1]:47001"), AddressError);
  EXPECT_THROW(UdpChannel("127.0.0.1:0", "127.0.0.1:0"), AddressError);
}

}  // namespace
}  // namespace longreach::udp_channel_test
