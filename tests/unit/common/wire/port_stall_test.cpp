// What lay in the socket while a side stood still: it is too old to follow, but for a stop.
#include <gtest/gtest.h>

#include "common/wire/memory_channel.hpp"
#include "common/wire/port.hpp"
#include "tests/unit/common/wire/samples.hpp"

namespace longreach::port_stall_test {
namespace {

using samples::datagram;

Time at_ms(std::int64_t ms) { return Time(std::chrono::milliseconds(ms)); }

MotionCommand command(Request request) {
  MotionCommand c = samples::command();
  c.request = request;
  return c;
}
StiffnessReport report(SafetyState state) {
  StiffnessReport r = samples::report();
  r.state = state;
  return r;
}

class PortThatStoodStill : public ::testing::Test {
 protected:
  PortThatStoodStill() { follow(slave_), follow(master_); }
  static void follow(Port& port) { port.follow(samples::session()); }
  [[nodiscard]] static std::uint64_t stalled(const Port& port) {
    return port.rejected()[static_cast<std::size_t>(Rejection::kStalled)];
  }

  MemoryChannelPair to_slave_{4096}, to_master_{4096};
  SlavePort slave_{to_slave_.b(), ImpairmentConfig{}, Random(1)};
  MasterPort master_{to_master_.b(), ImpairmentConfig{}, Random(2)};
};

TEST_F(PortThatStoodStill, DropsCountsAndDoesNotHearWhatLayThere) {
  to_slave_.a().send(datagram(command(Request::kEngage), 1));
  slave_.receive(at_ms(0));
  ASSERT_EQ(slave_.commands().size(), 1U);
  for (std::uint64_t i = 2; i <= 100; ++i) to_slave_.a().send(datagram(command(Request::kEngage), i));
  slave_.receive(at_ms(8000), true);
  EXPECT_TRUE(slave_.commands().empty());
  EXPECT_EQ(stalled(slave_), 99U);
  EXPECT_EQ(slave_.rejected_total(), 99U);
  EXPECT_EQ(slave_.accepted_total(), 1U);
  EXPECT_EQ(slave_.endpoint().monitor().last_heard(), at_ms(0));
  to_slave_.a().send(datagram(command(Request::kEngage), 50));
  slave_.receive(at_ms(8001));
  EXPECT_TRUE(slave_.commands().empty()) << "its number is used up";
  to_slave_.a().send(datagram(command(Request::kEngage), 101));
  slave_.receive(at_ms(8002));
  EXPECT_EQ(slave_.commands().size(), 1U);
  EXPECT_EQ(slave_.endpoint().monitor().last_heard(), at_ms(8002));
}

TEST_F(PortThatStoodStill, ObeysAStopAmongIt) {
  to_slave_.a().send(datagram(command(Request::kEngage), 1));
  to_slave_.a().send(datagram(command(Request::kStop), 2));
  to_slave_.a().send(datagram(command(Request::kEngage), 3));
  slave_.receive(at_ms(8000), true);
  ASSERT_EQ(slave_.commands().size(), 1U);
  EXPECT_EQ(slave_.commands()[0].message.request, Request::kStop);
  EXPECT_TRUE(slave_.commands()[0].newest);
  EXPECT_FALSE(slave_.endpoint().monitor().last_heard());
  EXPECT_EQ(stalled(slave_), 2U);
}

TEST_F(PortThatStoodStill, TakesOfReportsOnlyThatTheSlaveHasStopped) {
  const SafetyState all[] = {SafetyState::kEngaged, SafetyState::kHolding, SafetyState::kStopped,
                             SafetyState::kFault};
  std::uint64_t sequence = 0;
  for (const SafetyState state : all) to_master_.a().send(datagram(report(state), ++sequence));
  to_master_.a().send(datagram(samples::telemetry(), 1));
  master_.receive(at_ms(8000), true);
  ASSERT_EQ(master_.reports().size(), 2U);
  EXPECT_EQ(master_.reports()[0].message.state, SafetyState::kStopped);
  EXPECT_EQ(master_.reports()[1].message.state, SafetyState::kFault);
  EXPECT_TRUE(master_.telemetry().empty());
  EXPECT_EQ(stalled(master_), 3U);
}

TEST_F(PortThatStoodStill, WhatItCannotTakeInOneGoIsStillOld) {
  for (std::uint64_t i = 1; i <= 2500; ++i) to_slave_.a().send(datagram(command(Request::kEngage), i));
  slave_.receive(at_ms(8000), true);
  slave_.receive(at_ms(8001));
  slave_.receive(at_ms(8002));
  EXPECT_TRUE(slave_.commands().empty());
  EXPECT_EQ(stalled(slave_), 2500U);
  to_slave_.a().send(datagram(command(Request::kEngage), 2501));
  slave_.receive(at_ms(8003));
  EXPECT_EQ(slave_.commands().size(), 1U);
}

TEST_F(PortThatStoodStill, AnArtificialNetworkDoesNotMakeItNew) {
  ImpairmentConfig impairment;
  impairment.delay_s = 1.3;
  SlavePort slave(to_slave_.b(), impairment, Random(3));
  follow(slave);
  to_slave_.a().send(datagram(command(Request::kEngage), 1));  // comes out at 1.3 s
  slave.receive(at_ms(0));
  to_slave_.a().send(datagram(command(Request::kEngage), 2));  // is under way till 2.2 s
  slave.receive(at_ms(900));
  to_slave_.a().send(datagram(command(Request::kEngage), 3));  // lies in the socket
  slave.receive(at_ms(2000), true);
  EXPECT_TRUE(slave.commands().empty());
  EXPECT_EQ(stalled(slave), 3U);
  for (int ms = 2001; ms < 6000; ++ms) {
    slave.receive(at_ms(ms));
    EXPECT_TRUE(slave.commands().empty()) << "3 has overtaken it";
  }
  EXPECT_EQ(slave.accepted_total(), 0U);
  EXPECT_FALSE(slave.endpoint().monitor().last_heard());
  to_slave_.a().send(datagram(command(Request::kEngage), 4));
  slave.receive(at_ms(6000));
  slave.receive(at_ms(7300));
  EXPECT_EQ(slave.accepted_total(), 1U);
}

TEST_F(PortThatStoodStill, TellsTheRoundTripOfWhatItHears) {
  MemoryChannelPair wire;
  MasterPort master(wire.a(), ImpairmentConfig{}, Random(4));
  SlavePort slave(wire.b(), ImpairmentConfig{}, Random(5));
  follow(master), follow(slave);
  slave.send(at_ms(1000), 1, samples::report());
  master.receive(at_ms(77000));
  master.send(at_ms(77007), 1, samples::command());  // it lay there for 7 ms
  slave.receive(at_ms(1030));
  ASSERT_EQ(slave.commands().size(), 1U);
  EXPECT_EQ(slave.commands()[0].rtt, std::chrono::milliseconds(23));
}

}  // namespace
}  // namespace longreach::port_stall_test
