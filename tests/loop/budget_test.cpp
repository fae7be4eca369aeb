// A link of 256 kbit/s: neither side ever sends more, however often it would like to, and the wall is felt
// all the same.

#include <gtest/gtest.h>

#include <array>
#include <deque>
#include <memory>

#include "common/config/config.hpp"
#include "common/link/byte_budget.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/laboratory.hpp"

namespace longreach::budget_test {
namespace {

constexpr double kBudget_kbit_per_s = 256.0;

/// Passes on what a side sends, and knows its fullest second.
class Meter {
 public:
  void pass(Channel& at, Channel& from, double now_s) {
    while (const auto size = at.receive(buffer_)) {
      const auto datagram = std::span(buffer_).first(*size);
      waiting_.emplace_back(datagram.begin(), datagram.end());
      const double bits = 8.0 * static_cast<double>(*size + kIpUdpBytes);
      sent_.push_back({now_s, bits});
      second_ += bits;
      largest_ = std::max(largest_, bits);
    }
    for (; !sent_.empty() && sent_.front().first <= now_s - 1.0; sent_.pop_front())
      second_ -= sent_.front().second;
    fullest_ = std::max(fullest_, second_);
    for (const auto& datagram : waiting_) from.send(datagram);
    waiting_.clear();
  }
  [[nodiscard]] double fullest_kbit() const { return 1e-3 * fullest_; }
  /// 2 ms that a tick may catch up, and what one tick of the slave sends: a report and telemetry.
  [[nodiscard]] double allowed_kbit() const { return 1.002 * kBudget_kbit_per_s + 2e-3 * largest_; }

 private:
  std::array<std::byte, kDatagramMaxBytes> buffer_{};
  std::vector<std::vector<std::byte>> waiting_;
  std::deque<std::pair<double, double>> sent_;
  double second_ = 0.0, fullest_ = 0.0, largest_ = 0.0;
};

TEST(Budget, HoldsBothSidesAndTheWallIsFelt) {
  const proto::LabConfig config =
      configure({"profile=gateway", "master.link.send_hz=4000", "slave.link.telemetry_hz=60",
                 "slave.link.heartbeat_contact_hz=100", "slave.link.heartbeat_free_hz=100",
                 "master.link.budget_kbit_per_s=256", "slave.link.budget_kbit_per_s=256",
                 "safety.engage_at_start=true"},
                LONGREACH_DEPLOY);
  Laboratory lab(to_struct(config.master()), to_struct(config.slave()), 1);
  Meter up, down;
  OnWire meters([&](MemoryChannelPair& wire) {
    up.pass(wire.b(), wire.a(), lab.now_s());
    down.pass(wire.a(), wire.b(), lab.now_s());
  });
  lab.set_fault_hooks(meters);
  double felt_n_per_m = 0.0;  // last, while the wall was touched
  while (lab.now_s() < 25.0) {
    lab.step();
    if (lab.master().in_contact) felt_n_per_m = lab.master().stiffness_n_per_m;
  }
  EXPECT_LE(up.fullest_kbit(), up.allowed_kbit());
  EXPECT_LE(down.fullest_kbit(), down.allowed_kbit());
  EXPECT_GT(up.fullest_kbit(), 0.95 * kBudget_kbit_per_s);
  EXPECT_GT(down.fullest_kbit(), 0.8 * kBudget_kbit_per_s);
  EXPECT_EQ(lab.slave().state, SafetyState::kEngaged);
  EXPECT_NEAR(felt_n_per_m, 1000.0, 50.0);
  EXPECT_EQ(lab.slave().false_holds, 0u);
}

}  // namespace
}  // namespace longreach::budget_test
