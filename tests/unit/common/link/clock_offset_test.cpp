#include "common/link/clock_offset.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace longreach::clock_offset_test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

Time at(double s) { return Time{from_seconds(s)}; }
PeerTime peer(double s) { return PeerTime{from_seconds(s)}; }

double earliest_s(const ClockOffset& offset, PeerTime sent) {
  return to_seconds(offset.earliest_arrival(sent).value().time_since_epoch());
}

TEST(ClockOffset, KnowsNothingBeforeTheFirstDatagram) {
  ClockOffset offset;
  EXPECT_FALSE(offset.earliest_arrival(peer(1.0)));
  offset.on_datagram(at(1.0), peer(0.0));
  offset.clear();
  EXPECT_FALSE(offset.earliest_arrival(peer(1.0)));
}

TEST(ClockOffset, TakesTheShortestTransit) {
  ClockOffset offset;
  offset.on_datagram(at(100.5), peer(3.0));
  offset.on_datagram(at(101.2), peer(4.0));
  offset.on_datagram(at(102.4), peer(5.0));
  EXPECT_DOUBLE_EQ(earliest_s(offset, peer(6.0)), 103.2);
}

TEST(ClockOffset, FollowsADriftOf500PartsPerMillionEitherWay) {
  for (const double drift : {5e-4, -5e-4}) {
    ClockOffset offset;
    double worst_s = 0.0;
    for (int i = 0; i < 12000; ++i) {
      const double sent_s = 0.005 * i;
      const double received_s = 50.0 + sent_s * (1.0 + drift);
      offset.on_datagram(at(received_s), peer(sent_s));
      worst_s = std::max(worst_s, received_s - earliest_s(offset, peer(sent_s)));
    }
    EXPECT_LE(worst_s, 5e-4 * 10.0 + 1e-6);  // at most the drift of one window
  }
}

TEST(ClockOffset, FollowsASlowerLinkWithinItsWindow) {
  ClockOffset offset(seconds(10));
  for (int i = 0; i < 1000; ++i) offset.on_datagram(at(0.3 + 0.01 * i), peer(0.01 * i));
  double followed_s = 0.0;
  for (int i = 1000; i < 3000 && followed_s == 0.0; ++i) {
    offset.on_datagram(at(5.3 + 0.01 * i), peer(0.01 * i));
    if (earliest_s(offset, peer(0.0)) > 5.0) followed_s = 5.3 + 0.01 * i - 10.3;
  }
  EXPECT_GT(followed_s, 4.9);
  EXPECT_LE(followed_s, 15.1);
}

TEST(ClockOffset, BelievesNothingFromBeforeALongSilence) {
  ClockOffset offset(seconds(10));
  offset.on_datagram(at(1.0), peer(0.9));
  offset.on_datagram(at(100.0), peer(99.0));
  EXPECT_DOUBLE_EQ(earliest_s(offset, peer(0.0)), 1.0);
}

TEST(ClockOffset, DoesNotOverflowOnHostileTimes) {
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  ClockOffset offset;
  offset.on_datagram(at(1.0), PeerTime{Duration{-kMost - 1}});
  EXPECT_EQ(offset.earliest_arrival(PeerTime{Duration{kMost}})->time_since_epoch().count(), kMost);
  offset.on_datagram(at(1.0), PeerTime{Duration{kMost}});
  EXPECT_LT(offset.earliest_arrival(PeerTime{Duration{-kMost - 1}})->time_since_epoch().count(), 0);
}

}  // namespace
}  // namespace longreach::clock_offset_test
