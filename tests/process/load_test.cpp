// Load on the slave from strangers and from clients, on loopback alone: the robot stays with its master, in
// contact, on time, and RPC is there again when the load is over.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <future>
#include <optional>
#include <sstream>

#include "deploy/lab/campaign_size.hpp"
#include "tests/process/load.hpp"
#include "tests/support/station.hpp"

namespace longreach::load_test {
namespace {

// Rates are never exceeded, hence a little more than the 10,000 and 200,000 that are to be borne.
constexpr int kIdle = 1100;
constexpr double kRequestsHz = 10'100.0;
constexpr double kForgedHz = 202'000.0;

struct Load {
  int idle = 0;
  double requests_hz = 0.0;
  double forged_hz = 0.0;
};

class UnderLoad : public Station {
 protected:
  /// Both sides, engaged and pressing against the wall.
  void press() {
    rlimit limit{};
    ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &limit), 0);
    limit.rlim_cur = limit.rlim_max;
    ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &limit), 0);
    start_slave();
    start_master({"--operator", "script", "--engage", "--set", "operator.probe_cycles=1000"});
    ASSERT_TRUE(both_engaged()) << outputs();
    ASSERT_TRUE(eventually([this] { return pressing(master_.status()); })) << outputs();
  }

  static bool pressing(const std::optional<proto::Status>& status) {
    return status && status->state() == "Engaged" && status->in_contact() && status->force_n() > 0.5;
  }

  /// The number that the programs follow; a stranger who listens on the way knows it.
  [[nodiscard]] std::uint64_t session() const {
    const std::string said = slave_program_->output();
    const std::string before = "session number=";
    return std::stoull(said.substr(said.rfind(before) + before.size(), 16), nullptr, 16);
  }

  void bear(const Load& load) {
    const auto before = slave_.status();
    ASSERT_TRUE(before);
    const std::uint64_t rejected = slave_.counter("rejected");
    const std::chrono::seconds time(campaign(30, 5));
    std::future<LoadCounts> requests;
    std::future<LoadCounts> forged;
    Disturbance disturbance(slave_, master_);
    {
      const IdleConnections idle(ports_.slave_rpc, load.idle);
      ASSERT_EQ(idle.connected(), load.idle);
      if (load.requests_hz > 0.0)
        requests = std::async(std::launch::async, request_status, RpcRole::kSlave, ports_.slave_rpc,
                              load.requests_hz, time);
      if (load.forged_hz > 0.0)
        forged = std::async(std::launch::async, forge, ports_.link, session(), load.forged_hz, time);
      std::this_thread::sleep_for(time);
      if (requests.valid()) requests.wait();
      if (forged.valid()) forged.wait();
    }
    const LoadCounts asked = requests.valid() ? requests.get() : LoadCounts{};
    const LoadCounts sent = forged.valid() ? forged.get() : LoadCounts{};
    std::ostringstream text;
    text << load.idle << " idle, " << asked.rate_hz() << " requests/s (" << asked.failed << " failed), "
         << sent.rate_hz() << " forged/s of which " << slave_.counter("rejected") - rejected << " were read";
    disturbance.expect_none(text.str());

    // One call, known and new: each is given 5 s.
    const auto after = slave_.status();
    EXPECT_TRUE(after) << outputs();
    EXPECT_TRUE(StationSide(RpcRole::kSlave, ports_.slave_rpc).status()) << outputs();
    if (!after) return;
    EXPECT_EQ(after->state(), "Engaged") << after->cause();
    EXPECT_EQ(after->engagement(), before->engagement());
    EXPECT_TRUE(eventually([this] { return pressing(master_.status()); }));
    EXPECT_EQ(asked.done > 0, load.requests_hz > 0.0);
    EXPECT_EQ(slave_.counter("rejected") > rejected, load.forged_hz > 0.0);
  }
};

TEST_F(UnderLoad, IdleConnectionsAndForgedDatagramsDisturbNothing) {
  press();
  if (HasFatalFailure()) return;
  for (const Load& load : {Load{.idle = kIdle}, Load{.requests_hz = kRequestsHz},
                           Load{.forged_hz = kForgedHz}, Load{kIdle, kRequestsHz, kForgedHz}}) {
    bear(load);
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace longreach::load_test
