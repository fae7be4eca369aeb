// Without the secret, an attacker cannot make either side accept a datagram, or change anything except a counter.
// LONGREACH_FULL=1: ten million datagrams.

#include <gtest/gtest.h>

#include "common/wire/memory_channel.hpp"
#include "common/wire/port.hpp"
#include "deploy/lab/campaign_size.hpp"
#include "tests/property/intruder.hpp"
#include "tests/unit/common/wire/samples.hpp"

namespace longreach::hostile_link_test {
namespace {

class HostileLink : public ::testing::TestWithParam<Cipher> {
 protected:
  HostileLink() {
    master_.follow(samples::session(1000, GetParam()));
    slave_.follow(samples::session(1000, GetParam()));
  }

  /// Both sides talk, the intruders listen.
  void talk(std::uint64_t from, std::uint64_t to) {
    std::array<std::byte, kDatagramMaxBytes> buffer{};
    for (std::uint64_t i = from; i < to; ++i) {
      now_ = Time{std::chrono::milliseconds(i)};
      master_.send(now_, i, i % 2 == 0 ? samples::command() : samples::turn());
      const auto command = std::span(buffer).first(channels_.b().receive(buffer).value());
      at_slave_.receive_towards(command);
      at_master_.receive_from(command);
      channels_.a().send(command);
      slave_.receive(now_);
      slave_.send(now_, i, samples::report());
      slave_.send(now_, i, samples::telemetry());
      for (int k = 0; k < 2; ++k) {
        const auto answer = std::span(buffer).first(channels_.a().receive(buffer).value());
        at_master_.receive_towards(answer);
        at_slave_.receive_from(answer);
        channels_.b().send(answer);
      }
      master_.receive(now_);
    }
  }

  MemoryChannelPair channels_;
  MasterPort master_{channels_.a(), ImpairmentConfig{}, Random(1)};
  SlavePort slave_{channels_.b(), ImpairmentConfig{}, Random(2)};
  Intruder at_slave_{Random(3)};
  Intruder at_master_{Random(4)};
  Time now_{};
};

TEST_P(HostileLink, AcceptsNothingAndChangesNothing) {
  talk(1, 200);
  const Endpoint master = master_.endpoint(), slave = slave_.endpoint();
  const std::uint64_t accepted = master_.accepted_total() + slave_.accepted_total();
  const int count = campaign(10'000'000, 100'000) / 2;
  constexpr int kBite = 500;
  for (int i = 0; i < count; i += 2 * kBite) {
    for (int k = 0; k < kBite; ++k) {
      const auto attack = static_cast<Attack>(k % static_cast<int>(Attack::kCount));
      channels_.a().send(at_slave_.make(attack));
      channels_.b().send(at_master_.make(attack));
    }
    slave_.receive(now_);
    master_.receive(now_);
    ASSERT_TRUE(slave_.commands().empty() && master_.reports().empty() && master_.telemetry().empty() &&
                master_.bodies().empty())
        << i;
  }
  EXPECT_EQ(master_.accepted_total() + slave_.accepted_total(), accepted);
  EXPECT_EQ(master_.rejected_total() + slave_.rejected_total(), static_cast<std::uint64_t>(count));
  EXPECT_TRUE(master_.endpoint() == master);
  EXPECT_TRUE(slave_.endpoint() == slave);
  // Each kind has met the check that is for it.
  for (const Rejection reason :
       {Rejection::kLength, Rejection::kType, Rejection::kReplay, Rejection::kAuthentication})
    EXPECT_GT(slave_.rejected()[static_cast<std::size_t>(reason)], 1000u) << to_string(reason);
  // And they still understand each other.
  talk(200, 210);
  EXPECT_EQ(master_.accepted_total() + slave_.accepted_total(), accepted + 30);
}

INSTANTIATE_TEST_SUITE_P(Ciphers, HostileLink,
                         ::testing::ValuesIn(has_aes256gcm()
                                                 ? std::vector{Cipher::kChaCha20Poly1305, Cipher::kAes256Gcm}
                                                 : std::vector{Cipher::kChaCha20Poly1305}));

}  // namespace
}  // namespace longreach::hostile_link_test
