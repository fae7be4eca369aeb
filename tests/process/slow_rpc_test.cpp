// The client far from both sides, through TCP connections with a delay, with its default settings. Round trips
// are counted in the log of the proxy.
#include <cmath>
#include <filesystem>
#include <fstream>

#include "tests/process/delayed_tcp.hpp"
#include "tests/support/station.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::slow_rpc_test {
namespace {

using std::chrono::duration;
using std::chrono::seconds;
using Words = std::vector<std::string>;

/// A client with proxies of its own.
struct FarClient {
  FarClient(const Ports& ports, double delay_s, const Words& command)
      : slave("127.0.0.1:" + std::to_string(ports.slave_rpc), {.delay = duration<double>(delay_s)}),
        master("127.0.0.1:" + std::to_string(ports.master_rpc), {.delay = duration<double>(delay_s)}),
        program("longreach", words(command)) {}

  [[nodiscard]] Words words(const Words& command) const {
    Words out{"--slave", slave.address(), "--master", master.address()};
    out.insert(out.end(), command.begin(), command.end());
    return out;
  }
  /// Waits for the end, which is expected to be successful and to print `text`.
  void expect(const std::string& text) {
    EXPECT_EQ(program.wait(seconds(170)), 0) << log();
    EXPECT_NE(program.output().find(text), std::string::npos) << text << "\n" << log();
  }
  [[nodiscard]] std::string log() const {
    return program.output() + "\nslave:\n" + slave.log() + "master:\n" + master.log();
  }

  DelayedTcp slave, master;
  RunningProgram program;
};

class SlowRpc : public Station, public ::testing::WithParamInterface<double> {
 protected:
  [[nodiscard]] std::unique_ptr<FarClient> far(const Words& command) const {
    return std::make_unique<FarClient>(ports_, GetParam(), command);
  }
  [[nodiscard]] std::string slave_rpc() const { return "127.0.0.1:" + std::to_string(ports_.slave_rpc); }
  [[nodiscard]] std::string master_rpc() const { return "127.0.0.1:" + std::to_string(ports_.master_rpc); }

