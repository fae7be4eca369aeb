// Slave and master on two hosts (network namespaces), with the delay and the losses that longreach-wire makes
// of real packets: of datagrams and of TCP alike.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <future>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <thread>

#include "tests/process/hosts_run.hpp"
#include "tests/process/load.hpp"

namespace longreach::hosts_test {
namespace {

using std::chrono::seconds;

std::vector<double> numbers_in(const std::string& text, const std::string& pattern) {
  std::smatch found;
  std::vector<double> numbers;
  if (!std::regex_search(text, found, std::regex(pattern))) return numbers;
  for (std::size_t i = 1; i < found.size(); ++i) numbers.push_back(std::stod(found[i]));
  return numbers;
}

/// The checks of the master's verdict that failed; not those of lateness where the machine stood still.
std::string failed_checks(const std::string& output, bool machine_stood_still) {
  static const std::regex kLate("late by over 100 ms|holds");
  std::istringstream lines(output);
  std::string failed;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("  FAIL") || (machine_stood_still && std::regex_search(line, kLate))) continue;
    failed += line + "\n";
  }
  return failed;
}

TEST(Hosts, FullSessionOverThreeSecondsDelayAndFivePercentLoss) {
  BareLoops machine;
  HostsRun hosts({"--delay", "3s", "--loss", "5%", "--seconds", "300"});
  ASSERT_TRUE(hosts.up()) << hosts.all();
  const auto status = hosts.client({"status", "--json"});
  ASSERT_TRUE(hosts.shows(" Engaged ", seconds(150))) << hosts.all();
  // The displayed stiffness counts from a round trip after the touch. A touch and the press that follows it are at most
  // three situations, so with the fourth it has counted.
  ASSERT_TRUE(hosts.shows(R"(situation now="touching")", seconds(200), 4)) << hosts.all();
  ASSERT_EQ(status->wait(seconds(120)), 0) << status->output();
  EXPECT_NE(status->output().find("\"side\":\"slave\""), std::string::npos) << status->output();

  const auto stop = hosts.client({"stop"});
  ASSERT_TRUE(hosts.shows(" Stopped ", seconds(60))) << hosts.all();
  EXPECT_EQ(stop->wait(seconds(120)), 0) << stop->output();
  EXPECT_NE(hosts.log().find("to=Stopped"), std::string::npos) << hosts.log();
  hosts.script().signal(SIGTERM);
  const auto ended = hosts.script().wait(seconds(30));
  const bool stood_still = machine.end().stalls > 0;
  const bool fault = hosts.output().find("verdict: ended in a fault") != std::string::npos;
  EXPECT_EQ(ended, fault ? 1 : 0) << hosts.all();
  EXPECT_TRUE(!fault || stood_still) << hosts.all();
  EXPECT_EQ(failed_checks(hosts.output(), stood_still), "") << hosts.all();

  const auto stiffness =
      numbers_in(hosts.output(), R"(displayed stiffness ([0-9.]+) N/mm, the wall ([0-9.]+) N/mm)");
  ASSERT_EQ(stiffness.size(), 2u) << hosts.output();
  EXPECT_NEAR(stiffness[0] / stiffness[1], 1.0, 0.05);
  const auto trip = numbers_in(hosts.output(), R"(round trip ([0-9.]+) s)");
  ASSERT_EQ(trip.size(), 1u);
  EXPECT_GE(trip[0], 6.0);
  const auto wire = numbers_in(hosts.log(), R"(longreach-wire: packets=(\d+) dropped=(\d+))");
  ASSERT_EQ(wire.size(), 2u) << hosts.log();
  EXPECT_GT(wire[1], 0.0);
}

TEST(Hosts, FivePointFiveSecondsAwayTheyStillConnect) {
  HostsRun hosts({"--delay", "5.5s", "--loss", "5%", "--seconds", "300"});
  ASSERT_TRUE(hosts.up()) << hosts.all();
  const auto status = hosts.client({"status", "--json"});
  // RPC with mutual TLS hands over the session; with it the datagrams go both ways.
  ASSERT_TRUE(hosts.shows("session number=", seconds(240))) << hosts.all();
  EXPECT_TRUE(hosts.shows(" Observing ", seconds(60))) << hosts.all();
  EXPECT_NE(hosts.log().find("to=Observing"), std::string::npos) << hosts.log();
  EXPECT_EQ(status->wait(seconds(120)), 0) << status->output();
  EXPECT_NE(status->output().find("\"side\":\"slave\""), std::string::npos) << status->output();
}

TEST(Hosts, ATimeoutOverASlowLinkIsExplainedWithMeasuredTimes) {
  HostsRun hosts({"--delay", "1.3s", "--seconds", "120"});
  ASSERT_TRUE(hosts.up()) << hosts.all();
  const std::vector<std::string> get{"get", "slave", "command.force_guard_n"};
  const auto patient = hosts.client(get), hurried = hosts.client({"--timeout", "5", get[0], get[1], get[2]});
  EXPECT_EQ(hurried->wait(seconds(60)), 1) << hurried->output();
  // A round trip of 2.6 s, measured from the host of the master.
  EXPECT_TRUE(
      std::regex_search(hurried->output(), std::regex("within 5 s: its host answered a TCP handshake within "
                                                      "(2\\.[6-9]|3\\.[0-9])[0-9] s, but the TLS handshake")))
      << hurried->output();
  EXPECT_EQ(patient->wait(seconds(60)), 0) << patient->output();
}

