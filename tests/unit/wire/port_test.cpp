// What must not get through a port, and that it leaves no trace but its counter.
#include "common/wire/port.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "common/wire/memory_channel.hpp"
#include "tests/unit/wire/samples.hpp"

namespace longreach {
namespace {

using samples::datagram;
using samples::kPeerSession;

Time at_ms(std::int64_t ms) { return Time(std::chrono::milliseconds(ms)); }

class PortUnderFire : public ::testing::Test {
 protected:
  PortUnderFire() {
    deliver_to_slave(datagram(samples::command(), 10));
    deliver_to_master(datagram(samples::report(), 10));
    EXPECT_EQ(slave_.commands().size(), 1u);
    EXPECT_EQ(master_.reports().size(), 1u);
  }

  void deliver_to_slave(std::span<const std::byte> bytes) {
    to_slave_.a().send(bytes);
    slave_.receive(now_);
  }
  void deliver_to_master(std::span<const std::byte> bytes) {
    to_master_.a().send(bytes);
    master_.receive(now_);
  }

  /// All that a datagram could have changed, except the counters of rejections.
  std::string digest(Port& port) const {
    std::ostringstream out;
    const LinkFigures f = port.endpoint().monitor().figures(now_);
    const Stamp stamp = port.endpoint().stamp_for(now_);
    out << port.endpoint().peer_session() << ' ' << port.endpoint().peer_restarts() << ' '
        << port.accepted_total() << ' ' << f.rtt_s.value_or(-1) << ' ' << f.rtt_min_s << ' ' << f.jitter_s
        << ' ' << f.loss << ' ' << f.reorder << ' ' << f.silence_s << ' ' << f.rate_hz << ' ' << f.bytes_per_s
        << ' ' << stamp.echo.session << ' ' << stamp.echo.sent_ns << ' ' << stamp.echo.held.count();
    return out.str();
  }

  void expect_slave_drops(std::span<const std::byte> bytes, Rejection reason, const std::string& what) {
    const std::string before = digest(slave_);
    RejectionCounts counts = slave_.rejected();
    ++counts[static_cast<std::size_t>(reason)];
    deliver_to_slave(bytes);
    EXPECT_EQ(slave_.rejected(), counts) << what << ": expected " << to_string(reason);
    EXPECT_TRUE(slave_.commands().empty()) << what;
    EXPECT_EQ(digest(slave_), before) << what;
  }
  void expect_master_drops(std::span<const std::byte> bytes, Rejection reason, const std::string& what) {
    const std::string before = digest(master_);
    RejectionCounts counts = master_.rejected();
    ++counts[static_cast<std::size_t>(reason)];
    deliver_to_master(bytes);
    EXPECT_EQ(master_.rejected(), counts) << what << ": expected " << to_string(reason);
    EXPECT_TRUE(master_.reports().empty() && master_.telemetry().empty()) << what;
    EXPECT_EQ(digest(master_), before) << what;
  }

  Time now_ = at_ms(1000);
  MemoryChannelPair to_slave_;
  MemoryChannelPair to_master_;
  SlavePort slave_{to_slave_.b(), 1, ImpairmentConfig{}, Random(1)};
  MasterPort master_{to_master_.b(), 2, ImpairmentConfig{}, Random(2)};
};

TEST_F(PortUnderFire, DropsGarbageOfEveryLength) {
  Random random(3);
  for (std::size_t length = 0; length <= 600; ++length) {
    std::vector<std::byte> bytes(length);
    for (auto& b : bytes) b = std::byte(random.next());
    Rejection reason = Rejection::kVersion;
    if (length < 22 || length > 508) {
      reason = Rejection::kLength;
    } else if (bytes[0] == std::byte{1}) {
      reason = bytes[1] == std::byte{1} ? Rejection::kChecksum : Rejection::kType;
    }
    expect_slave_drops(bytes, reason, "garbage of " + std::to_string(length));
  }
}

TEST_F(PortUnderFire, DropsGarbageBehindAValidVersionAndType) {
  Random random(4);
  for (std::size_t length = 22; length <= 508; ++length) {
    std::vector<std::byte> bytes(length);
    for (auto& b : bytes) b = std::byte(random.next());
    bytes[0] = std::byte{1};
    bytes[1] = std::byte{1};
    expect_slave_drops(bytes, Rejection::kChecksum, "garbage of " + std::to_string(length));
  }
}

TEST_F(PortUnderFire, DropsTheLargestDatagramThatUdpCanCarry) {
  const std::vector<std::byte> bytes(65507, std::byte{1});
  expect_slave_drops(bytes, Rejection::kLength, "65507 bytes");
  expect_master_drops(bytes, Rejection::kLength, "65507 bytes");
}

TEST_F(PortUnderFire, DropsEveryTruncation) {
  const auto whole = datagram(samples::command(), 11);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const auto reason = length < 22 ? Rejection::kLength : Rejection::kChecksum;
    expect_slave_drops(std::span(whole).first(length), reason, "cut to " + std::to_string(length));
  }
  auto longer = whole;
  longer.push_back(std::byte{0});
  expect_slave_drops(longer, Rejection::kChecksum, "one byte too long");
}

TEST_F(PortUnderFire, DropsEverySingleBitFlip) {
  const auto flip_all = [](std::vector<std::byte> bytes, auto expect) {
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
      bytes[bit / 8] ^= std::byte(1u << (bit % 8));
      expect(bytes, bit);
      bytes[bit / 8] ^= std::byte(1u << (bit % 8));
    }
  };
  const auto reason_of = [](std::size_t bit, bool still_taken) {
    if (bit < 8) return Rejection::kVersion;
    return bit < 16 && !still_taken ? Rejection::kType : Rejection::kChecksum;
  };
  flip_all(datagram(samples::command(), 11), [&](const auto& bytes, std::size_t bit) {
    expect_slave_drops(bytes, reason_of(bit, false), "bit " + std::to_string(bit));
  });
  const auto expect_master = [&](const auto& bytes, std::size_t bit) {
    const bool taken = bytes[1] == std::byte{2} || bytes[1] == std::byte{3};
    expect_master_drops(bytes, reason_of(bit, taken), "bit " + std::to_string(bit));
  };
  flip_all(datagram(samples::report(), 11), expect_master);
  flip_all(datagram(samples::telemetry(), 11), expect_master);
}

