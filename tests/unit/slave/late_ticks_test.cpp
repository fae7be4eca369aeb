// A starved program ticks late and irregularly: the limits hold all the same, and what was missed is caught
// up.

#include <gtest/gtest.h>

#include "common/core/random.hpp"
#include "slave/simulation/simulated_arm.hpp"
#include "slave/slave_node.hpp"
#include "tests/unit/slave/space_arm.hpp"

namespace longreach::late_ticks_test {
namespace {

TEST(SlaveNode, KeepsItsLimitsWhenTicksAreLate) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    const SlaveConfig config = test::wall_config(10.0, 1000.0);
    SlaveNode node(config);
    SimulatedArm arm(config, random.child("arm"));
    Received<MotionCommand> received;
    received.message.request = Request::kEngage;
    received.message.engagement = 1;
    Time now{std::chrono::seconds(1)};
    for (int i = 0; i < 8000; ++i) {
      now += random.chance(0.02) ? from_seconds(random.uniform(0.002, 0.06)) : std::chrono::milliseconds(1);
      const double t = to_seconds(now.time_since_epoch()) - 1.0;
      received.message.position_m.x() = t < 2.0 ? 0.0 : t < 4.0 ? 0.1 * (t - 2.0) : 0.2;
      received.sequence = static_cast<std::uint64_t>(i) + 1;
      received.received = now;
      received.sent = PeerTime{now.time_since_epoch()};
      received.echo_sent = now;
      SlaveInput in;
      in.now = now;
      in.robot = arm.read(now);
      in.commands = {&received, 1};
      in.last_heard = now;
      in.peer_session_count = 1;
      arm.write(node.step(in).joint_setpoint_rad);
    }
    EXPECT_EQ(node.view().limit_violations, 0U) << "seed " << seed;
    EXPECT_NEAR((arm.true_pose().p - arm.start_pose().p).x(), 0.2, 1e-6) << "seed " << seed;
  }
}

}  // namespace
}  // namespace longreach::late_ticks_test
