// longreach doctor on hosts that are well and on hosts that are not: each finding that one machine can
// provoke.
#include <sys/stat.h>

#include <array>
#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "common/rpc/rpc_server.hpp"
#include "common/site/site.hpp"
#include "tests/process/datagram_tap.hpp"
#include "tests/support/station.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/common/rpc/control_fake_backend.hpp"

namespace longreach::doctor_test {
namespace {

namespace fs = std::filesystem;

class Doctor : public Station {
 protected:
  struct Visit {
    int status = -1;
    std::string text{};
    [[nodiscard]] bool says(const std::string& words) const {
      // Lines are wrapped for people.
      std::string flat;
      for (const char c : text)
        if (!(std::isspace(static_cast<unsigned char>(c)) != 0 && (flat.empty() || flat.back() == ' ')))
          flat += c == '\n' ? ' ' : c;
      return flat.find(words) != std::string::npos;
    }
  };

  [[nodiscard]] std::vector<std::string> words(const std::vector<std::string>& more) const {
    std::vector<std::string> out{"doctor",
                                 "--seconds",
                                 "0.3",
                                 "--slave",
                                 "127.0.0.1:" + std::to_string(ports_.slave_rpc),
                                 "--master",
                                 "127.0.0.1:" + std::to_string(ports_.master_rpc)};
    out.insert(out.end(), more.begin(), more.end());
    return out;
  }
  [[nodiscard]] Visit visit(const std::vector<std::string>& more = {}) const {
    RunningProgram program("longreach", words(more));
    const int status = program.wait(std::chrono::seconds(60)).value_or(-1);
    return {status, program.output()};
  }
  /// A site of its own, made by looking for credentials.
  fs::path new_site(const std::string& name) {
    const fs::path site = folder_.path() / name;
    (void)site_credentials(site, RpcRole::kClient);
    return site;
  }

