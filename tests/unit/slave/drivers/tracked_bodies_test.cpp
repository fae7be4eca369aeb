// A real robot behind its adapter that tracks free bodies, in virtual time.

#include <gtest/gtest.h>

#include <deque>
#include <vector>

#include "common/wire/codec.hpp"
#include "slave/drivers/robot_adapter.hpp"
#include "tests/support/adapter_end.hpp"

namespace longreach::tracked_bodies_test {
namespace {

using adapter::BodiesDatagram;
using adapter::RobotDatagram;

/// What the adapter has sent; what longreach sends is dropped.
struct FromAdapter : Channel {
  std::optional<std::size_t> receive(std::span<std::byte> buffer) override {
    if (sent.empty()) return std::nullopt;
    const std::vector<std::byte> bytes = sent.front();
    sent.pop_front();
    std::copy_n(bytes.begin(), std::min(bytes.size(), buffer.size()), buffer.begin());
    return bytes.size();
  }
  void send(std::span<const std::byte>) override {}

  std::deque<std::vector<std::byte>> sent;
};

BodiesDatagram body_at(double x_m, double age_s = 0.0) {
  BodiesDatagram d;
  d.count = 1;
  d.body[0].position_m[0] = x_m;
  d.body[0].age_s = age_s;
  return d;
}

class TrackedBodies : public ::testing::Test {
 protected:
  template <class Datagram>
  void send(Datagram d) {
    exchange.stamp(d);
    const auto bytes = std::as_bytes(std::span(&d, 1));
    wire.sent.emplace_back(bytes.begin(), bytes.end());
  }
  void send_state() {
    RobotDatagram d;
    d.flags = RobotDatagram::kOk;
    send(d);
  }
  RobotState read(double ms) { return robot.read(at_ms(ms)); }
  [[nodiscard]] std::optional<BodyPose> body(std::size_t i = 0) const {
    return robot.tracked_bodies().body[i];
  }

  FromAdapter wire;
  adapter::Exchange exchange{77};
  RobotAdapter robot{wire, {}, {}, 5};
};

TEST_F(TrackedBodies, AgesGrowUntilTheNextPoses) {
  send_state();
  send(body_at(0.5, 0.1));
  (void)read(0);
  ASSERT_TRUE(body());
  EXPECT_EQ(body()->X_WB.p, Vector3(0.5, 0, 0));
  EXPECT_NEAR(body()->age_s, 0.1, 1e-12);
  (void)read(30);
  EXPECT_NEAR(body()->age_s, 0.13, 1e-12);
  (void)read(3e9);
  EXPECT_EQ(body()->age_s, kBodyAgeMaxS);
  send(body_at(0.6));
  (void)read(3e9 + 1);
  EXPECT_EQ(body()->X_WB.p.x(), 0.6);
  EXPECT_EQ(body()->age_s, 0.0);
  EXPECT_EQ(robot.figures().malformed + robot.figures().late, 0U);
}

TEST_F(TrackedBodies, ABodyWithAnUnknownPoseKeepsItsNumber) {
  BodiesDatagram d = body_at(0.5, -1.0);
  d.count = 2;
  d.body[1].position_m[1] = 0.7;
  d.body[1].orientation[0] = 1.0004;
  send_state();
  send(d);
  (void)read(0);
  EXPECT_FALSE(body(0));
  ASSERT_TRUE(body(1));
  EXPECT_EQ(body(1)->X_WB.p.y(), 0.7);
  EXPECT_NEAR(body(1)->X_WB.q.norm(), 1.0, 1e-12);
  EXPECT_FALSE(body(2));
}

TEST_F(TrackedBodies, ARobotWithoutBodiesHasNone) {
  for (int ms = 0; ms < 100; ++ms) {
    send_state();
    EXPECT_TRUE(read(ms).ok);
    EXPECT_TRUE(robot.tracked_bodies().empty());
  }
}

TEST_F(TrackedBodies, AreForgottenWhenTheAdapterRestarts) {
  send_state();
  send(body_at(0.5));
  (void)read(0);
  ASSERT_TRUE(body());
  exchange = adapter::Exchange(1234);
  send(body_at(0.9));
  (void)read(10);
  EXPECT_EQ(body()->X_WB.p.x(), 0.5) << "the first session is still active";
  send_state();
  (void)read(40);
  EXPECT_FALSE(body()) << "the robot that has restarted has sent none";
  EXPECT_EQ(robot.figures().restarts, 1U);
}

TEST_F(TrackedBodies, AreNumberedTogetherWithTheState) {
  send(body_at(0.5));
  send_state();
  std::swap(wire.sent[0], wire.sent[1]);
  (void)read(0);
  EXPECT_FALSE(body()) << "overtaken by the state";
  EXPECT_EQ(robot.figures().late, 1U);
}

TEST_F(TrackedBodies, WithoutTheStateAreAFault) {
  send_state();
  EXPECT_TRUE(read(0).ok);
  for (int ms = 1; ms < 20; ++ms) {
    send(body_at(0.5));
    EXPECT_TRUE(read(ms).ok) << ms;
  }
  send(body_at(0.5));
  EXPECT_FALSE(read(20).ok) << "poses are no sign of life of the robot";
  EXPECT_TRUE(robot.figures().silent);
  send_state();
  EXPECT_TRUE(read(21).ok);
}

TEST_F(TrackedBodies, InvalidPosesAreCountedAndChangeNothing) {
  send_state();
  send(body_at(0.5));
  BodiesDatagram d = body_at(0.6);
  d.count = 9;
  send(d);
  d = body_at(0.6);
  d.body[0].orientation[0] = 0.5;
  send(d);
  EXPECT_TRUE(read(0).ok);
  EXPECT_EQ(body()->X_WB.p.x(), 0.5);
  EXPECT_EQ(robot.figures().malformed, 2U);
}

}  // namespace
}  // namespace longreach::tracked_bodies_test
