// Two hosts, played by two site folders on loopback: paired by the token that the slave prints.
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "common/site/site.hpp"
#include "tests/support/station.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::pair_test {
namespace {

class Pairing : public Station {
 protected:
  /// What the slave's host printed for the other one: a token, and `longreach pair --slave ADDRESS`.
  struct Offer {
    std::string address, token;
  };

  Offer open_desk() {
    desk_ = std::make_unique<RunningProgram>(
        "longreach-slave", std::vector<std::string>{"--pair", "--pair-listen", "127.0.0.1:0"});
    const std::string command = "longreach pair --slave ";
    EXPECT_TRUE(says(*desk_, "Waiting")) << desk_->output();
    const std::string said = desk_->output();
    std::istringstream words(said.substr(std::min(said.find(command), said.size() - 1) + command.size()));
    Offer offer;
    words >> offer.address;
    std::istringstream(said.substr(said.find("Token: ") + 7)) >> offer.token;
    return offer;
  }
  /// The options that give a token.
  std::vector<std::string> pair_words(const Offer& offer, const std::vector<std::string>& more = {}) const {
    const auto file = elsewhere_.path() / "token";
    std::ofstream(file) << offer.token << "\n";
    std::filesystem::permissions(file,
                                 std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
    std::vector<std::string> words = {"pair", "--slave", offer.address, "--token-file", file.string()};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  /// The exit status and output of `longreach` on the host that joins.
  std::pair<int, std::string> there(std::vector<std::string> words) const {
    words.insert(words.end(), {"--site", site_});
    RunningProgram program("longreach", words);
    const int status = program.wait(std::chrono::seconds(60)).value_or(-1);
    return {status, program.output()};
  }
  static std::string log() {
    std::ifstream in(default_site() / "pairing.log");
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
  }

  TemporaryFolder elsewhere_;
  std::string site_ = (elsewhere_.path() / "site").string();
  std::unique_ptr<RunningProgram> desk_;
};

TEST_F(Pairing, APairedHostIsMasterAndClientAndNotASlave) {
  const Offer offer = open_desk();
  const auto [status, said] = there(pair_words(offer));
  ASSERT_EQ(status, 0) << said;
  EXPECT_EQ(desk_->wait(std::chrono::seconds(30)), 0) << desk_->output();
  EXPECT_NE(log().find("pairing paired=127.0.0.1:"), std::string::npos) << log();
  EXPECT_EQ(log().find(offer.token), std::string::npos) << "the token stays out of the log";

  start_slave();
  start_master({"--operator", "none", "--engage", "--site", site_});
  ASSERT_TRUE(both_engaged()) << outputs();
  const std::string rpc = "127.0.0.1:" + std::to_string(ports_.slave_rpc);
  const std::string master_rpc = "127.0.0.1:" + std::to_string(ports_.master_rpc);
  const auto [stopped, answer] = there({"--slave", rpc, "--master", master_rpc, "stop"});
  EXPECT_EQ(stopped, 0) << answer;
  EXPECT_TRUE(eventually([this] { return slave_.state() == "Stopped"; })) << outputs();

  RunningProgram false_slave("longreach-slave", {"--site", site_, "--set", "rpc.listen=127.0.0.1:0"});
  EXPECT_EQ(false_slave.wait(std::chrono::seconds(30)), 1);
  EXPECT_NE(false_slave.output().find("was created by pairing"), std::string::npos) << false_slave.output();
}

TEST_F(Pairing, ATokenIsUsedOnceAndASiteThatIsThereStays) {
  const Offer offer = open_desk();
  const std::string before = site_credentials(site_, RpcRole::kClient).authority;
  const auto [refused, why] = there(pair_words(offer));
  EXPECT_EQ(refused, 1);
  EXPECT_NE(why.find("--replace"), std::string::npos) << why;
  EXPECT_EQ(site_credentials(site_, RpcRole::kClient).authority, before);
  const auto [wrong, sentence] =
      there(pair_words({offer.address, "0000-0000-0000-0000-0000-0000"}, {"--replace"}));
  EXPECT_EQ(wrong, 2);
  EXPECT_NE(sentence.find("the token is invalid"), std::string::npos) << sentence;
  const auto [empty, advice] = there({"pair", "--slave", offer.address, "--token-file", "-", "--replace"});
  EXPECT_EQ(empty, 2);  // the input of these programs is empty
  EXPECT_NE(advice.find("the token is missing, because the input is empty"), std::string::npos) << advice;
  const auto [done, said] = there(pair_words(offer, {"--replace"}));
  EXPECT_EQ(done, 0) << said;
  EXPECT_NE(said.find(":47020 --site " + site_ + " status\n"), std::string::npos) << said;
  EXPECT_NE(said.find(":47001 --site " + site_ + "\n"), std::string::npos) << said;
  EXPECT_EQ(site_credentials(site_, RpcRole::kClient).authority,
            site_credentials(default_site(), RpcRole::kClient).authority);
  EXPECT_EQ(site_credentials(site_ + ".before-1", RpcRole::kClient).authority, before);
  EXPECT_EQ(desk_->wait(std::chrono::seconds(30)), 0) << desk_->output();
  const auto [again, refused_peer] = there(pair_words(offer, {"--replace"}));
  EXPECT_EQ(again, 1);
  EXPECT_NE(refused_peer.find("no slave is ready for pairing at " + offer.address), std::string::npos)
      << refused_peer;
}

TEST_F(Pairing, RefusesTokenFromArgumentsOrReadableFile) {
  const Offer offer = open_desk();
  const auto [status, said] = there({"pair", "--slave", offer.address, offer.token});
  EXPECT_EQ(status, 2);
  EXPECT_NE(said.find("--token-file"), std::string::npos) << said;
  EXPECT_EQ(desk_->output().find("pair --slave " + offer.address + " "), std::string::npos)
      << "nor is it printed as an argument";
  auto words = pair_words(offer);
  std::filesystem::permissions(words.back(), std::filesystem::perms::others_read,
                               std::filesystem::perm_options::add);
  const auto [open, why] = there(words);
  EXPECT_EQ(open, 2);
  EXPECT_NE(why.find("chmod go="), std::string::npos) << why;
  const auto [done, answer] = there(pair_words(offer));
  EXPECT_EQ(done, 0) << answer;
}

TEST_F(Pairing, AHostThatIsUnpairedLosesTheRobotAndGetsItNoMore) {
  const Offer offer = open_desk();
  ASSERT_EQ(there(pair_words(offer)).first, 0);
  ASSERT_EQ(desk_->wait(std::chrono::seconds(30)), 0);
  start_slave();
  start_master({"--operator", "none", "--engage", "--site", site_});
  ASSERT_TRUE(both_engaged()) << outputs();
  const std::string rpc = "127.0.0.1:" + std::to_string(ports_.slave_rpc);
  EXPECT_EQ(there({"--slave", rpc, "get", "slave", "loop.rate_hz"}).first, 0) << "the control";

  RunningProgram list("longreach", {"pair", "--list"});
  ASSERT_EQ(list.wait(std::chrono::seconds(60)), 0) << list.output();
  const std::string host = list.output().substr(0, list.output().find(' '));
  EXPECT_NE(list.output().find("  master  since 2"), std::string::npos) << list.output();
  EXPECT_NE(list.output().find("  client  since 2"), std::string::npos) << list.output();
  RunningProgram refused_peer("longreach", {"unpair", "nobody-of-this-name"});
  EXPECT_EQ(refused_peer.wait(std::chrono::seconds(60)), 1);
  EXPECT_NE(refused_peer.output().find("pair --list"), std::string::npos) << refused_peer.output();
  EXPECT_EQ(slave_.state(), "Engaged") << "nothing was revoked";

  RunningProgram unpair("longreach", {"unpair", host});
  ASSERT_EQ(unpair.wait(std::chrono::seconds(60)), 0) << unpair.output();
  EXPECT_TRUE(eventually([this] { return slave_.state() == "Holding"; })) << outputs();
  EXPECT_TRUE(eventually([this] { return slave_.status()->lease().empty(); })) << outputs();
  const auto [refused, why] = there({"--slave", rpc, "get", "slave", "loop.rate_hz"});
  EXPECT_EQ(refused, 1);
  EXPECT_NE(why.find("revoked"), std::string::npos) << why;
  EXPECT_TRUE(says(*master_program_, "revoked")) << outputs();

  // Pairing it again gives it new certificates.
  const Offer again = open_desk();
  EXPECT_EQ(there(pair_words(again, {"--replace"})).first, 0);
  EXPECT_EQ(there({"--slave", rpc, "get", "slave", "loop.rate_hz"}).first, 0);
}

TEST_F(Pairing, WhatIsNoSlaveThatPairsIsSaidToBeNone) {
  start_slave();
  ASSERT_TRUE(eventually([this] { return slave_.state() == "Idle"; })) << outputs();
  const Offer offer = open_desk();
  const auto [status, said] =
      there(pair_words({"127.0.0.1:" + std::to_string(ports_.slave_rpc), offer.token}));
  EXPECT_EQ(status, 1);
  EXPECT_NE(said.find("is not a longreach slave that is ready for pairing"), std::string::npos) << said;
  desk_->signal(SIGINT);
  EXPECT_EQ(desk_->wait(std::chrono::seconds(30)), 1) << desk_->output();
  EXPECT_NE(desk_->output().find("the token is now invalid"), std::string::npos) << desk_->output();
}

}  // namespace
}  // namespace longreach::pair_test
