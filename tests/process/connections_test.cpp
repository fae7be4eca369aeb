// Connections that say nothing, and a program that has no descriptors left: memory and descriptors come back,
// and a stop is answered throughout. LONGREACH_FULL: 15,000 connections.
#include <sys/resource.h>
#include <sys/socket.h>

#include <iostream>

#include "deploy/lab/campaign_size.hpp"
#include "tests/process/load.hpp"
#include "tests/process/program_figures.hpp"
#include "tests/support/station.hpp"

namespace longreach::connections_test {
namespace {

using std::chrono::seconds;

class Connections : public Station {
 protected:
  void start() {
    rlimit limit{};
    ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &limit), 0);
    limit.rlim_cur = limit.rlim_max;
    ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &limit), 0);
    start_slave({"--core-dumps"});  // so that its descriptors can be counted
    start_master({"--operator", "none"});
    ASSERT_TRUE(engaged()) << outputs();
  }

  /// A new client's stop, and how long the answer took.
  double stop_s() {
    const auto began = std::chrono::steady_clock::now();
    EXPECT_EQ(StationSide(RpcRole::kSlave, ports_.slave_rpc).stop(), "");
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  }

  void expect_stops(const std::string& load) {
    BareLoops bare;
    const double asked_s = stop_s();
    const double stalled_s = to_seconds(bare.end().lateness_max);
    std::cout << load << ": stopped in " << 1e3 * asked_s << " ms; loops that do nothing: late by "
              << 1e3 * stalled_s << " ms\n";
    EXPECT_LT(asked_s, 0.2 + 10.0 * stalled_s) << load;
    EXPECT_TRUE(eventually([this] { return slave_.state() == "Stopped"; }, seconds(20)));
  }
};

TEST_F(Connections, ThatSayNothingTakeNoMemoryAndGiveTheirDescriptorsBack) {
  start();
  if (HasFatalFailure()) return;
  (void)slave_.status();
  const pid_t slave = slave_program_->pid();
  const double before_mb = resident_mb(slave);
  const int before = descriptors(slave);
  double most_mb = 0.0;
  int most = 0;
  {
    const int count = campaign(15'000, 800);
    const IdleConnections silent(ports_.slave_rpc, count);
    ASSERT_EQ(silent.connected(), count);
    EXPECT_TRUE(eventually(
        [&] { return slave_.counter("rpc_refused") >= static_cast<unsigned>(count) - 256; }, seconds(30)));
    most_mb = resident_mb(slave);
    most = descriptors(slave);
    expect_stops(std::to_string(count) + " silent connections");
  }
  EXPECT_TRUE(eventually([&] { return descriptors(slave) <= before + 2; }, seconds(30)))
      << descriptors(slave);
  std::cout << "slave: " << before_mb << " MB, " << most_mb << " MB with them, " << resident_mb(slave)
            << " MB after; descriptors " << before << ", " << most << ", " << descriptors(slave) << "\n";
  EXPECT_LT(most_mb, before_mb + 5.0);
  EXPECT_LT(resident_mb(slave), before_mb + 5.0);
  EXPECT_LE(most, before + 257 + 2);
}

TEST_F(Connections, ThatNeverEndTheirHandshakeAreBounded) {
  start();
  if (HasFatalFailure()) return;
  const pid_t slave = slave_program_->pid();
  const double before_mb = resident_mb(slave);
  {
    const int count = campaign(2000, 600);
    const IdleConnections half(ports_.slave_rpc, count);
    ASSERT_EQ(half.connected(), count);
    // The first bytes of a TLS record that never comes.
    for (int i = 0; i < count; ++i)
      (void)::send(half.socket(static_cast<std::size_t>(i)), "\x16\x03\x01\x02", 4, MSG_NOSIGNAL);
    EXPECT_TRUE(slave_.status());                                          // who is inside stays
    EXPECT_TRUE(StationSide(RpcRole::kSlave, ports_.slave_rpc).status());  // and who comes is let in
    std::this_thread::sleep_for(seconds(1));
    EXPECT_LT(resident_mb(slave), before_mb + 25.0);
    EXPECT_EQ(slave_.stop(), "");
    EXPECT_TRUE(eventually([this] { return slave_.state() == "Stopped"; }, seconds(20)));
  }
  EXPECT_TRUE(eventually([&] { return resident_mb(slave) < before_mb + 25.0; }, seconds(30)))
      << before_mb << " MB, " << resident_mb(slave) << " MB";
  std::cout << "slave: " << before_mb << " MB, after handshakes that did not end " << resident_mb(slave)
            << " MB\n";
}

TEST_F(Connections, WithoutDescriptorsTheSlaveSaysSoAndStopsWhenItIsAsked) {
  start();
  if (HasFatalFailure()) return;
  const pid_t slave = slave_program_->pid();
  const rlimit few{static_cast<rlim_t>(descriptors(slave)) + 8, static_cast<rlim_t>(descriptors(slave)) + 8};
  ASSERT_EQ(::prlimit(slave, RLIMIT_NOFILE, &few, nullptr), 0);
  const IdleConnections silent(ports_.slave_rpc, 100);
  ASSERT_EQ(silent.connected(), 100);
  EXPECT_TRUE(says(*slave_program_, "no file descriptors are left")) << outputs();
  expect_stops("no descriptors left");
}

}  // namespace
}  // namespace longreach::connections_test
