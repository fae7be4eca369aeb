// Datagrams that arrive in bursts, as over Wi-Fi with power saving: the robot does not stop and start at the rate
// of the bursts.
#include "tests/process/datagram_tap.hpp"
#include "tests/support/station.hpp"

namespace longreach::bursts_test {
namespace {

using std::chrono::milliseconds;

const std::string kWarning =
    "3 times within 10 s, no datagram arrived for longer than safety.gap_s (0.1 s); the datagrams probably arrive in "
    "bursts: switch off power saving of the Wi-Fi";

class Bursts : public Station {
 protected:
  void start(milliseconds period) {
    tap_.emplace(ports_.link, period);
    start_slave();
    start_master({"--operator", "none", "--set", "link.slave=" + tap_->address()});
    ASSERT_TRUE(eventually([this] { return master_.state() == "Observing"; })) << outputs();
    ASSERT_TRUE(eventually([this] { return master_.engage().empty(); })) << outputs();
  }
  /// Counts a text in the log of the slave.
  [[nodiscard]] int times(const std::string& words) const {
    const std::string log = slave_program_->output();
    int found = 0;
    for (auto at = log.find(words); at != std::string::npos; at = log.find(words, at + 1)) ++found;
    return found;
  }

  std::optional<DatagramTap> tap_;
};

TEST_F(Bursts, OfAGapThatIsAllowedCauseNoHold) {
  start(milliseconds(50));
  ASSERT_TRUE(both_engaged()) << outputs();
  const std::uint64_t accepted = slave_.counter("accepted");
  ASSERT_TRUE(eventually([&] { return slave_.counter("accepted") > accepted + 1500; })) << outputs();
  EXPECT_EQ(times(kWarning), 0) << outputs();
}

TEST_F(Bursts, OfALongerGapCauseOneWarningAndAHoldThatStays) {
  for (const int period_ms : {102, 200}) {
    ports_ = free_ports();
    slave_ = {RpcRole::kSlave, ports_.slave_rpc};
    master_ = {RpcRole::kMaster, ports_.master_rpc};
    start(milliseconds(period_ms));
    ASSERT_TRUE(says(*slave_program_, kWarning)) << period_ms << outputs();
    // Then nothing more, however many bursts follow.
    const std::uint64_t accepted = slave_.counter("accepted");
    ASSERT_TRUE(eventually([&] { return slave_.counter("accepted") > accepted + 1500; })) << outputs();
    EXPECT_EQ(slave_.state(), "Holding") << outputs();
    EXPECT_EQ(times(kWarning), 1) << outputs();
    EXPECT_LE(times("to=Holding"), 3) << outputs();
    EXPECT_NE(slave_.status()->trouble().find(kWarning), std::string::npos);
    RunningProgram doctor("longreach", {"doctor", "--seconds", "0.3", "--slave",
                                        "127.0.0.1:" + std::to_string(ports_.slave_rpc), "--master",
                                        "127.0.0.1:" + std::to_string(ports_.master_rpc)});
    EXPECT_EQ(doctor.wait(std::chrono::seconds(60)), 1) << doctor.output();
    EXPECT_NE(doctor.output().find("set power_save off"), std::string::npos) << doctor.output();
    master_program_.reset();
    slave_program_.reset();
  }
}

}  // namespace
}  // namespace longreach::bursts_test
