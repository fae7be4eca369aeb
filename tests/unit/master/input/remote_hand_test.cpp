#include "master/input/remote_hand.hpp"

#include <gtest/gtest.h>

namespace longreach::remote_hand_test {
namespace {

constexpr double kPeriod_s = 1e-3;

/// The hand, tick by tick, and what it was told last.
struct Handle {
  std::optional<HandTarget> tick(bool says = true) {
    in.now += from_seconds(kPeriod_s);
    if (says) in.aim.said = in.now;
    requests = {};
    return hand.step(in, requests);
  }

  RemoteHand hand{kPeriod_s};
  RemoteHandInput in{.now = Time{} + std::chrono::seconds(100)};
  OperatorRequests requests;
};

TEST(RemoteHand, LeavesTheHandleToOthersUntilItIsThere) {
  Handle h;
  EXPECT_FALSE(h.tick());
  h.in.aim.holds = true;
  ASSERT_TRUE(h.tick());
  EXPECT_TRUE(h.hand.holds());
}

TEST(RemoteHand, BeginsWhereTheHandleIsAndMovesNoFasterThanAHand) {
  Handle h;
  h.in.handle.p_MH = {0.03, 0.0, -0.01};
  h.in.aim.holds = true;
  h.in.aim.position_m = h.in.handle.p_MH;
  h.tick();
  h.in.aim.position_m = {-0.03, 0.0, 0.0};
  h.in.aim.rotation_rad = {0.0, 0.0, 0.3};
  Vector3 before = h.in.handle.p_MH;
  for (int i = 0; i < 600; ++i) {
    const auto target = h.tick();
    ASSERT_TRUE(target);
    EXPECT_LE((target->position_m - before).norm(), RemoteHand::kSpeed_m_per_s * kPeriod_s * (1.0 + 1e-9));
    before = target->position_m;
  }
  EXPECT_NEAR((before - h.in.aim.position_m).norm(), 0.0, 1e-12);
  EXPECT_NEAR(h.tick()->rotation_rad.z(), 0.3, 1e-12);
}

// As the page does with device.behaviour.idle = STAY: its first aim knows nothing of how the handle is
// turned.
TEST(RemoteHand, TakingTheHandleMovesAndTurnsNothing) {
  Handle h;
  h.in.handle.p_MH = {0.03, 0.0, -0.01};
  h.in.handle.q_MH = exp_rotation(Vector3(0.1, -0.2, 0.3));
  h.in.aim.holds = true;
  for (int i = 0; i < 600; ++i) {
    const auto target = h.tick();
    ASSERT_TRUE(target);
    ASSERT_NEAR((target->position_m - h.in.handle.p_MH).norm(), 0.0, 1e-12) << i;
    ASSERT_NEAR((target->rotation_rad - Vector3(0.1, -0.2, 0.3)).norm(), 0.0, 1e-12) << i;
  }
  h.in.aim.rotation_rad = {0.0, 0.0, 0.1};
  for (int i = 0; i < 600; ++i) h.tick();
  EXPECT_NEAR((h.tick()->rotation_rad - Vector3(0.1, -0.2, 0.4)).norm(), 0.0, 1e-12);
}

TEST(RemoteHand, LetsGoInOrderWithoutAHold) {
  Handle h;
  h.in.aim.holds = true;
  h.tick();
  h.in.aim = {};
  const auto target = h.tick();
  ASSERT_TRUE(target);
  EXPECT_EQ(target->grip, Grip::kReleased);
  EXPECT_FALSE(h.hand.fell_silent());
}

TEST(RemoteHand, SilenceLetsGoAndHoldsOnce) {
  Handle h;
  h.in.aim.holds = true;
  h.tick();
  int holds = 0;
  for (int i = 1; i <= 1000; ++i) {
    const auto target = h.tick(false);
    ASSERT_TRUE(target);
    const bool silent = i * kPeriod_s > kHandAgeMax_s;
    if (i != 300) {
      EXPECT_EQ(target->grip == Grip::kReleased, silent) << i;
    }
    holds += h.hand.fell_silent() ? 1 : 0;
  }
  EXPECT_EQ(holds, 1);
}

TEST(RemoteHand, NobodyGoesOnBeforeTheNextEngagement) {
  Handle h;
  h.in.engagement = 4;
  h.in.aim.holds = true;
  h.tick();
  h.in.aim = {};
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(h.tick());
  h.in.engagement = 5;
  EXPECT_FALSE(h.tick());
  EXPECT_FALSE(h.tick());
}

TEST(RemoteHand, APersonHasTheHandleBackAtOnceAfterARelease) {
  Handle h;
  h.in.person = true;
  h.in.aim.holds = true;
  h.tick();
  h.in.aim = {};
  EXPECT_FALSE(h.tick());
  h.in.aim.holds = true;
  h.tick();
  for (int i = 0; i < 400; ++i) h.tick(false);
  EXPECT_TRUE(h.tick(false));  // a client that fell silent: not before the next engagement
}

TEST(RemoteHand, AnotherClientAndAnotherEngagementBeginWhereTheHandleIs) {
  Handle h;
  h.in.aim = {.position_m = {0.05, 0.0, 0.0}, .hand = 1, .holds = true};
  for (int i = 0; i < 100; ++i) h.tick();
  h.in.handle.p_MH = {0.01, 0.0, 0.0};
  h.in.aim = {.position_m = {-0.03, 0.0, 0.0}, .hand = 2, .holds = true};
  for (int i = 0; i < 100; ++i) EXPECT_NEAR((h.tick()->position_m - h.in.handle.p_MH).norm(), 0.0, 1e-12);
  h.in.handle.p_MH = {0.02, 0.0, 0.0};
  h.in.engagement = 7;
  for (int i = 0; i < 100; ++i) EXPECT_NEAR((h.tick()->position_m - h.in.handle.p_MH).norm(), 0.0, 1e-12);
}

TEST(RemoteHand, ClutchIsALevelAndTheGripperAChange) {
  Handle h;
  h.in.aim.holds = true;
  h.in.aim.clutch = true;
  h.tick();
  EXPECT_TRUE(h.requests.clutch);
  EXPECT_FALSE(h.requests.grip);
  h.in.aim.grip = true;
  h.tick();
  EXPECT_EQ(h.requests.grip, true);
  h.tick();
  EXPECT_FALSE(h.requests.grip);
}

}  // namespace
}  // namespace longreach::remote_hand_test