TEST_F(PortUnderFire, DropsWhatTheOtherSideReceives) {
  expect_slave_drops(datagram(samples::report(), 11), Rejection::kType, "report to the slave");
  expect_slave_drops(datagram(samples::telemetry(), 11), Rejection::kType, "telemetry to the slave");
  expect_master_drops(datagram(samples::command(), 11), Rejection::kType, "command to the master");
}

TEST_F(PortUnderFire, DropsBodiesOfAnotherMessage) {
  const auto body = std::string("\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff");
  const auto bytes = samples::with_header({DatagramType::kMotionCommand, kPeerSession, 11}, body);
  expect_slave_drops(bytes, Rejection::kDecode, "not protobuf");
  const auto empty = samples::with_header({DatagramType::kMotionCommand, kPeerSession, 11}, std::string{});
  expect_slave_drops(empty, Rejection::kValue, "empty body");
}

TEST_F(PortUnderFire, DropsImpossibleValues) {
  MotionCommand command = samples::command();
  command.position_m.x() = std::numeric_limits<double>::quiet_NaN();
  expect_slave_drops(datagram(command, 11), Rejection::kValue, "NaN");
  StiffnessReport report = samples::report();
  report.translation.stiffness(1, 1) = 1e13;
  expect_master_drops(datagram(report, 11), Rejection::kValue, "1e13 N/m");
  Telemetry telemetry = samples::telemetry();
  telemetry.F_E_W.force.z() = -std::numeric_limits<double>::infinity();
  expect_master_drops(datagram(telemetry, 11), Rejection::kValue, "-inf N");
}

TEST_F(PortUnderFire, DropsAReplay) {
  expect_slave_drops(datagram(samples::command(), 10), Rejection::kReplay, "replay");
  expect_slave_drops(datagram(samples::command(), 0), Rejection::kReplay, "sequence 0");
  expect_master_drops(datagram(samples::report(), 10), Rejection::kReplay, "replay");
}

TEST_F(PortUnderFire, DropsAnOlderSessionWhileTheNewerOneLives) {
  expect_slave_drops(datagram(samples::command(), 11, kPeerSession - 1), Rejection::kSession,
                     "older session");
  expect_slave_drops(datagram(samples::command(), 11, 0), Rejection::kSession, "session 0");
}

