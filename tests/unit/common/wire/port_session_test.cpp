// Ports and their session: none, a new one, its numbers, and whom they answer.
#include <gtest/gtest.h>

#include "common/wire/memory_channel.hpp"
#include "common/wire/port.hpp"
#include "tests/unit/common/wire/samples.hpp"

namespace longreach::port_session_test {
namespace {

using samples::datagram;

Time at_ms(std::int64_t ms) { return Time(std::chrono::milliseconds(ms)); }

TEST(Ports, SayAndHearNothingWithoutASession) {
  MemoryChannelPair channels;
  MasterPort master(channels.a(), ImpairmentConfig{}, Random(1));
  SlavePort slave(channels.b(), ImpairmentConfig{}, Random(2));
  master.send(at_ms(0), 1, samples::command());
  EXPECT_EQ(slave.send(at_ms(0), 1, samples::report()), 0u);
  for (const std::uint64_t number : {0, 1, 1000})
    channels.a().send(datagram(samples::command(), 1, samples::session(number)));
  slave.receive(at_ms(1));
  EXPECT_EQ(slave.rejected()[static_cast<std::size_t>(Rejection::kSession)], 3u);
  EXPECT_EQ(slave.rejected_total(), 3u);
}

TEST(Ports, NewSessionEndsOldOneAndRestartsNumbers) {
  MemoryChannelPair channels;
  MasterPort master(channels.a(), ImpairmentConfig{}, Random(1));
  SlavePort slave(channels.b(), ImpairmentConfig{}, Random(2));
  master.follow(samples::session());
  slave.follow(samples::session());
  master.send(at_ms(0), 5, samples::command());
  slave.follow(samples::session(7));
  slave.receive(at_ms(1));
  EXPECT_TRUE(slave.commands().empty());
  master.follow(samples::session(7));
  master.send(at_ms(2), 1, samples::command());
  slave.receive(at_ms(3));
  EXPECT_EQ(slave.commands().size(), 1u);
}

TEST(Ports, SayAndHearNothingOnceTheyHaveLeft) {
  MemoryChannelPair channels;
  SlavePort slave(channels.b(), ImpairmentConfig{}, Random(2));
  slave.follow(samples::session());
  slave.leave();
  channels.a().send(datagram(samples::command(), 1));
  channels.a().send(datagram(samples::command(), 1, samples::session(0)));
  slave.receive(at_ms(1));
  EXPECT_EQ(slave.rejected()[static_cast<std::size_t>(Rejection::kSession)], 2u);
  EXPECT_EQ(slave.send(at_ms(1), 1, samples::report()), 0u);
}

TEST(Ports, NeverSealTwoDatagramsWithOneNumber) {
  MemoryChannelPair channels;
  SlavePort slave(channels.b(), ImpairmentConfig{}, Random(2));
  slave.follow(samples::session());
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
  struct Row {
    std::uint64_t number;
    bool sent;
  };
  for (const Row& row : {Row{0, false}, Row{5, true}, Row{5, false}, Row{4, false}, Row{6, true},
                         Row{kMost - 1, true}, Row{kMost, false}, Row{0, false}, Row{1, false}}) {
    EXPECT_EQ(slave.send(at_ms(1), row.number, samples::report()) > 0, row.sent) << row.number;
  }
  slave.send(at_ms(1), 1, samples::telemetry());  // another type has numbers of its own
  std::array<std::byte, 508> buffer{};
  int sent = 0;
  while (channels.a().receive(buffer)) ++sent;
  EXPECT_EQ(sent, 4);
}

TEST(Ports, AgreeOnEitherCipher) {
  for (const Cipher cipher : {Cipher::kChaCha20Poly1305, Cipher::kAes256Gcm}) {
    if (cipher == Cipher::kAes256Gcm && !has_aes256gcm()) continue;
    MemoryChannelPair channels;
    MasterPort master(channels.a(), ImpairmentConfig{}, Random(1));
    SlavePort slave(channels.b(), ImpairmentConfig{}, Random(2));
    master.follow(samples::session(3, cipher));
    slave.follow(samples::session(3, cipher));
    master.send(at_ms(1), 1, samples::command());
    slave.receive(at_ms(2));
    ASSERT_EQ(slave.commands().size(), 1u);
    EXPECT_EQ(slave.commands()[0].message.position_m, samples::command().position_m);
  }
}

/// Remembers what the port tells it, and says where each datagram came from.
class FakeChannel : public Channel {
 public:
  std::optional<std::size_t> receive(std::span<std::byte> buffer) override {
    if (next_ == queue.size()) return std::nullopt;
    const auto& bytes = queue[next_++];
    origin_[0] = static_cast<std::uint8_t>(next_);
    std::copy_n(bytes.begin(), bytes.size(), buffer.begin());
    return bytes.size();
  }
  void send(std::span<const std::byte>) override {}
  [[nodiscard]] const Origin& origin() const override { return origin_; }
  void answer_to(const Origin& origin) override { answers.push_back(origin[0]); }

  std::vector<std::vector<std::byte>> queue;
  std::vector<int> answers;

 private:
  std::size_t next_ = 0;
  Origin origin_{};
};

TEST(Ports, AnswerToWhereTheNewestAuthenticDatagramCameFrom) {
  FakeChannel channel;
  SlavePort slave(channel, ImpairmentConfig{}, Random(2));
  slave.follow(samples::session());
  const auto genuine = datagram(samples::command(), 50);
  auto damaged = datagram(samples::command(), 51);
  damaged.back() ^= std::byte{1};
  channel.queue = {genuine,
                   genuine,                                                // replayed
                   datagram(samples::command(), 49),                       // late
                   damaged,                                                // forged
                   std::vector<std::byte>(100),                            // garbage
                   datagram(samples::command(), 99, samples::session(5)),  // of another session
                   datagram(samples::command(), 51)};                      // the master's address has changed
  slave.receive(at_ms(1));
  EXPECT_EQ(channel.answers, (std::vector<int>{0, 1, 7}));
}

}  // namespace
}  // namespace longreach::port_session_test