/// Means over windows of the monitors' 2 s.
struct Seen {
  double rtt_s = 0.0;
  double loss_up = 0.0;
  double loss_down = 0.0;
};

Seen look(HostsRun& hosts) {
  constexpr int kWindows = 6;
  Seen seen;
  std::this_thread::sleep_for(seconds(4));
  for (int i = 0; i < kWindows; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2100));
    // A handshake may fail across a link that loses segments: one asks again.
    auto client = hosts.client({"status", "--json"});
    for (int again = 0; again < 3 && client->wait(seconds(60)) != 0; ++again)
      client = hosts.client({"status", "--json"});
    EXPECT_EQ(client->wait(seconds(60)), 0) << client->output();
    const auto both = nlohmann::json::parse(client->output(), nullptr, false);
    if (both.is_discarded()) return {};
    seen.rtt_s += both["master"]["link"]["rtt_s"].get<double>() / kWindows;
    seen.loss_up += both["slave"]["link"]["loss"].get<double>() / kWindows;
    seen.loss_down += both["master"]["link"]["loss"].get<double>() / kWindows;
  }
  return seen;
}

/// What keeps the packets under way: the kernel where it can, or we.
class HostsWire : public ::testing::TestWithParam<const char*> {};

TEST_P(HostsWire, MakesTheFiguresThatOurImpairmentMakes) {
  HostsRun real({"--delay", "150ms", "--loss", "10%", "--seconds", "120", "--wire", GetParam()});
  HostsRun ours({"--seconds", "120"});
  ASSERT_TRUE(real.up() && ours.up()) << real.all() << ours.all();
  ASSERT_TRUE(real.shows(" Engaged ", seconds(60)) && ours.shows(" Engaged ", seconds(60)))
      << real.all() << ours.all();
  const auto set = ours.client({"link", "set", "--delay", "150ms", "--loss", "10%"});
  ASSERT_EQ(set->wait(seconds(30)), 0) << set->output();

  auto other = std::async(std::launch::async, [&real] { return look(real); });
  const Seen b = look(ours);
  const Seen a = other.get();
  // A delay cannot come out shorter; both ticks and a busy machine add some.
  EXPECT_GE(a.rtt_s, 0.3);
  EXPECT_GE(b.rtt_s, 0.3);
  EXPECT_NEAR(a.rtt_s, b.rtt_s, 0.02);
  // 5 standard deviations of 6 windows: 400 datagrams each on the way up, at least 64 down.
  EXPECT_NEAR(a.loss_up, 0.1, 0.031);
  EXPECT_NEAR(b.loss_up, 0.1, 0.031);
  EXPECT_NEAR(a.loss_down, 0.1, 0.077);
  EXPECT_NEAR(b.loss_down, 0.1, 0.077);
}

INSTANTIATE_TEST_SUITE_P(Hosts, HostsWire, ::testing::Values("auto", "relay"),
                         [](const auto& kind) { return std::string(kind.param); });

bool gone(int id, seconds timeout) {
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  while (::kill(id, 0) == 0) {
    if (std::chrono::steady_clock::now() >= deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return true;
}

TEST(Hosts, LeaveNothingBehindWhenTheyAreKilledOutright) {
  HostsRun hosts({"--delay", "10ms"});
  ASSERT_TRUE(hosts.up()) << hosts.all();
  const int holder = hosts.holder();
  ASSERT_GT(holder, 1);
  ASSERT_EQ(::kill(holder, 0), 0);
  hosts.script().signal(SIGKILL);
  EXPECT_TRUE(gone(holder, seconds(30)));
}

TEST(Hosts, ReportBadOptionsAndMissingNamespacePermission) {
  const auto refused = [](const std::string& program, std::vector<std::string> words,
                          const std::string& about) {
    RunningProgram run(program, words);
    EXPECT_EQ(run.wait(seconds(30)), 2) << run.output();
    const std::string said = run.output();
    EXPECT_NE(said.find(about), std::string::npos) << said;
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
  };
  const std::string hosts = std::string(LONGREACH_DEPLOY) + "/hosts";
  refused(hosts, {"--delay", "soon"}, "--delay needs a time");
  refused(hosts, {"--loss", "much"}, "--loss needs a fraction");
  refused(hosts, {"--wire", "rope"}, "--wire needs auto, queue or relay");
  refused(hosts, {"--operator", "ghost"}, "--operator needs script or keyboard");
  refused(hosts, {"--operator", "keyboard"}, "needs a terminal");
  refused(hosts, {"--bin", LONGREACH_DEPLOY}, "has no longreach-master");
  refused(hosts, {"--seconds"}, "--seconds needs a value");
  refused("/usr/bin/unshare",
          {"--user", hosts, "--bin", LONGREACH_BIN},  // nobody in particular, without a single right
          "does not let this user make network namespaces");
}

}  // namespace
}  // namespace longreach::hosts_test