  TemporaryFolder folder_;
};

TEST_F(Doctor, FindsNothingWrongWhereNothingRunsAndMakesNothing) {
  const fs::path site = folder_.path() / "none";
  const Visit visit = this->visit({"--site", site.string()});
  EXPECT_EQ(visit.status, 0) << visit.text;
  EXPECT_TRUE(visit.says("there is no site yet")) << visit.text;
  EXPECT_TRUE(visit.says("start longreach-slave")) << visit.text;
  EXPECT_FALSE(fs::exists(site));
}

TEST_F(Doctor, FindsBothSidesWell) {
  start_slave();
  start_master({"--operator", "none", "--engage"});
  ASSERT_TRUE(both_engaged()) << outputs();
  const std::uint64_t accepted = slave_.counter("accepted");
  const Visit visit = this->visit();
  EXPECT_EQ(visit.status, 0) << visit.text;
  for (const std::string words :
       {"0 failures", "of 1000 Hz", "5 of 5 datagrams of 508 bytes arrived",
        "Engaged; the robot is controlled by the master at 127.0.0.1:", "the same as this program",
        "round trip", "signed by the authority, valid until 9999-12-31"})
    EXPECT_TRUE(visit.says(words)) << words << "\n" << visit.text;
  EXPECT_FALSE(visit.says("other senders")) << visit.text;
  EXPECT_EQ(slave_.state(), "Engaged");
  EXPECT_EQ(slave_.counter("rejected_version"), 5U);
  EXPECT_GT(slave_.counter("accepted"), accepted);
  EXPECT_NE(this->visit({"--json"}).text.find("{\"failures\":0,"), std::string::npos);
}

TEST_F(Doctor, AMasterWithoutASlaveIsAFailure) {
  start_master({"--operator", "none"});
  ASSERT_TRUE(eventually([this] {
    const auto now = master_.status();
    return now && !now->trouble().empty();
  })) << outputs();
  const Visit visit = this->visit();
  EXPECT_EQ(visit.status, 1) << visit.text;
  EXPECT_TRUE(visit.says("no session with the slave at")) << visit.text;
  EXPECT_TRUE(visit.says("no program is listening at")) << visit.text;
}

TEST_F(Doctor, ASlaveThatAnswersFromAnotherAddressIsAFailure) {
  DatagramTap tap(ports_.link);
  tap.answer_from_elsewhere();
  start_slave();
  start_master({"--operator", "none", "--set", "link.slave=" + tap.address()});
  ASSERT_TRUE(eventually([this] {
    const auto now = master_.status();
    return now && now->trouble().find("no datagrams arrive from") != std::string::npos;
  })) << outputs();
  const Visit visit = this->visit();
  EXPECT_EQ(visit.status, 1) << visit.text;
  const std::vector<std::string> expected{
      "responds, but no datagrams arrive from " + tap.address() + ": ",
      "datagrams arrived from other addresses; set link.slave to the address from which the slave sends",
      "other senders", "datagrams arrived from addresses other than link.slave; they had no effect",
      "if they come from the slave, set link.slave to the address from which it sends"};
  for (const std::string& words : expected) EXPECT_TRUE(visit.says(words)) << words << "\n" << visit.text;
}

TEST_F(Doctor, ReadableSiteFailsAndReportsChmodCommand) {
  const fs::path site = new_site("open");
  ::chmod((site / "master.key").c_str(), 0644);
  const Visit visit = this->visit({"--site", site.string()});
  EXPECT_EQ(visit.status, 1) << visit.text;
  EXPECT_TRUE(visit.says("master.key is accessible to other users")) << visit.text;
  EXPECT_TRUE(visit.says("chmod -R go= " + site.string())) << visit.text;
}

TEST_F(Doctor, AMissingRoleIsAFailure) {
  const fs::path site = new_site("half");
  fs::remove(site / "slave.key");
  const Visit visit = this->visit({"--site", site.string()});
  EXPECT_EQ(visit.status, 1) << visit.text;
  EXPECT_TRUE(visit.says("slave.key is missing")) << visit.text;
}

TEST_F(Doctor, CertificatesThatDoNotBelongTogetherAreFailures) {
  const fs::path site = new_site("mixed"), other = new_site("other");
  fs::copy_file(other / "master.crt", site / "master.crt", fs::copy_options::overwrite_existing);
  fs::copy_file(other / "client.key", site / "client.key", fs::copy_options::overwrite_existing);
  const Certificate authority = site_authority(site);
  const Certificate old = issue(authority, {.name = "slave.longreach", .not_after = "20010101000000Z"});
  std::ofstream(site / "slave.crt") << old.certificate_pem;
  std::ofstream(site / "slave.key") << old.key_pem;
  const Visit visit = this->visit({"--site", site.string()});
  EXPECT_EQ(visit.status, 1) << visit.text;
  EXPECT_TRUE(visit.says("master.crt: it does not match its key")) << visit.text;
  EXPECT_TRUE(visit.says("client.crt: it does not match its key")) << visit.text;
  EXPECT_TRUE(visit.says("slave.crt: it is not valid for this site: certificate has expired")) << visit.text;
}

TEST_F(Doctor, AnotherSitesSlaveIsAFailure) {
  start_slave();
  ASSERT_TRUE(eventually([this] { return slave_.state() == "Idle"; })) << outputs();
  const Visit visit = this->visit({"--site", new_site("stranger").string()});
  EXPECT_EQ(visit.status, 1) << visit.text;
  EXPECT_TRUE(visit.says("its certificate is not valid for this site")) << visit.text;
}

TEST_F(Doctor, APortThatAnotherProgramHasIsAFailure) {
  asio::io_context context;
  const asio::ip::tcp::acceptor other(
      context, {asio::ip::address_v4::loopback(), static_cast<std::uint16_t>(ports_.slave_rpc)});
  const Visit visit = this->visit({"--timeout", "1"});
  EXPECT_EQ(visit.status, 1) << visit.text;
  EXPECT_TRUE(visit.says("find the program that uses the port with ss -ltnp")) << visit.text;
}

TEST_F(Doctor, AnotherVersionIsAFailure) {
  // The fake side does not say its version, as no program of this one does.
  FakeBackend backend("slave");
  const RpcServer server("127.0.0.1:" + std::to_string(ports_.slave_rpc), backend, "slave",
                         test_site(RpcRole::kSlave));
  const Visit visit = this->visit();
  EXPECT_EQ(visit.status, 1) << visit.text;
  EXPECT_TRUE(visit.says("install the same version on all hosts")) << visit.text;
}

TEST_F(Doctor, WithoutRealTimeRightsItWarnsAndSaysHowToGrantThem) {
  // Root has them whatever its limits say, unless the capabilities go.
  std::string command = "prlimit --rtprio=0 --memlock=65536 " + std::string(LONGREACH_BIN) + "/longreach";
  for (const std::string& word : words({"--site", (folder_.path() / "none").string()})) command += " " + word;
  if (::geteuid() == 0) command = "setpriv --bounding-set=-sys_nice,-ipc_lock,-sys_resource " + command;
  std::FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  Visit visit;
  std::array<char, 4096> bytes{};
  while (const std::size_t count = std::fread(bytes.data(), 1, bytes.size(), pipe))
    visit.text.append(bytes.data(), count);
  visit.status = ::pclose(pipe);
  EXPECT_EQ(visit.status, 0) << visit.text;
  EXPECT_TRUE(visit.says("SCHED_FIFO 50 is not permitted")) << visit.text;
  EXPECT_TRUE(visit.says("LimitRTPRIO=50")) << visit.text;
#ifndef __SANITIZE_ADDRESS__  // which locks nothing, and says that it did
  EXPECT_TRUE(visit.says("locking is not permitted")) << visit.text;
#endif
}

}  // namespace
}  // namespace longreach::doctor_test