TEST_F(PortUnderFire, ADroppedDatagramDoesNotUseUpItsSequence) {
  MotionCommand bad = samples::command();
  bad.scale = 5.0;
  expect_slave_drops(datagram(bad, 4'000'000'000), Rejection::kValue, "bad value far ahead");
  expect_slave_drops(datagram(bad, 11, kPeerSession + 5), Rejection::kValue, "bad value of a new session");
  deliver_to_slave(datagram(samples::command(), 11));
  ASSERT_EQ(slave_.commands().size(), 1u);
  EXPECT_EQ(slave_.commands()[0].sequence, 11u);
}

TEST_F(PortUnderFire, AcceptsReorderedOnesOnceAndMarksThem) {
  deliver_to_slave(datagram(samples::command(), 13));
  EXPECT_TRUE(slave_.commands()[0].newest);
  deliver_to_slave(datagram(samples::command(), 12));
  ASSERT_EQ(slave_.commands().size(), 1u);
  EXPECT_FALSE(slave_.commands()[0].newest);
  expect_slave_drops(datagram(samples::command(), 12), Rejection::kReplay, "the reordered one again");
}

TEST_F(PortUnderFire, ADuplicateOfTheSameTickIsDropped) {
  to_slave_.a().send(datagram(samples::command(), 20));
  deliver_to_slave(datagram(samples::command(), 20));
  EXPECT_EQ(slave_.commands().size(), 1u);
  EXPECT_EQ(slave_.rejected()[static_cast<std::size_t>(Rejection::kReplay)], 1u);
}

TEST_F(PortUnderFire, KeepsTheNewestWhenMoreArriveThanAreKept) {
  for (std::uint64_t i = 1; i <= 300; ++i) to_slave_.a().send(datagram(samples::command(), 100 + i));
  slave_.receive(now_);
  ASSERT_EQ(slave_.commands().size(), 256u);
  EXPECT_EQ(slave_.commands().front().sequence, 145u);
  EXPECT_EQ(slave_.commands().back().sequence, 400u);
  slave_.receive(now_);
  EXPECT_TRUE(slave_.commands().empty());
}

TEST_F(PortUnderFire, AFloodOfGarbageIsTakenInBoundedBites) {
  const std::vector<std::byte> garbage(100, std::byte{0xee});
  for (int i = 0; i < 2000; ++i) to_slave_.a().send(garbage);
  slave_.receive(now_);
  EXPECT_EQ(slave_.rejected_total(), 1024u);
  slave_.receive(now_);
  EXPECT_EQ(slave_.rejected_total(), 2000u);
}

TEST(Ports, CarryMessagesAndEchoBothWays) {
  MemoryChannelPair channels;
  MasterPort master(channels.a(), 7, ImpairmentConfig{}, Random(1));
  SlavePort slave(channels.b(), 9, ImpairmentConfig{}, Random(2));
  master.send(at_ms(100), 1, samples::command());
  slave.receive(at_ms(5000));  // the two clocks have nothing in common
  ASSERT_EQ(slave.commands().size(), 1u);
  EXPECT_EQ(slave.commands()[0].message.position_m, samples::command().position_m);
  EXPECT_EQ(slave.commands()[0].sent, PeerTime(std::chrono::milliseconds(100)));
  EXPECT_EQ(slave.commands()[0].received, at_ms(5000));
  EXPECT_FALSE(slave.commands()[0].echo_sent);
  slave.send(at_ms(5030), 1, samples::report());
  slave.send(at_ms(5030), 1, samples::telemetry());
  master.receive(at_ms(170));
  ASSERT_EQ(master.reports().size(), 1u);
  ASSERT_EQ(master.telemetry().size(), 1u);
  EXPECT_EQ(master.reports()[0].echo_sent, at_ms(100));
  EXPECT_NEAR(master.endpoint().monitor().figures(at_ms(170)).rtt_s.value(), 0.040, 1e-9);
}

TEST(Ports, DelayWhatTheyReceiveByTheImpairment) {
  MemoryChannelPair channels;
  MasterPort master(channels.a(), 7, ImpairmentConfig{}, Random(1));
  ImpairmentConfig late;
  late.delay_s = 1.3;
  SlavePort slave(channels.b(), 9, late, Random(2));
  master.send(at_ms(0), 1, samples::command());
  slave.receive(at_ms(0));
  slave.receive(at_ms(1299));
  EXPECT_TRUE(slave.commands().empty());
  slave.receive(at_ms(1300));
  ASSERT_EQ(slave.commands().size(), 1u);
  EXPECT_EQ(slave.commands()[0].received, at_ms(1300));
}

TEST(Ports, CountDatagramsThatTheImpairmentCorrupts) {
  MemoryChannelPair channels;
  MasterPort master(channels.a(), 7, ImpairmentConfig{}, Random(1));
  ImpairmentConfig corrupting;
  corrupting.corrupt = 1.0;
  SlavePort slave(channels.b(), 9, corrupting, Random(2));
  for (std::uint64_t i = 1; i <= 500; ++i) master.send(at_ms(0), i, samples::command());
  slave.receive(at_ms(0));
  EXPECT_TRUE(slave.commands().empty());
  EXPECT_EQ(slave.rejected_total(), 500u);
}

TEST(MemoryChannelPair, DropsAndCountsWhatDoesNotFit) {
  MemoryChannelPair channels(2);
  const std::vector<std::byte> bytes(3, std::byte{1});
  for (int i = 0; i < 5; ++i) channels.a().send(bytes);
  EXPECT_EQ(channels.dropped(), 3u);
  std::array<std::byte, 2> small{};
  EXPECT_EQ(channels.b().receive(small), 3u);
  EXPECT_EQ(channels.b().receive(small), 3u);
  EXPECT_FALSE(channels.b().receive(small));
  EXPECT_FALSE(channels.a().receive(small));
}

}  // namespace
}  // namespace longreach
