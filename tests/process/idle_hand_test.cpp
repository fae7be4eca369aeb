// The real programs while nobody touches the keys: the hand is quiet, and no energy comes out of it.
// LONGREACH_FULL: ten minutes instead of one.

#include <pty.h>
#include <unistd.h>

#include <algorithm>
#include <thread>

#include "tests/process/station.hpp"
#include "tests/property/campaign.hpp"

namespace longreach {
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

  /// What the master tells of its hand, as long as it lasts.
  void watch(seconds time) {
    const auto end = std::chrono::steady_clock::now() + time;
    while (std::chrono::steady_clock::now() < end) {
      const auto now = master_.status();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      if (!now) continue;
      ++pictures_;
      left_ += now->state() != "Engaged";
      damped_ += std::ranges::count(now->clamped(), "energy at the hand");
      low_n_ = std::min(low_n_, now->force_n());
      high_n_ = std::max(high_n_, now->force_n());
      highest_j_ = std::max(highest_j_, now->energy_j());
      fallen_j_ = std::max(fallen_j_, highest_j_ - now->energy_j());
    }
  }

  int outer_ = -1, inner_ = -1;
  int pictures_ = 0, left_ = 0;
  std::ptrdiff_t damped_ = 0;
  double low_n_ = 1e9, high_n_ = 0.0, highest_j_ = -1e9, fallen_j_ = 0.0;
};

TEST_F(IdleHand, IsQuietAndGetsNoEnergyWhileNobodyTouchesAKey) {
  start_slave();
  start_master({"--operator", "keyboard", "--engage", "--profile", "lab"}, {.in = inner_});
  ASSERT_TRUE(both_engaged()) << outputs();
  std::this_thread::sleep_for(seconds(2));
  watch(seconds(campaign(600, 60)));
  EXPECT_GT(pictures_, 100);
  EXPECT_EQ(left_, 0) << outputs();
  EXPECT_EQ(damped_, 0);
  EXPECT_LE(high_n_ - low_n_, kRipple_n + kStiffness_n_per_m * kCount_m);
  EXPECT_LE(fallen_j_, kEnergy_j);
  const auto last = master_.status();
  ASSERT_TRUE(last) << outputs();
  EXPECT_GE(last->energy_min_j(), -kEnergy_j);
}

}  // namespace
}  // namespace longreach
