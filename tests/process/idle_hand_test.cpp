// The real programs while nobody touches the keys: the hand is quiet, and no energy comes out of it.
// LONGREACH_FULL: ten minutes instead of 20 s.

#include <pty.h>
#include <unistd.h>

#include <algorithm>
#include <thread>

#include "deploy/lab/campaign_size.hpp"
#include "tests/process/load.hpp"
#include "tests/support/station.hpp"

namespace longreach::idle_hand_test {
namespace {

using std::chrono::seconds;

constexpr double kRipple_n = 0.02;
// Friction of position mode, and the longest way of the handle within one count of every encoder.
constexpr double kStiffness_n_per_m = 1000.0, kCount_m = 1.7e-5;
constexpr double kEnergy_j = 1e-4;

/// A keyboard that nobody types on: it has to be a terminal.
class IdleHand : public Station {
 protected:
  IdleHand() { EXPECT_EQ(::openpty(&outer_, &inner_, nullptr, nullptr, nullptr), 0); }
  ~IdleHand() override {
    ::close(outer_);
    ::close(inner_);
  }

  struct Watched {
    int pictures = 0, left = 0;
    std::ptrdiff_t damped = 0;
    double low_n = 1e9, high_n = 0.0, highest_j = -1e9, fallen_j = 0.0;
  };

  /// What the master reports of its hand, for so long, or until it is no longer engaged.
  Watched watch(seconds time) {
    Watched seen;
    const auto end = std::chrono::steady_clock::now() + time;
    while (seen.left == 0 && std::chrono::steady_clock::now() < end) {
      const auto now = master_.status();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      if (!now) continue;
      ++seen.pictures;
      seen.left += now->state() != "Engaged";
      seen.damped += std::ranges::count(now->clamped(), "energy at the hand");
      seen.low_n = std::min(seen.low_n, now->force_n());
      seen.high_n = std::max(seen.high_n, now->force_n());
      seen.highest_j = std::max(seen.highest_j, now->energy_j());
      seen.fallen_j = std::max(seen.fallen_j, seen.highest_j - now->energy_j());
    }
    return seen;
  }

  int outer_ = -1, inner_ = -1;
};

TEST_F(IdleHand, IsQuietAndGetsNoEnergyWhileNobodyTouchesAKey) {
  start_slave();
  start_master({"--operator", "keyboard", "--engage", "--profile", "lab"}, {.in = inner_});
  Watched seen;
  // A stall of the machine is a hold: after one that a loop without work saw, too, the time starts again.
  for (bool stalled = true; stalled;) {
    ASSERT_TRUE(engaged()) << outputs();
    std::this_thread::sleep_for(seconds(2));
    BareLoops machine;
    seen = watch(seconds(campaign(600, 20)));
    stalled = seen.left > 0 && machine.end().stalls > 0;
  }
  EXPECT_GT(seen.pictures, 100);
  EXPECT_EQ(seen.left, 0) << outputs();
  EXPECT_EQ(seen.damped, 0);
  EXPECT_LE(seen.high_n - seen.low_n, kRipple_n + kStiffness_n_per_m * kCount_m);
  EXPECT_LE(seen.fallen_j, kEnergy_j);
  const auto last = master_.status();
  ASSERT_TRUE(last) << outputs();
  EXPECT_GE(last->energy_min_j(), -kEnergy_j);
}

}  // namespace
}  // namespace longreach::idle_hand_test
