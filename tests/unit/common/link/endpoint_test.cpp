#include "common/link/endpoint.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace longreach::endpoint_test {
namespace {

using std::chrono::milliseconds;

constexpr std::uint64_t kSession = 1000;
constexpr auto kType = DatagramType::kTelemetry;
constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();

Time at(double s) { return Time{from_seconds(s)}; }
PeerTime peer(double s) { return PeerTime{from_seconds(s)}; }

struct Outcome {
  std::optional<Rejection> rejection{};
  bool newest = false;
  std::optional<Time> echo_sent{};
};

/// All that a port does with an authentic datagram.
Outcome receive(Endpoint& endpoint, Time now, const Header& header, const Stamp& stamp = {}) {
  if (const auto rejection = endpoint.judge(header)) return {.rejection = rejection};
  const bool newest = endpoint.mark(header);
  endpoint.learn(now, header, stamp, 100);
  return {.newest = newest, .echo_sent = echo_sent(now, stamp)};
}

Endpoint following(std::uint64_t session) {
  Endpoint endpoint;
  endpoint.follow(session);
  return endpoint;
}

TEST(Endpoint, TakesAndSendsNothingWithoutASession) {
  Endpoint endpoint;
  EXPECT_EQ(endpoint.session(), 0U);
  for (const std::uint64_t session : {0, 1}) {
    EXPECT_EQ(endpoint.judge({kType, session, 1}), Rejection::kSession);
  }
  EXPECT_FALSE(endpoint.number(kType, 1));
  EXPECT_EQ(endpoint.sessions(), 0U);
}

TEST(Endpoint, HearsAndNumbersNothingOnceItHasLeft) {
  Endpoint endpoint = following(kSession);
  ASSERT_FALSE(receive(endpoint, at(1.0), {kType, kSession, 1}).rejection);
  endpoint.leave();
  for (const std::uint64_t session : {std::uint64_t{0}, kSession})
    EXPECT_EQ(endpoint.judge({kType, session, 2}), Rejection::kSession);
  EXPECT_FALSE(endpoint.number(kType, 2));
  EXPECT_FALSE(endpoint.monitor().last_heard());
  EXPECT_EQ(endpoint.sessions(), 1U);
}

TEST(Endpoint, TakesItsOwnSessionOnly) {
  const Endpoint endpoint = following(kSession);
  EXPECT_FALSE(endpoint.judge({kType, kSession, 1}));
  for (const std::uint64_t session : {std::uint64_t{0}, kSession - 1, kSession + 1, ~std::uint64_t{0}}) {
    EXPECT_EQ(endpoint.judge({kType, session, 1}), Rejection::kSession) << session;
  }
}

TEST(Endpoint, TheFirstSessionIsNoRestart) {
  Endpoint endpoint = following(7);
  EXPECT_EQ(endpoint.sessions(), 1U);
  EXPECT_EQ(endpoint.restarts(), 0U);
  endpoint.follow(8);
  EXPECT_EQ(endpoint.sessions(), 2U);
  EXPECT_EQ(endpoint.restarts(), 1U);
}

TEST(Endpoint, RefusesReplaysAndLeavesNoTraceOfThem) {
  Endpoint endpoint = following(kSession);
  ASSERT_FALSE(receive(endpoint, at(1.0), {kType, kSession, 9000}).rejection);
  const Endpoint before = endpoint;
  for (const std::uint64_t replayed : {9000, 9000 - 8192, 0}) {
    EXPECT_EQ(receive(endpoint, at(2.0), {kType, kSession, replayed}).rejection, Rejection::kReplay)
        << replayed;
    EXPECT_TRUE(endpoint == before) << replayed;
  }
  EXPECT_FALSE(receive(endpoint, at(2.0), {kType, kSession, 9000 - 8191}).rejection);
  EXPECT_FALSE(endpoint == before);
}

TEST(Endpoint, RefusesATypeThatDoesNotExist) {
  const Endpoint endpoint = following(kSession);
  for (const int type : {0, 5, 255}) {
    EXPECT_EQ(endpoint.judge({static_cast<DatagramType>(type), kSession, 1}), Rejection::kType);
  }
}

TEST(Endpoint, EachTypeHasItsOwnNumbers) {
  Endpoint endpoint = following(kSession);
  for (const auto type : {DatagramType::kMotionCommand, DatagramType::kStiffnessReport,
                          DatagramType::kTelemetry, DatagramType::kBodyPoses}) {
    EXPECT_TRUE(receive(endpoint, at(1.0), {type, kSession, 5}).newest);
    EXPECT_FALSE(receive(endpoint, at(1.0), {type, kSession, 4}).newest);
    EXPECT_TRUE(receive(endpoint, at(1.0), {type, kSession, 6}).newest);
    EXPECT_TRUE(endpoint.number(type, 5));
    EXPECT_FALSE(endpoint.number(type, 5));
  }
}

TEST(Endpoint, ANewSessionStartsWithCleanWindowsAndFigures) {
  Endpoint endpoint = following(7);
  for (std::uint64_t i = 1; i <= 20; ++i)
    ASSERT_FALSE(receive(endpoint, at(1.0), {kType, 7, 10 * i}).rejection);
  ASSERT_TRUE(endpoint.number(kType, 100));
  ASSERT_GT(endpoint.monitor().figures(at(1.0)).rate_hz, 15.0);
  endpoint.follow(8);
  EXPECT_FALSE(endpoint.stamp_for(at(1.0)).echo);
  ASSERT_FALSE(receive(endpoint, at(1.0), {kType, 8, 10}).rejection);
  EXPECT_NEAR(endpoint.monitor().figures(at(1.0)).rate_hz, 10.0,
              1e-9);  // one, over the shortest span of 0.1 s
  EXPECT_EQ(endpoint.monitor().figures(at(1.0)).loss, 0.0);
  EXPECT_TRUE(endpoint.number(kType, 1));
}

TEST(Endpoint, NumbersAndStampsWhatLeaves) {
  Endpoint endpoint = following(kSession);
  const auto header = endpoint.number(DatagramType::kMotionCommand, 33);
  ASSERT_TRUE(header);
  EXPECT_EQ(header->type, DatagramType::kMotionCommand);
  EXPECT_EQ(header->session, kSession);
  EXPECT_EQ(header->sequence, 33U);
  const Stamp unreceived = endpoint.stamp_for(at(3.0));
  EXPECT_EQ(unreceived.sent, peer(3.0));
  EXPECT_FALSE(unreceived.echo);

  (void)receive(endpoint, at(3.8), {kType, kSession, 2}, {.sent = peer(78.0)});
  (void)receive(endpoint, at(4.0), {kType, kSession, 1}, {.sent = peer(77.0)});  // late, but what came last
  const Stamp heard = endpoint.stamp_for(at(4.5));
  ASSERT_TRUE(heard.echo);
  EXPECT_EQ(heard.echo->sent_ns, from_seconds(77.0).count());
  EXPECT_EQ(heard.echo->held, milliseconds(500));
}

TEST(Endpoint, MeasuresTheRoundTripWithoutComparingClocks) {
  // A's clock reads 5000 s more than B's; 1.3 s there, 0.2 s held, 0.9 s back.
  Endpoint a = following(kSession), b = following(kSession);
  const Stamp asked = a.stamp_for(at(5010.0));
  (void)receive(b, at(11.3), *a.number(DatagramType::kMotionCommand, 1), asked);
  const Stamp answered = b.stamp_for(at(11.5));
  const Outcome outcome = receive(a, at(5012.4), *b.number(kType, 1), answered);
  EXPECT_EQ(outcome.echo_sent, at(5010.0));
  EXPECT_NEAR(a.monitor().figures(at(5012.4)).rtt_s.value(), 2.2, 1e-9);
}

TEST(Endpoint, SurvivesHostileEchoes) {
  struct Row {
    std::int64_t sent_ns, held_ns;
    bool echo;
  };
  const std::int64_t now_ns = from_seconds(1000.0).count();
  const Row rows[] = {{kMost, 0, false},         {now_ns + 1, 0, false},
                      {-kMost - 1, kMost, true}, {-kMost - 1, -kMost, true},
                      {now_ns - 5, kMost, true}, {now_ns - 5, -kMost - 1, true},
                      {now_ns - 5, 6, true},     {now_ns - 5, -1, true},
                      {-kMost - 1, 0, true},     {now_ns - from_seconds(600.1).count(), 0, true}};
  std::uint64_t sequence = 0;
  Endpoint endpoint = following(kSession);
  EXPECT_FALSE(receive(endpoint, at(1000.0), {kType, kSession, ++sequence}).echo_sent) << "no echo";
  for (const Row& row : rows) {
    const Stamp stamp{.sent = PeerTime{Duration{row.sent_ns}},
                      .echo = Echo{row.sent_ns, Duration{row.held_ns}}};
    const Outcome outcome = receive(endpoint, at(1000.0), {kType, kSession, ++sequence}, stamp);
    EXPECT_EQ(outcome.echo_sent.has_value(), row.echo) << row.sent_ns << ' ' << row.held_ns;
    EXPECT_FALSE(endpoint.monitor().figures(at(1000.0)).rtt_s) << row.sent_ns << ' ' << row.held_ns;
  }
  const Stamp longest{.echo = Echo{.sent_ns = from_seconds(400.0).count()}};
  (void)receive(endpoint, at(1000.0), {kType, kSession, ++sequence}, longest);
  EXPECT_DOUBLE_EQ(endpoint.monitor().figures(at(1000.0)).rtt_s.value(), 600.0);
}

TEST(Endpoint, TheLastNumberOfAllIsNotUsed) {
  constexpr std::uint64_t kLast = std::numeric_limits<std::uint64_t>::max();
  Endpoint endpoint = following(7);
  EXPECT_FALSE(endpoint.number(DatagramType::kMotionCommand, kLast));
  EXPECT_TRUE(endpoint.number(DatagramType::kMotionCommand, kLast - 1));
}

TEST(EndpointDeathTest, NeedsASession) { EXPECT_DEATH(following(0), "CHECK failed"); }

}  // namespace
}  // namespace longreach::endpoint_test
