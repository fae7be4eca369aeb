#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "master/master_node.hpp"

namespace longreach::late_tick_test {
namespace {

// Every tenth tick is late by most of a period, and the next one follows at once. The handle moves steadily, so that a
// damper must not notice.
TEST(LateTick, IsNoJumpOfDamping) {
  constexpr double kSpeed_m_per_s = 0.05;
  MasterConfig config;
  config.mapping.mode = MotionMode::kRate;  // the handle is damped and returned to its home position
  MasterNode node(config);
  MasterInput in;
  double before_n = 0.0, step_n = 0.0;
  for (int i = 0; i < 400; ++i) {
    in.now += std::chrono::microseconds(i % 10 == 8 ? 1900 : i % 10 == 9 ? 100 : 1000);
    in.last_heard = in.now;
    in.requests.engage = i == 0;
    in.handle.p_MH.x() = kSpeed_m_per_s * to_seconds(in.now - Time{});
    const StiffnessReport report{.engagement = node.view().engagement, .state = SafetyState::kEngaged};
    const Received<StiffnessReport> received{
        .sequence = static_cast<std::uint64_t>(i) + 1, .received = in.now, .message = report};
    in.reports = {&received, 1};
    const double force_n = node.step(in).F_H_M.force.x();
    if (i > 100) step_n = std::max(step_n, std::abs(force_n - before_n));
    before_n = force_n;
  }
  EXPECT_LT(before_n, -1.0);
  EXPECT_LT(step_n, 0.02);
}

}  // namespace
}  // namespace longreach::late_tick_test
