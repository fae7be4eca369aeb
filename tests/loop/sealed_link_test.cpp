// What the network, or somebody on it, can do to a motion: delay it, and nothing else.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "common/config/config.hpp"
#include "deploy/lab/campaign_size.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/laboratory.hpp"
#include "tests/property/intruder.hpp"

namespace longreach::sealed_link_test {
namespace {

constexpr double kEngaged_s = 6.0;  // the hand waits until both sides are engaged, however the link is
constexpr double kMoved_s = 12.0;

/// Hand through a curve, then at rest; both sides engage at the start.
class CurvedRun {
 public:
  CurvedRun(const ImpairmentConfig& impairment, std::uint64_t seed) {
    const proto::LabConfig config =
        configure({"scene_file=scenes/free.txtpb", "safety.engage_at_start=true"}, LONGREACH_DEPLOY);
    MasterConfig master = to_struct(config.master());
    SlaveConfig slave = to_struct(config.slave());
    master.link.impairment = slave.link.impairment = impairment;
    lab_ = std::make_unique<Laboratory>(master, slave, seed);
  }

  Laboratory& lab() { return *lab_; }

  void step() {
    const double t_s = std::clamp(lab_->now_s() - kEngaged_s, 0.0, kMoved_s - kEngaged_s);
    HandTarget target;
    target.position_m = {0.03 * std::sin(1.3 * t_s), 0.02 * std::sin(2.1 * t_s), 0.01 * std::sin(0.7 * t_s)};
    lab_->drive(target);
    lab_->step();
  }
  void run_until(double end_s) {
    while (lab_->now_s() < end_s) step();
  }

  [[nodiscard]] double goal_error_m() const {
    const SlaveView& slave = lab_->slave();
    return (slave.X_WE_goal.p - slave.X_WE_anchor.p - lab_->master().goal_m).norm();
  }
  [[nodiscard]] double tool_error_m() const {
    const SlaveView& slave = lab_->slave();
    return (slave.X_WE.p - slave.X_WE_anchor.p - lab_->master().goal_m).norm();
  }

 private:
  std::unique_ptr<Laboratory> lab_;
};

TEST(SealedLink, CombinedImpairmentsLoseNoMotion) {
  const auto seeds = static_cast<std::uint64_t>(campaign(100, 3));
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    CurvedRun curved_run(
        {.delay_s = 0.3, .jitter_s = 0.02, .loss = 0.3, .duplicate = 0.2, .reorder = 0.2, .corrupt = 0.2},
        seed);
    curved_run.run_until(30.0);
    const Laboratory& lab = curved_run.lab();
    ASSERT_EQ(lab.slave().state, SafetyState::kEngaged) << "seed " << seed;
    EXPECT_GT(lab.master().goal_m.norm(), 0.02) << "seed " << seed;
    EXPECT_LE(curved_run.goal_error_m(), 1e-9) << "seed " << seed;
    EXPECT_LE(curved_run.tool_error_m(), 1e-9) << "seed " << seed;
    EXPECT_EQ(lab.slave().engagement, 1u) << "seed " << seed;
    // The link was as bad as it was asked to be.
    EXPECT_GT(lab.slave_port().rejected()[static_cast<std::size_t>(Rejection::kReplay)], 500u);
    EXPECT_GT(lab.slave_port().rejected_total(), 1000u);
    EXPECT_LT(lab.slave_port().accepted_total(), 6000u);
  }
}

/// Takes what each side has sent, and passes it on between copies, old datagrams and forged ones.
class Replayer : public FaultHooks {
 public:
  void on_wire(MemoryChannelPair& wire) override {
    inject(wire.b(), wire.a(), to_slave_, to_master_);
    inject(wire.a(), wire.b(), to_master_, to_slave_);
  }

 private:
  void inject(Channel& at, Channel& from, Intruder& forwards, Intruder& backwards) {
    std::array<std::byte, kDatagramMaxBytes> buffer{};
    while (const auto size = at.receive(buffer))
      pending_.emplace_back(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(*size));
    for (const auto& bytes : pending_) {
      forwards.receive_towards(bytes);
      backwards.receive_from(bytes);
      from.send(bytes);
      from.send(bytes);
    }
    const bool heard = !pending_.empty();
    pending_.clear();
    if (heard && ++received_ > 100)
      for (int k = 0; k < static_cast<int>(Attack::kCount); ++k)
        from.send(forwards.make(static_cast<Attack>(k)));
  }

  Intruder to_slave_{Random(11)}, to_master_{Random(12)};
  std::vector<std::vector<std::byte>> pending_;
  int received_ = 0;
};

TEST(SealedLink, CopiesAndForgedDatagramsLeaveTheTrajectoryAsItIs) {
  const ImpairmentConfig far{.delay_s = 0.3};
  CurvedRun quiet(far, 1), injected(far, 1);
  Replayer replayer;
  injected.lab().set_fault_hooks(replayer);
  while (quiet.lab().now_s() < 14.0) {
    quiet.step();
    injected.step();
    const double t_s = quiet.lab().now_s();
    ASSERT_EQ(quiet.lab().slave().X_WE.p, injected.lab().slave().X_WE.p) << t_s;
    ASSERT_EQ(quiet.lab().slave().X_WE.q.coeffs(), injected.lab().slave().X_WE.q.coeffs()) << t_s;
    ASSERT_EQ(quiet.lab().slave().X_WE_goal.p, injected.lab().slave().X_WE_goal.p) << t_s;
    ASSERT_EQ(quiet.lab().master().F_H_M.force, injected.lab().master().F_H_M.force) << t_s;
    ASSERT_EQ(quiet.lab().master().state, injected.lab().master().state) << t_s;
  }
  EXPECT_EQ(quiet.lab().slave_port().accepted_total(), injected.lab().slave_port().accepted_total());
  EXPECT_EQ(quiet.lab().master_port().accepted_total(), injected.lab().master_port().accepted_total());
  EXPECT_GT(injected.lab().slave_port().rejected_total(), 10'000u);
  EXPECT_GT(injected.lab().master_port().rejected_total(), 1'000u);
  EXPECT_EQ(quiet.lab().slave_port().rejected_total(), 0u);
}

}  // namespace
}  // namespace longreach::sealed_link_test