  TemporaryFolder folder_;
};

// A first call: TCP, TLS, HTTP/2 settings, the call.
const std::vector<int> kFirstCall{4};
const std::vector<int> kNone{};

TEST_P(SlowRpc, EveryCommandWorksWithItsDefaultTimeout) {
  const std::string recordings = (folder_.path() / "recordings").string();
  start_slave({"--recordings", recordings});
  start_master({"--operator", "none", "--engage", "--recordings", recordings});
  ASSERT_TRUE(both_engaged()) << outputs();

  const auto get = far({"get", "slave", "command.force_guard_n"});
  const auto set = far({"set", "slave", "estimator.forgetting", "0.995"});
  const auto mode = far({"mode", "rate"});
  const auto status = far({"status"});
  const auto start = far({"record", "start", "far"});
  const auto doctor = far({"doctor", "--seconds", "0.3"});
  get->expect("20");
  EXPECT_EQ(get->slave.round_trips(), kFirstCall) << get->log();
  EXPECT_EQ(get->master.round_trips(), kNone) << get->log();
  set->expect("estimator.forgetting = 0.995");
  EXPECT_EQ(set->slave.round_trips(), kFirstCall) << set->log();
  EXPECT_NE(slave_.get("estimator.forgetting").find("0.995"), std::string::npos);
  mode->expect("mode set to rate");
  EXPECT_EQ(mode->master.round_trips(), kFirstCall) << mode->log();
  status->expect("Engaged");
  EXPECT_EQ(status->master.round_trips(), kFirstCall) << status->log();
  EXPECT_EQ(status->slave.round_trips(), kFirstCall) << status->log();
  start->expect("far-slave");
  EXPECT_EQ(start->slave.round_trips(), kFirstCall) << start->log();

  const auto finish = far({"record", "stop"});
  const auto stop = far({"stop"});
  finish->expect("recorded at the slave");
  EXPECT_EQ(finish->slave.round_trips(), kFirstCall) << finish->log();
  stop->expect("stopped at the slave");
  EXPECT_NE(stop->program.output().find("stopped at the master"), std::string::npos) << stop->log();
  doctor->expect("0 failures");
  EXPECT_NE(doctor->program.output().find("the first call took"), std::string::npos) << doctor->log();
  // Connecting once, whatever it asks: three round trips, and one for each call.
  EXPECT_EQ(doctor->slave.round_trips().size(), 1U) << doctor->log();
}

TEST_P(SlowRpc, PairingWorksWithItsDefaultTimeout) {
  RunningProgram desk("longreach-slave", {"--pair", "--pair-listen", "127.0.0.1:0"});
  ASSERT_TRUE(says(desk, "Waiting")) << desk.output();
  const auto behind = [said = desk.output()](const std::string& words) {
    const auto begin = said.find(words) + words.size();
    return said.substr(begin, said.find('\n', begin) - begin);
  };
  const DelayedTcp proxy(behind("longreach pair --slave "), {.delay = duration<double>(GetParam())});
  const auto token = folder_.path() / "token";
  std::ofstream(token) << behind("Token: ") << "\n";
  std::filesystem::permissions(token, std::filesystem::perms::owner_read);
  RunningProgram pair("longreach", {"pair", "--slave", proxy.address(), "--token-file", token.string(),
                                    "--site", (folder_.path() / "site").string()});
  EXPECT_EQ(pair.wait(seconds(120)), 0) << pair.output() << proxy.log();
  EXPECT_NE(pair.output().find("paired: "), std::string::npos) << pair.output();
}

INSTANTIATE_TEST_SUITE_P(Delays, SlowRpc, ::testing::Values(0.65, 1.3, 5.0), [](const auto& delay) {
  return "OneWay" + std::to_string(std::lround(1000 * delay.param)) + "ms";
});

using SlowSlave = Station;

TEST_F(SlowSlave, StopReachesTheSlaveInTheSessionOfTheMaster) {
  start_slave();
  start_master({"--operator", "none", "--engage"});
  ASSERT_TRUE(both_engaged()) << outputs();
  const DelayedTcp slow("127.0.0.1:" + std::to_string(ports_.slave_rpc), {.delay = seconds(10)});
  RunningProgram stop("longreach", {"--master", "127.0.0.1:" + std::to_string(ports_.master_rpc), "--slave",
                                    slow.address(), "stop"});
  ASSERT_EQ(stop.wait(seconds(60)), 0) << stop.output();
  // The direct call would have needed four round trips; not even one has passed.
  EXPECT_EQ(slow.delivered(), 0U) << slow.log();
  EXPECT_NE(stop.output().find("stopped at the master\nstopped at the slave, by the session of the master\n"),
            std::string::npos)
      << stop.output();
  EXPECT_EQ(slave_.state(), "Stopped");
}

TEST_F(SlowSlave, AHandshakeThatIsLostOnceIsRepeated) {
  start_slave();
  ASSERT_TRUE(eventually([this] { return slave_.state() == "Idle"; })) << outputs();
  const std::string slave = "127.0.0.1:" + std::to_string(ports_.slave_rpc);
  for (const bool reset : {false, true}) {
    const DelayedTcp once(slave, {.broken = 1, .reset = reset});
    RunningProgram get("longreach", {"--slave", once.address(), "get", "slave", "command.force_guard_n"});
    EXPECT_EQ(get.wait(seconds(30)), 0) << get.output() << once.log();
    const DelayedTcp always(slave, {.broken = 100, .reset = reset});
    RunningProgram lost("longreach", {"--slave", always.address(), "get", "slave", "command.force_guard_n"});
    EXPECT_EQ(lost.wait(seconds(30)), 1) << lost.output();
    const std::string cause = reset ? "the connection was reset during the handshake"
                                    : "it closed the connection during the TLS handshake";
    EXPECT_NE(lost.output().find(cause), std::string::npos) << lost.output();
  }
}

}  // namespace
}  // namespace longreach::slow_rpc_test
