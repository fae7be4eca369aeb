// The same attacks over real sockets on loopback, from an address of its own and to both sides.
// LONGREACH_FULL=1: a hundred thousand datagrams.

#include <gtest/gtest.h>

#include "common/net/udp_channel.hpp"
#include "common/wire/port.hpp"
#include "deploy/lab/campaign_size.hpp"
#include "tests/property/intruder.hpp"
#include "tests/unit/common/wire/samples.hpp"

namespace longreach::hostile_socket_test {
namespace {

/// Passes on, and remembers what went which way.
class Tap : public Channel {
 public:
  explicit Tap(Channel& channel) : channel_(channel) {}
  std::optional<std::size_t> receive(std::span<std::byte> buffer) override {
    const auto size = channel_.receive(buffer);
    if (size) received.emplace_back(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(*size));
    return size;
  }
  [[nodiscard]] const Origin& origin() const override { return channel_.origin(); }
  void answer_to(const Origin& origin) override { channel_.answer_to(origin); }
  void send(std::span<const std::byte> datagram) override {
    sent.emplace_back(datagram.begin(), datagram.end());
    channel_.send(datagram);
  }
  std::vector<std::vector<std::byte>> received, sent;

 private:
  Channel& channel_;
};

TEST(HostileSocket, NobodyWithoutTheSecretIsHeardOrAnswered) {
  UdpChannel slave_socket("127.0.0.1:0");
  UdpChannel master_socket("127.0.0.1:0", slave_socket.local_address());
  UdpChannel unknown_peer("127.0.0.1:0", slave_socket.local_address());
  Tap tap(slave_socket);
  SlavePort slave(tap, ImpairmentConfig{}, Random(2));
  MasterPort master(master_socket, ImpairmentConfig{}, Random(1));
  slave.follow(samples::session());
  master.follow(samples::session());
  Time now{};
  std::uint64_t number = 0;
  const auto talk = [&] {
    now += std::chrono::milliseconds(1);
    master.send(now, ++number, samples::command());
    slave.receive(now);
    slave.send(now, number, samples::report());
    master.receive(now);
  };
  for (int i = 0; i < 100; ++i) talk();
  ASSERT_EQ(master.accepted_total() + slave.accepted_total(), 200u);
  Intruder intruder(Random(3));
  for (const auto& bytes : tap.received) intruder.receive_towards(bytes);
  for (const auto& bytes : tap.sent) intruder.receive_from(bytes);

  const Endpoint before = slave.endpoint();
  const int count = campaign(100'000, 10'000);
  for (int i = 0; i < count; ++i) {
    unknown_peer.send(intruder.make(static_cast<Attack>(i % static_cast<int>(Attack::kCount))));
    if (i % 50 == 49) slave.receive(now);  // before the socket's buffer is full
  }
  slave.receive(now);
  EXPECT_EQ(slave.rejected_total(), static_cast<std::uint64_t>(count));
  EXPECT_EQ(slave.accepted_total(), 100u);
  EXPECT_TRUE(slave.endpoint() == before);
  EXPECT_EQ(slave_socket.peer_address(), master_socket.local_address());
  talk();
  EXPECT_EQ(master.accepted_total() + slave.accepted_total(), 202u);
}

}  // namespace
}  // namespace longreach::hostile_socket_test
