// A real haptic device behind its adapter, in virtual time.

#include "master/drivers/device_adapter.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "master/master_node.hpp"
#include "tests/support/adapter_end.hpp"

namespace longreach::device_adapter_test {
namespace {

using adapter::HandleDatagram;
using adapter::WrenchDatagram;

HandleDatagram handle(double x_m) {
  HandleDatagram d;
  d.flags = HandleDatagram::kOk | HandleDatagram::kHeld;
  d.position_m[0] = x_m;
  return d;
}

struct DeviceAdapterTest : ::testing::Test {
  MemoryChannelPair wire;
  DeviceAdapter device{wire.a(), {}, 5};
  AdapterEnd<WrenchDatagram, HandleDatagram> end{wire.b()};
};

TEST_F(DeviceAdapterTest, TellsWhatTheNewestDatagramSays) {
  EXPECT_FALSE(device.read(at_ms(0)).ok);
  end.send(handle(0.01));
  HandleDatagram d = handle(0.02);
  d.flags |= HandleDatagram::kMode | HandleDatagram::kClutch;
  d.velocity_m_per_s[1] = 0.3;
  d.angular_rad_per_s[2] = 0.4;
  d.orientation[0] = std::cos(0.1) * 1.0001;  // nearly of unit length
  d.orientation[3] = std::sin(0.1) * 1.0001;
  end.send(d);
  const HandleState s = device.read(at_ms(1));
  EXPECT_TRUE(s.ok);
  EXPECT_TRUE(s.held);
  EXPECT_EQ(s.p_MH, Vector3(0.02, 0, 0));
  EXPECT_EQ(s.velocity_m_per_s, Vector3(0, 0.3, 0));
  EXPECT_EQ(s.angular_rad_per_s, Vector3(0, 0, 0.4));
  EXPECT_NEAR(log_rotation(s.q_MH).z(), 0.2, 1e-12);
  EXPECT_NEAR(s.q_MH.norm(), 1.0, 1e-12);
  EXPECT_TRUE(s.buttons.mode && s.buttons.clutch);
  EXPECT_FALSE(s.buttons.scale_up || s.buttons.scale_down || s.buttons.kv_up || s.buttons.kv_down);
  d.flags = HandleDatagram::kOk | HandleDatagram::kKvDown;
  end.send(d);
  EXPECT_TRUE(device.read(at_ms(2)).buttons.kv_down);
}

TEST_F(DeviceAdapterTest, TwentyMillisecondsOfSilenceAreAFault) {
  end.send(handle(0.01));
  EXPECT_TRUE(device.read(at_ms(100)).ok);
  for (int ms = 1; ms < 20; ++ms) EXPECT_TRUE(device.read(at_ms(100 + ms)).ok) << ms;
  const HandleState silent = device.read(at_ms(120));
  EXPECT_FALSE(silent.ok);
  EXPECT_EQ(silent.p_MH, Vector3(0.01, 0, 0));  // the last good values
  EXPECT_TRUE(device.figures().silent);
}

TEST_F(DeviceAdapterTest, TheFaultIsAHoldOfTheRobotWithinTwentyMilliseconds) {
  MasterConfig config;
  config.link.send_hz = 1000;
  MasterNode node(config);
  StiffnessReport report;
  std::uint64_t number = 0;
  double silent_since_ms = 0.0;
  // Engaged for 100 ms; then the adapter is gone.
  for (int ms = 0; ms < 200; ++ms) {
    if (ms <= 100) {
      end.send(handle(0.0));
      silent_since_ms = ms;
    }
    MasterInput in;
    in.now = at_ms(ms);
    in.handle = device.read(in.now);
    in.last_heard = in.now;
    in.requests.engage = ms == 5;
    report.engagement = node.view().engagement;
    report.state = report.engagement > 0 ? SafetyState::kEngaged : SafetyState::kObserving;
    const std::array reports{Received<StiffnessReport>{.sequence = ++number, .message = report}};
    in.reports = reports;
    const MasterOutput out = node.step(in);
    device.write(out.F_H_M);
    ASSERT_TRUE(out.command || ms == 0);
    if (!out.command) continue;
    if (ms > 20 && ms < 120) {
      ASSERT_EQ(node.view().state, SafetyState::kEngaged) << ms;
      ASSERT_EQ(out.command->request, Request::kEngage) << ms;
    }
    if (ms - silent_since_ms >= 20) {
      ASSERT_EQ(node.view().state, SafetyState::kFault) << ms;
      ASSERT_EQ(out.command->request, Request::kHold) << ms;
    }
  }
  EXPECT_EQ(node.view().cause, HoldCause::kDeviceFault);
}

TEST_F(DeviceAdapterTest, ADeviceThatSaysItHasFailedHasFailed) {
  end.send(handle(0.01));
  ASSERT_TRUE(device.read(at_ms(0)).ok);
  HandleDatagram failed = handle(0.07);
  failed.flags = 0;
  end.send(failed);
  const HandleState s = device.read(at_ms(1));
  EXPECT_FALSE(s.ok);
  EXPECT_EQ(s.p_MH.x(), 0.01);
  EXPECT_TRUE(device.figures().failed);
}

TEST_F(DeviceAdapterTest, WhatIsNoDatagramChangesNothingButACounter) {
  end.send(handle(0.01));
  ASSERT_TRUE(device.read(at_ms(0)).ok);
  HandleDatagram good = handle(0.05);
  end.exchange.stamp(good);
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const auto mark_affected = [&](auto&& change) {
    HandleDatagram d = good;
    change(d);
    end.send_raw(d);
  };
  mark_affected([](auto& d) { d.header.magic[0] = 'X'; });
  mark_affected([](auto& d) { d.header.version = 2; });
  mark_affected([](auto& d) { d.header.kind = adapter::kRobot; });
  mark_affected([](auto& d) { d.header.size = 88; });
  mark_affected([](auto& d) { d.header.session = 0; });
  mark_affected([](auto& d) { d.position_m[2] = kNone; });
  mark_affected([](auto& d) { d.velocity_m_per_s[0] = INFINITY; });
  mark_affected([](auto& d) { d.angular_rad_per_s[0] = kNone; });
  mark_affected([](auto& d) { d.orientation[1] = 0.5; });
  mark_affected([](auto& d) { d.force_n[1] = kNone; });
  end.send_raw(WrenchDatagram{});
  end.send_raw(std::array<char, 500>{});
  EXPECT_EQ(device.read(at_ms(1)).p_MH.x(), 0.01);
  EXPECT_EQ(device.figures().malformed, 12u);
  // Old numbers and another session while this one lasts.
  mark_affected([](auto& d) { d.header.sequence = 1; });
  mark_affected([](auto& d) { d.header.session = 99; });
  EXPECT_EQ(device.read(at_ms(2)).p_MH.x(), 0.01);
  EXPECT_EQ(device.figures().late, 2u);
  end.send_raw(good);
  EXPECT_EQ(device.read(at_ms(3)).p_MH.x(), 0.05);
  EXPECT_EQ(device.figures().accepted, 2u);
}

TEST_F(DeviceAdapterTest, AcceptsRestartedAdapterAfterTimeout) {
  end.send(handle(0.01));
  ASSERT_TRUE(device.read(at_ms(0)).ok);
  end.exchange = adapter::Exchange(1234);
  end.send(handle(0.03));
  EXPECT_EQ(device.read(at_ms(19)).p_MH.x(), 0.01);
  end.send(handle(0.03));
  const HandleState s = device.read(at_ms(20));
  EXPECT_TRUE(s.ok);
  EXPECT_EQ(s.p_MH.x(), 0.03);
  EXPECT_EQ(device.figures().restarts, 1u);
}

TEST_F(DeviceAdapterTest, SendsTheWrenchAndNothingThatIsNotFinite) {
  end.send(handle(0.0));
  (void)device.read(at_ms(0));
  device.write({Vector3(0.1, 0.2, 0.3), Vector3(1, 2, 3)});
  auto in = end.receive(at_ms(1));
  ASSERT_TRUE(in);
  EXPECT_EQ(in->flags, WrenchDatagram::kLive);
  EXPECT_EQ(in->force_n[2], 3.0);
  EXPECT_EQ(in->moment_nm[0], 0.1);
  EXPECT_EQ(in->header.echo, 1u);
  EXPECT_EQ(in->header.session, 5u);
  device.write({Vector3::Zero(), Vector3(1, NAN, 3)});
  in = end.receive(at_ms(2));
  ASSERT_TRUE(in);
  EXPECT_EQ(in->flags, 0u);
  EXPECT_EQ(in->force_n[0], 0.0);
}

}  // namespace
}  // namespace longreach::device_adapter_test
