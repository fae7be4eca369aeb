// The artificial delay of calls to the slave, which a link profile or `link set --rpc` sets.
#include <nlohmann/json.hpp>
#include <regex>

#include "tests/support/station.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::rpc_delay_test {
namespace {

using std::chrono::seconds;
using Words = std::vector<std::string>;

class ArtificialRpcDelay : public Station {
 protected:
  [[nodiscard]] std::unique_ptr<RunningProgram> client(const Words& command) const {
    Words all{"--slave", "127.0.0.1:" + std::to_string(ports_.slave_rpc), "--master",
              "127.0.0.1:" + std::to_string(ports_.master_rpc)};
    all.insert(all.end(), command.begin(), command.end());
    return std::make_unique<RunningProgram>("longreach", all);
  }
  /// Runs a command and returns its output.
  [[nodiscard]] std::string run(const Words& command, int status = 0) const {
    const auto program = client(command);
    EXPECT_EQ(program->wait(seconds(60)), status) << program->output();
    return program->output();
  }
  static bool has(const std::string& text, const std::string& words) {
    return text.find(words) != std::string::npos;
  }
};

TEST_F(ArtificialRpcDelay, IsFourRoundTripsForAFirstCallAndOneForFurtherCalls) {
  start_slave();
  ASSERT_TRUE(says(*slave_program_, "slave start ")) << outputs();
  const std::string set = run({"link", "set", "--rpc", "800ms"});
  EXPECT_TRUE(has(set, "up: round trip of calls 800 ms")) << set;
  const auto took_s = [this] {
    const auto began = std::chrono::steady_clock::now();
    EXPECT_EQ(slave_.get("loop.rate_hz"), "1000");
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  };
  const double first_s = took_s(), further_s = took_s();
  EXPECT_GE(first_s, 3.2);
  EXPECT_GE(further_s, 0.8);
  EXPECT_LT(further_s, 2.4);
  EXPECT_EQ(slave_.state(), "Idle");
}

// Half a round trip passes before a call is executed, and half of one before its response arrives.
TEST_F(ArtificialRpcDelay, LetsTheStatusBeHalfARoundTripOld) {
  start_slave();
  start_master({"--operator", "none"});
  ASSERT_TRUE(eventually([this] { return master_.state() == "Observing"; })) << outputs();
  const auto age_s = [this](const Words& command) {
    const auto both = nlohmann::json::parse(run(command), nullptr, false);
    return both.is_discarded() ? nlohmann::json{{"master", -1.0}, {"slave", -1.0}} : both["age_s"];
  };
  (void)run({"link", "set", "--rpc", "1s"});
  for (const Words& command : {Words{"--json", "status"}, Words{"--json", "watch", "--count", "1"}}) {
    const auto age = age_s(command);
    EXPECT_GE(age["slave"].get<double>(), 0.5) << age;
    EXPECT_GE(age["master"].get<double>(), 0.0) << age;
    EXPECT_LT(age["master"].get<double>(), age["slave"].get<double>()) << age;
  }
  EXPECT_TRUE(has(run({"status"}), "age of these values"));
  const std::string doctor = run({"doctor", "--seconds", "0.3"});
  EXPECT_TRUE(std::regex_search(doctor, std::regex("artificial:\\s+round\\s+trip\\s+of\\s+calls\\s+1\\s+s")))
      << doctor;
}

TEST_F(ArtificialRpcDelay, DoesNotDelayALinkCommandAStopOrTheMaster) {
  start_slave();
  start_master({"--operator", "none", "--engage"});
  ASSERT_TRUE(both_engaged()) << outputs();
  (void)run({"link", "set", "--rpc", "10s"});
  const auto slow = client({"get", "slave", "loop.rate_hz"});
  EXPECT_TRUE(has(run({"link", "show"}), "round trip of calls 10 s"));
  EXPECT_TRUE(has(run({"mode", "rate"}), "mode set to rate"));
  EXPECT_EQ(master_.state(), "Engaged");
  const std::string stop = run({"stop"});
  EXPECT_TRUE(has(stop, "stopped at the slave, by the session of the master")) << stop;
  EXPECT_EQ(master_.state(), "Stopped");
  EXPECT_TRUE(has(run({"link", "set", "--profile", "lab", "--rpc", "0"}), "up: none"));
  EXPECT_TRUE(slow->running()) << slow->output();  // its request is on its way for 35 s
  EXPECT_EQ(slave_.state(), "Stopped");
}

TEST_F(ArtificialRpcDelay, IsSetByAProfileAndTheMasterOpensItsSession) {
  const TemporaryFolder folder;
  const std::string profile =
      folder.write("far.txtpb", "name: 'far' basis: 'test' up { delay_s: 0.6 } down { delay_s: 0.4 }")
          .string();
  start_slave({"--profile", profile});
  ASSERT_TRUE(says(*slave_program_, "slave start")) << outputs();
  start_master({"--operator", "none", "--profile", profile});
  EXPECT_TRUE(has(slave_.get("link.impairment"), "rpc_delay_s: 1 ")) << slave_.get("link.impairment");
  // The deadline of the session call follows a fast connection, and is extended by the artificial delay.
  ASSERT_TRUE(eventually([this] { return master_.state() == "Observing"; })) << outputs();
  EXPECT_FALSE(has(master_program_->output(), "no session")) << outputs();
}

TEST_F(ArtificialRpcDelay, ThatExceedsAGivenTimeoutIsNamedAtOnce) {
  start_slave();
  ASSERT_TRUE(says(*slave_program_, "slave start ")) << outputs();
  (void)run({"link", "set", "--rpc", "2s"});
  const std::string said = run({"--timeout", "5", "set", "slave", "estimator.forgetting", "0.5"}, 1);
  EXPECT_TRUE(has(said, "the artificial delay of this call is 8 s: allow more time with --timeout")) << said;
  (void)run({"link", "set", "--rpc", "0"});
  EXPECT_TRUE(has(slave_.get("estimator.forgetting"), "0.99")) << "the refused call changed it";
}

}  // namespace
}  // namespace longreach::rpc_delay_test
