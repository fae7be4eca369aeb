// What must not get through a port, and that it leaves no trace but its counter.
#include "common/wire/port.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "common/wire/memory_channel.hpp"
#include "tests/unit/common/wire/samples.hpp"

namespace longreach::port_test {
namespace {

using samples::datagram;

Time at_ms(std::int64_t ms) { return Time(std::chrono::milliseconds(ms)); }

class PortUnderFire : public ::testing::Test {
 protected:
  PortUnderFire() {
    slave_.follow(samples::session());
    master_.follow(samples::session());
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

  void expect_slave_drops(std::span<const std::byte> bytes, Rejection reason, const std::string& what) {
    const Endpoint before = slave_.endpoint();
    const std::uint64_t accepted = slave_.accepted_total();
    RejectionCounts counts = slave_.rejected();
    ++counts[static_cast<std::size_t>(reason)];
    deliver_to_slave(bytes);
    EXPECT_EQ(slave_.rejected(), counts) << what << ": expected " << to_string(reason);
    EXPECT_TRUE(slave_.commands().empty()) << what;
    EXPECT_TRUE(slave_.endpoint() == before) << what;
    EXPECT_EQ(slave_.accepted_total(), accepted) << what;
  }
  void expect_master_drops(std::span<const std::byte> bytes, Rejection reason, const std::string& what) {
    const Endpoint before = master_.endpoint();
    const std::uint64_t accepted = master_.accepted_total();
    RejectionCounts counts = master_.rejected();
    ++counts[static_cast<std::size_t>(reason)];
    deliver_to_master(bytes);
    EXPECT_EQ(master_.rejected(), counts) << what << ": expected " << to_string(reason);
    EXPECT_TRUE(master_.reports().empty() && master_.telemetry().empty() && master_.bodies().empty()) << what;
    EXPECT_TRUE(master_.endpoint() == before) << what;
    EXPECT_EQ(master_.accepted_total(), accepted) << what;
  }

  Time now_ = at_ms(1000);
  MemoryChannelPair to_slave_;
  MemoryChannelPair to_master_;
  SlavePort slave_{to_slave_.b(), ImpairmentConfig{}, Random(1)};
  MasterPort master_{to_master_.b(), ImpairmentConfig{}, Random(2)};
};

TEST_F(PortUnderFire, DropsGarbageOfEveryLength) {
  Random random(3);
  for (std::size_t length = 0; length <= 600; ++length) {
    std::vector<std::byte> bytes(length);
    for (auto& b : bytes) b = std::byte(random.next());
    Rejection reason = Rejection::kVersion;
    if (length < 34 || length > 508) {
      reason = Rejection::kLength;
    } else if (bytes[0] == std::byte{kWireVersion}) {
      reason = bytes[1] == std::byte{1} ? Rejection::kSession : Rejection::kType;
    }
    expect_slave_drops(bytes, reason, "garbage of " + std::to_string(length));
  }
}

TEST_F(PortUnderFire, DropsGarbageBehindAHeaderThatIsRight) {
  Random random(4);
  for (std::size_t length = 34; length <= 508; ++length) {
    std::vector<std::byte> bytes(length);
    for (auto& b : bytes) b = std::byte(random.next());
    write_header({DatagramType::kMotionCommand, samples::session().number, 11}, bytes);
    expect_slave_drops(bytes, Rejection::kAuthentication, "garbage of " + std::to_string(length));
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
    const auto reason = length < 34 ? Rejection::kLength : Rejection::kAuthentication;
    expect_slave_drops(std::span(whole).first(length), reason, "cut to " + std::to_string(length));
  }
  auto longer = whole;
  longer.push_back(std::byte{0});
  expect_slave_drops(longer, Rejection::kAuthentication, "one byte too long");
}

/// Which check sees bit `bit` of a datagram with sequence 11 behind one with 10; `type`: as it is with the
/// flip.
Rejection check_of(std::size_t bit, std::byte type, bool to_slave) {
  const bool taken = to_slave ? type == std::byte{1} : type >= std::byte{2} && type <= std::byte{4};
  if (bit < 8) return Rejection::kVersion;
  if (!taken) return Rejection::kType;
  if (bit >= 16 && bit < 80) return Rejection::kSession;
  // 11 is 0b1011: without its lowest bit it is 10, which was there already.
  return bit == 136 && type < std::byte{3} ? Rejection::kReplay : Rejection::kAuthentication;
}

TEST_F(PortUnderFire, DropsEverySingleBitFlip) {
  const auto flip_all = [](std::vector<std::byte> bytes, auto expect) {
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
      bytes[bit / 8] ^= std::byte(1u << (bit % 8));
      expect(bytes, bit);
      bytes[bit / 8] ^= std::byte(1u << (bit % 8));
    }
  };
  const auto slave_drops = [&](const auto& bytes, std::size_t bit) {
    expect_slave_drops(bytes, check_of(bit, bytes[1], true), "bit " + std::to_string(bit));
  };
  const auto master_drops = [&](const auto& bytes, std::size_t bit) {
    expect_master_drops(bytes, check_of(bit, bytes[1], false), "bit " + std::to_string(bit));
  };
  flip_all(datagram(samples::command(), 11), slave_drops);
  flip_all(datagram(samples::turn(), 11), slave_drops);
  flip_all(datagram(samples::extreme_command(), 11), slave_drops);
  flip_all(datagram(samples::report(), 11), master_drops);
  flip_all(datagram(samples::telemetry(), 11), master_drops);
  flip_all(datagram(samples::extreme_telemetry(), 11), master_drops);
  flip_all(datagram(samples::extreme_body_poses(), 11), master_drops);
}

TEST_F(PortUnderFire, TheLargestDatagramsFit508Bytes) {
  EXPECT_LE(samples::body_of(samples::extreme_command(), samples::extreme_stamp()).size() + 34, 508u);
  EXPECT_LE(samples::body_of(samples::extreme_report(), samples::extreme_stamp()).size() + 34, 508u);
  EXPECT_LE(samples::body_of(samples::extreme_telemetry(), samples::extreme_stamp()).size() + 34, 508u);
  EXPECT_LE(samples::body_of(samples::extreme_body_poses(), samples::extreme_stamp()).size() + 34, 508u);
}

TEST_F(PortUnderFire, DropsWhatThisSideItselfHasSealed) {
  // Reflected as it is, and with another type written over it.
  auto reflected = datagram(samples::command(), 11);
  expect_master_drops(reflected, Rejection::kType, "reflected");
  for (const int type : {2, 3, 4}) {
    reflected[1] = static_cast<std::byte>(type);
    expect_master_drops(reflected, Rejection::kAuthentication, "reflected as type " + std::to_string(type));
  }
  // Sealed with the right secret, type and number, but with the key of the other direction.
  auto own = std::vector<std::byte>(34 + 40);
  write_header({DatagramType::kStiffnessReport, samples::session().number, 11}, own);
  Seal(samples::session(), Way::kToSlave)
      .close({2, 11}, std::span(own).first(18), std::span(own).subspan(18));
  expect_master_drops(own, Rejection::kAuthentication, "key of the other direction");
}

TEST_F(PortUnderFire, DropsWhatIsSealedWithAnotherSecretOrCipher) {
  Session forged = samples::session();
  forged.secret[31] ^= std::byte{0x80};
  expect_slave_drops(datagram(samples::command(), 11, forged), Rejection::kAuthentication,
                     "one bit of the secret");
  if (has_aes256gcm()) {
    const Session other = samples::session(samples::session().number, Cipher::kAes256Gcm);
    expect_slave_drops(datagram(samples::command(), 11, other), Rejection::kAuthentication, "other cipher");
  }
}

TEST_F(PortUnderFire, DropsWhatTheOtherSideReceives) {
  expect_slave_drops(datagram(samples::report(), 11), Rejection::kType, "report to the slave");
  expect_slave_drops(datagram(samples::telemetry(), 11), Rejection::kType, "telemetry to the slave");
  expect_slave_drops(datagram(samples::body_poses(), 11), Rejection::kType, "bodies to the slave");
  expect_master_drops(datagram(samples::command(), 11), Rejection::kType, "command to the master");
}

TEST_F(PortUnderFire, DropsAReplay) {
  expect_slave_drops(datagram(samples::command(), 10), Rejection::kReplay, "replay");
  expect_slave_drops(datagram(samples::command(), 0), Rejection::kReplay, "sequence 0");
  expect_master_drops(datagram(samples::report(), 10), Rejection::kReplay, "replay");
}

TEST_F(PortUnderFire, DropsEveryOtherSession) {
  const std::uint64_t number = samples::session().number;
  for (const std::uint64_t other : {number - 1, number + 1, std::uint64_t{0}, ~std::uint64_t{0}}) {
    expect_slave_drops(datagram(samples::command(), 11, samples::session(other)), Rejection::kSession,
                       "session " + std::to_string(other));
  }
}

TEST_F(PortUnderFire, AForgedNumberIsNotUsedUp) {
  auto forged = datagram(samples::command(), 4'000'000'000);
  forged.back() ^= std::byte{1};
  expect_slave_drops(forged, Rejection::kAuthentication, "far ahead");
  deliver_to_slave(datagram(samples::command(), 11));
  ASSERT_EQ(slave_.commands().size(), 1u);
  EXPECT_EQ(slave_.commands()[0].sequence, 11u);
}

/// What the other side has sealed and yet cannot be meant: it uses up its number and says nothing.
class PortWithAFaultyPeer : public PortUnderFire {
 protected:
  void expect_unread(std::span<const std::byte> bytes, Rejection reason) {
    const std::optional<Time> heard = slave_.endpoint().monitor().last_heard();
    RejectionCounts counts = slave_.rejected();
    ++counts[static_cast<std::size_t>(reason)];
    deliver_to_slave(bytes);
    EXPECT_EQ(slave_.rejected(), counts) << to_string(reason);
    EXPECT_TRUE(slave_.commands().empty());
    EXPECT_EQ(slave_.endpoint().monitor().last_heard(), heard);
    ++counts[static_cast<std::size_t>(Rejection::kReplay)];
    deliver_to_slave(bytes);
    EXPECT_EQ(slave_.rejected(), counts) << "the second time";
  }
};

TEST_F(PortWithAFaultyPeer, BodiesOfAnotherMessageAreNotRead) {
  const auto body = std::string("\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff");
  expect_unread(samples::sealed(DatagramType::kMotionCommand, 11, body), Rejection::kDecode);
  expect_unread(samples::sealed(DatagramType::kMotionCommand, 12, std::string{}), Rejection::kValue);
}

TEST_F(PortWithAFaultyPeer, ImpossibleValuesAreNotRead) {
  MotionCommand command = samples::command();
  command.position_m.x() = std::numeric_limits<double>::quiet_NaN();
  expect_unread(datagram(command, 11), Rejection::kValue);
  command = samples::command();
  command.scale = 5.0;
  expect_unread(datagram(command, 12), Rejection::kValue);
  StiffnessReport report = samples::report();
  report.translation.surfaces[0].stiffness = 1e13;
  deliver_to_master(datagram(report, 11));
  Telemetry telemetry = samples::telemetry();
  telemetry.F_E_W.force.z() = -std::numeric_limits<double>::infinity();
  deliver_to_master(datagram(telemetry, 11));
  deliver_to_master(samples::sealed(DatagramType::kBodyPoses, 11, std::string("\x22\x01\x09", 3)));
  EXPECT_TRUE(master_.reports().empty() && master_.telemetry().empty() && master_.bodies().empty());
  EXPECT_EQ(master_.rejected()[static_cast<std::size_t>(Rejection::kValue)], 3u);
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

template <class Items>
void expect_the_newest_of_300(const Items& items) {
  ASSERT_EQ(items.size(), 256u);
  EXPECT_EQ(items.front().sequence, 145u);
  EXPECT_EQ(items.back().sequence, 400u);
}

TEST_F(PortUnderFire, KeepsTheNewestWhenMoreArriveThanAreKept) {
  for (std::uint64_t i = 1; i <= 300; ++i) {
    to_slave_.a().send(datagram(samples::command(), 100 + i));
    to_master_.a().send(datagram(samples::report(), 100 + i));
    to_master_.a().send(datagram(samples::telemetry(), 100 + i));
    to_master_.a().send(datagram(samples::body_poses(), 100 + i));
  }
  slave_.receive(now_);
  master_.receive(now_);
  expect_the_newest_of_300(slave_.commands());
  expect_the_newest_of_300(master_.reports());
  expect_the_newest_of_300(master_.telemetry());
  expect_the_newest_of_300(master_.bodies());
  slave_.receive(now_);
  master_.receive(now_);
  EXPECT_TRUE(slave_.commands().empty());
  EXPECT_TRUE(master_.reports().empty());
  EXPECT_TRUE(master_.telemetry().empty());
  EXPECT_TRUE(master_.bodies().empty());
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
  MasterPort master(channels.a(), ImpairmentConfig{}, Random(1));
  SlavePort slave(channels.b(), ImpairmentConfig{}, Random(2));
  master.follow(samples::session());
  slave.follow(samples::session());
  master.send(at_ms(100), 1, samples::command());
  slave.receive(at_ms(5000));  // the two clocks have nothing in common
  ASSERT_EQ(slave.commands().size(), 1u);
  EXPECT_EQ(slave.commands()[0].message.position_m, samples::command().position_m);
  EXPECT_EQ(slave.commands()[0].sent, PeerTime(std::chrono::milliseconds(100)));
  EXPECT_EQ(slave.commands()[0].received, at_ms(5000));
  EXPECT_FALSE(slave.commands()[0].echo_sent);
  slave.send(at_ms(5030), 1, samples::report());
  slave.send(at_ms(5030), 1, samples::telemetry());
  slave.send(at_ms(5030), 1, samples::body_poses());
  master.receive(at_ms(170));
  ASSERT_EQ(master.reports().size(), 1u);
  ASSERT_EQ(master.telemetry().size(), 1u);
  ASSERT_EQ(master.bodies().size(), 1u);
  EXPECT_EQ(master.bodies()[0].message.body[4]->age_s, 0.375);
  EXPECT_EQ(master.reports()[0].echo_sent, at_ms(100));
  EXPECT_NEAR(master.endpoint().monitor().figures(at_ms(170)).rtt_s.value(), 0.040, 1e-9);
}

TEST(Ports, DelayWhatTheyReceiveByTheImpairment) {
  MemoryChannelPair channels;
  MasterPort master(channels.a(), ImpairmentConfig{}, Random(1));
  ImpairmentConfig late;
  late.delay_s = 1.3;
  SlavePort slave(channels.b(), late, Random(2));
  master.follow(samples::session());
  slave.follow(samples::session());
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
  MasterPort master(channels.a(), ImpairmentConfig{}, Random(1));
  ImpairmentConfig corrupting;
  corrupting.corrupt = 1.0;
  SlavePort slave(channels.b(), corrupting, Random(2));
  master.follow(samples::session());
  slave.follow(samples::session());
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
}  // namespace longreach::port_test
