#include "common/link/endpoint.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace longreach {
namespace {

using std::chrono::milliseconds;

constexpr std::uint64_t kOwn = 1000;
constexpr auto kType = DatagramType::kTelemetry;
constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();

Time at(double s) { return Time{from_seconds(s)}; }
PeerTime peer(double s) { return PeerTime{from_seconds(s)}; }

struct Outcome {
  std::optional<Rejection> rejection{};
  Endpoint::Accepted accepted{};
};

Outcome receive(Endpoint& endpoint, Time now, const Header& header, const Stamp& stamp = {}) {
  const auto result = endpoint.commit(now, header, stamp, 100);
  if (const auto* rejection = std::get_if<Rejection>(&result)) return {.rejection = *rejection};
  return {.accepted = std::get<Endpoint::Accepted>(result)};
}

TEST(Endpoint, FollowsTheRulesOfSessions) {
  struct Row {
    std::string rule;
    double silent_s;
    std::uint64_t session;
    bool accepted;
    std::uint32_t restarts;
  };
  const Row rows[] = {
      {"the same session goes on", 0.001, 50, true, 0},
      {"the same session goes on after a long silence", 1e6, 50, true, 0},
      {"a greater session replaces at once", 0.0, 51, true, 1},
      {"the greatest session, too", 0.0, std::numeric_limits<std::uint64_t>::max(), true, 1},
      {"a smaller one is refused at once", 0.0, 49, false, 0},
      {"a smaller one is refused until 1 s of silence", 0.999999, 49, false, 0},
      {"a smaller one is followed after 1 s of silence", 1.0, 49, true, 1},
      {"no session is never followed", 100.0, 0, false, 0},
  };
  for (const Row& row : rows) {
    Endpoint endpoint(kOwn);
    ASSERT_FALSE(receive(endpoint, at(10.0), {kType, 50, 1}).rejection);
    const Header next{kType, row.session, 2};
    const auto judged = endpoint.judge(at(10.0 + row.silent_s), next);
    EXPECT_EQ(judged, row.accepted ? std::nullopt : std::optional(Rejection::kSession)) << row.rule;
    const Outcome outcome = receive(endpoint, at(10.0 + row.silent_s), next);
    EXPECT_EQ(outcome.rejection, judged) << row.rule;
    EXPECT_EQ(endpoint.peer_session(), row.accepted ? row.session : 50) << row.rule;
    EXPECT_EQ(endpoint.peer_restarts(), row.restarts) << row.rule;
    if (row.accepted) {
      EXPECT_EQ(outcome.accepted.new_session, row.session != 50) << row.rule;
    }
  }
}

TEST(Endpoint, TheFirstSessionIsNoRestart) {
  Endpoint endpoint(kOwn);
  EXPECT_EQ(endpoint.peer_session(), 0U);
  const Outcome first = receive(endpoint, at(1.0), {kType, 7, 100});
  EXPECT_TRUE(first.accepted.new_session);
  EXPECT_TRUE(first.accepted.newest);
  EXPECT_EQ(endpoint.peer_restarts(), 0U);
}

TEST(Endpoint, JudgingChangesNothing) {
  Endpoint endpoint(kOwn);
  EXPECT_FALSE(endpoint.judge(at(1.0), {kType, 7, 1}));
  EXPECT_EQ(endpoint.peer_session(), 0U);
  EXPECT_FALSE(endpoint.monitor().last_heard());
}

TEST(Endpoint, RefusesReplaysAndLeavesNoTraceOfThem) {
  Endpoint endpoint(kOwn);
  ASSERT_FALSE(receive(endpoint, at(1.0), {kType, 7, 9000}).rejection);
  EXPECT_EQ(receive(endpoint, at(2.0), {kType, 7, 9000}).rejection, Rejection::kReplay);
  EXPECT_EQ(receive(endpoint, at(2.0), {kType, 7, 9000 - 8192}).rejection, Rejection::kReplay);
  EXPECT_EQ(receive(endpoint, at(2.0), {kType, 7, 0}).rejection, Rejection::kReplay);
  EXPECT_EQ(receive(endpoint, at(2.0), {kType, 8, 0}).rejection, Rejection::kReplay);
  EXPECT_EQ(endpoint.peer_session(), 7U);
  EXPECT_EQ(endpoint.monitor().last_heard(), at(1.0));
  EXPECT_FALSE(receive(endpoint, at(2.0), {kType, 7, 9000 - 8191}).rejection);
}

TEST(Endpoint, RefusesATypeThatDoesNotExist) {
  Endpoint endpoint(kOwn);
  for (const int type : {0, 4, 255}) {
    EXPECT_EQ(receive(endpoint, at(1.0), {static_cast<DatagramType>(type), 7, 1}).rejection,
              Rejection::kType);
  }
}

TEST(Endpoint, EachTypeHasItsOwnNumbers) {
  Endpoint endpoint(kOwn);
  for (const auto type :
       {DatagramType::kMotionCommand, DatagramType::kStiffnessReport, DatagramType::kTelemetry}) {
    EXPECT_TRUE(receive(endpoint, at(1.0), {type, 7, 5}).accepted.newest);
    EXPECT_FALSE(receive(endpoint, at(1.0), {type, 7, 4}).accepted.newest);
    EXPECT_TRUE(receive(endpoint, at(1.0), {type, 7, 6}).accepted.newest);
  }
}

TEST(Endpoint, ANewSessionStartsWithCleanWindowsAndFigures) {
  Endpoint endpoint(kOwn);
  for (std::uint64_t i = 1; i <= 20; ++i)
    ASSERT_FALSE(receive(endpoint, at(1.0), {kType, 7, 10 * i}).rejection);
  ASSERT_GT(endpoint.monitor().figures(at(1.0)).rate_hz, 15.0);
  ASSERT_FALSE(receive(endpoint, at(1.0), {kType, 8, 10}).rejection);
  EXPECT_NEAR(endpoint.monitor().figures(at(1.0)).rate_hz, 10.0,
              1e-9);  // one, over the shortest span of 0.1 s
  EXPECT_EQ(endpoint.monitor().figures(at(1.0)).loss, 0.0);
}

TEST(Endpoint, NumbersAndStampsWhatLeaves) {
  Endpoint endpoint(kOwn);
  const Header header = endpoint.header_for(DatagramType::kMotionCommand, 33);
  EXPECT_EQ(header.type, DatagramType::kMotionCommand);
  EXPECT_EQ(header.session, kOwn);
  EXPECT_EQ(header.sequence, 33U);
  const Stamp unheard = endpoint.stamp_for(at(3.0));
  EXPECT_EQ(unheard.sent, peer(3.0));
  EXPECT_EQ(unheard.echo.session, 0U);

  (void)receive(endpoint, at(3.8), {kType, 7, 2}, {.sent = peer(78.0)});
  (void)receive(endpoint, at(4.0), {kType, 7, 1}, {.sent = peer(77.0)});  // late, but what came last
  const Stamp heard = endpoint.stamp_for(at(4.5));
  EXPECT_EQ(heard.echo.session, 7U);
  EXPECT_EQ(heard.echo.sent_ns, from_seconds(77.0).count());
  EXPECT_EQ(heard.echo.held, milliseconds(500));

  (void)receive(endpoint, at(5.0), {DatagramType::kStiffnessReport, 8, 1}, {.sent = peer(1.0)});
  EXPECT_EQ(endpoint.stamp_for(at(5.0)).echo.session, 8U);
  EXPECT_EQ(endpoint.stamp_for(at(5.0)).echo.sent_ns, from_seconds(1.0).count());
}

TEST(Endpoint, MeasuresTheRoundTripWithoutComparingClocks) {
  // A's clock reads 5000 s more than B's; 1.3 s there, 0.2 s held, 0.9 s back.
  Endpoint a(1), b(2);
  const Stamp asked = a.stamp_for(at(5010.0));
  (void)receive(b, at(11.3), a.header_for(DatagramType::kMotionCommand, 1), asked);
  const Stamp answered = b.stamp_for(at(11.5));
  const Outcome outcome = receive(a, at(5012.4), b.header_for(kType, 1), answered);
  EXPECT_EQ(outcome.accepted.echo_sent, at(5010.0));
  EXPECT_NEAR(a.monitor().figures(at(5012.4)).rtt_s.value(), 2.2, 1e-9);
}

TEST(Endpoint, IgnoresEchoesOfItsFormerSelf) {
  Endpoint endpoint(kOwn);
  const Stamp former{.sent = peer(1.0),
                     .echo = {.session = kOwn - 1, .sent_ns = 500, .held = milliseconds(1)}};
  EXPECT_FALSE(receive(endpoint, at(1.0), {kType, 7, 1}, former).accepted.echo_sent);
  const Stamp none{.sent = peer(1.0), .echo = {}};
  EXPECT_FALSE(receive(endpoint, at(1.0), {kType, 7, 2}, none).accepted.echo_sent);
  EXPECT_FALSE(endpoint.monitor().figures(at(1.0)).rtt_s);
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
                      {-kMost - 1, 0, true},     {now_ns - from_seconds(200.1).count(), 0, true}};
  std::uint64_t sequence = 0;
  Endpoint endpoint(kOwn);
  for (const Row& row : rows) {
    const Stamp stamp{.sent = PeerTime{Duration{row.sent_ns}},
                      .echo = {.session = kOwn, .sent_ns = row.sent_ns, .held = Duration{row.held_ns}}};
    const Outcome outcome = receive(endpoint, at(1000.0), {kType, 7, ++sequence}, stamp);
    EXPECT_EQ(outcome.accepted.echo_sent.has_value(), row.echo) << row.sent_ns << ' ' << row.held_ns;
    EXPECT_FALSE(endpoint.monitor().figures(at(1000.0)).rtt_s) << row.sent_ns << ' ' << row.held_ns;
  }
  const Stamp longest{.echo = {.session = kOwn, .sent_ns = from_seconds(800.0).count()}};
  (void)receive(endpoint, at(1000.0), {kType, 7, ++sequence}, longest);
  EXPECT_DOUBLE_EQ(endpoint.monitor().figures(at(1000.0)).rtt_s.value(), 200.0);
}

TEST(EndpointDeathTest, NeedsASession) { EXPECT_DEATH(Endpoint(0), "CHECK failed"); }

}  // namespace
}  // namespace longreach
