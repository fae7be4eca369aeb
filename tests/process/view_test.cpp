// `longreach view` beside both programs: what a browser sees and does, what happens to the robot when the
// page or its server goes, and that neither can disturb the loops.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include "tests/process/delayed_tcp.hpp"
#include "tests/process/load.hpp"
#include "tests/process/view_station.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::view_test {
namespace {

class View : public ViewStation {
 protected:
  bool pressing() {
    const auto status = master_.status();
    return status && status->state() == "Engaged" && status->in_contact() && status->force_n() > 0.5;
  }

  /// Keeps the handle at home, or reaches out 4 mm, until it fails or the time is over.
  static void aim(const PageClient& page, std::chrono::milliseconds time, const std::atomic<bool>& reaches) {
    for (auto left = time; left.count() > 0; left -= std::chrono::milliseconds(20)) {
      if (!page.send(reaches ? R"({"aim":[0.004,0,0]})" : R"({"aim":[0,0,0]})")) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }
};

TEST_F(View, BrowserFollowsADemoChangesItAndStopsIt) {
  start_slave({"--profile", "analog", "--set", "link.impairment.rpc_delay_s=0"});
  start_master(
      {"--profile", "analog", "--operator", "script", "--engage", "--set", "operator.probe_cycles=1000"});
  start_view();
  if (!HasFatalFailure()) drive("demo");
}

TEST_F(View, APersonWithABrowserFeelsTheWallOverTheMoon) {
  start_slave({"--profile", "moon", "--set", "link.impairment.rpc_delay_s=0"});
  start_master({"--profile", "moon", "--operator", "none"});
  start_view();
  if (!HasFatalFailure()) drive("path");
}

TEST_F(View, BodiesAreDrawnWhereTheyWereOneDelayAgo) {
  const TemporaryFolder folder;
  folder.write("load.xml",
               "<mujoco><option gravity='0 0 0'/><asset><material name='hard'/></asset><worldbody>"
               "<body name='tool'><freejoint/>"
               "<geom type='sphere' size='0.02' mass='1' pos='-0.1 0 0' material='hard'/></body>"
               "<body name='load' pos='0.16 0 0'><freejoint/>"
               "<geom type='box' size='0.1 0.1 0.1' mass='5' material='hard'/>"
               "<geom type='capsule' size='0.01' fromto='-0.16 0 0 -0.1 0 0' mass='0.1' material='hard'/>"
               "<site name='fixture' pos='-0.16 0 0'/></body></worldbody></mujoco>");
  const auto scene =
      folder.write("load.txtpb",
                   "name: 'load'\nmaterial { name: 'hard' stiffness_n_per_m: 20000 }\n"
                   "bodies { mjcf_file: 'load.xml' gripper {} goal { position_m: [-0.1, 0.2, 0.05] } }\n");
  start_slave({"--profile", "lab", "--set", "scene_file=" + scene.string(), "--set",
               "link.impairment.rpc_delay_s=0"});
  start_master({"--profile", "lab", "--operator", "none", "--mode", "position"});
  start_view();
  if (!HasFatalFailure()) drive("bodies");
}

TEST_F(View, BallsOfAPathTurnRedAndTheTrajectoryIsDrawn) {
  start_slave({"--profile", "lab", "--set", "scene_file=scenes/path.txtpb", "--set",
               "link.impairment.rpc_delay_s=0"});
  start_master({"--profile", "lab", "--operator", "none"});
  start_view();
  if (!HasFatalFailure()) drive("task");
}

// As with `ssh -L OTHER:127.0.0.1:PORT`.
TEST_F(View, BrowserOpensThePageThroughATunnel) {
  start_slave();
  start_master({"--operator", "none"});
  start_view();
  const std::string here = "127.0.0.1:" + std::to_string(port_);
  EXPECT_NE(view_->output().find("ssh -L " + std::to_string(port_) + ":" + here + " "), std::string::npos)
      << view_->output();
  const DelayedTcp tunnel(here, {});
  address_.replace(address_.find(here), here.size(), tunnel.address());
  drive("open");
  EXPECT_GT(tunnel.delivered(), 0U);
}

TEST_F(View, APageSaysThatTheMasterIsAwayAndGoesOnWhenItIsBack) {
  start_slave();
  start_master({"--operator", "none"});
  start_view();
  const auto page = driver("away");
  ASSERT_TRUE(says(*page, "seen: observing")) << page->output();
  master_program_->signal(SIGKILL);
  ASSERT_TRUE(says(*page, "says why")) << page->output();
  start_master({"--operator", "none"});
  finish(*page);
}

std::string get(const std::string& path, const std::string& host) {
  return "GET " + path + " HTTP/1.1\r\nHost: " + host + "\r\n\r\n";
}

TEST_F(View, AskedFromElsewhereItSaysNothing) {
  start_slave();
  start_master();
  start_view();
  const std::string here = "127.0.0.1:" + std::to_string(port_);
  const std::string page = path_of(address_);
  EXPECT_EQ(http_status(port_, get(page, here)), "HTTP/1.1 200 OK");
  EXPECT_EQ(http_status(port_, get(page, "evil.example")), "HTTP/1.1 403 Forbidden");
  EXPECT_EQ(http_status(port_, get(page, "evil.example:" + std::to_string(port_))), "HTTP/1.1 403 Forbidden");
  EXPECT_EQ(
      http_status(port_,
                  "GET " + page + "live HTTP/1.1\r\nHost: " + here +
                      "\r\nOrigin: http://evil.example\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                      "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n"),
      "HTTP/1.1 403 Forbidden");
  EXPECT_EQ(http_status(port_, "POST " + page + " HTTP/1.1\r\nHost: " + here + "\r\n\r\n"),
            "HTTP/1.1 405 Method Not Allowed");
  start_view({"--listen", "0.0.0.0:0"});
  EXPECT_EQ(http_status(port_, get("/", here)), "HTTP/1.1 403 Forbidden");
  EXPECT_EQ(http_status(port_, get(path_of(address_), "anything")), "HTTP/1.1 200 OK");
}

// Another user of this machine can reach the port, and cannot read what `longreach view` printed.
TEST_F(View, WhoHasNotTheAddressGetsNothingAndMovesNothing) {
  start_slave();
  start_master({"--operator", "none"});
  start_view();
  ASSERT_TRUE(eventually([this] { return master_.state() == "Observing"; }));
  const std::string port = std::to_string(port_);
  for (const std::string path : {"/", "/view.js", "/live", "/aaaaaaaaaaaaaaaaaaaaaaaaaa/"})
    EXPECT_EQ(http_status(port_, get(path, "127.0.0.1:" + port)), "HTTP/1.1 403 Forbidden") << path;
  const auto take_and_engage = [](const PageClient& page) {
    (void)page.send(R"({"take":true})");
    (void)page.send(R"({"aim":[0,0,0]})");
    return page.send(R"({"do":"engage"})");
  };
  for (const std::string path : {"/", "/aaaaaaaaaaaaaaaaaaaaaaaaaa/"}) {
    const PageClient unknown_peer("http://127.0.0.1:" + port + path);
    EXPECT_FALSE(unknown_peer.ok()) << path;
    (void)take_and_engage(unknown_peer);
  }
  // What came from the strangers has been dealt with when this is answered.
  PageClient page(address_);
  ASSERT_TRUE(page.read_until("\"frame\""));
  EXPECT_EQ(master_.status()->engagement(), 0u) << outputs();
  const std::atomic<bool> reaches = false;
  EXPECT_TRUE(take_and_engage(page));
  std::thread aiming([&] { aim(page, std::chrono::seconds(5), reaches); });
  EXPECT_TRUE(eventually([this] { return master_.status()->engagement() > 0; }))
      << "the control" << outputs();
  aiming.join();
}

TEST_F(View, AddressOfThePageIsInNoArgumentsThatOthersCanRead) {
  start_slave();
  start_view();
  const std::string token = path_of(address_).substr(1, 26);
  int programs = 0;
  for (const auto& process : std::filesystem::directory_iterator("/proc")) {
    std::ifstream in(process.path() / "cmdline");
    const std::string words((std::istreambuf_iterator<char>(in)), {});
    programs += words.find("longreach") != std::string::npos ? 1 : 0;
    EXPECT_EQ(words.find(token), std::string::npos) << process.path();
  }
  EXPECT_GE(programs, 2);
}

// As many connections as there may be, each of which says a letter now and then.
TEST_F(View, SlowConnectionsOfStrangersDoNotLockThePageOut) {
  start_slave();
  start_master({"--operator", "none"});
  start_view();
  PageClient page(address_);
  ASSERT_TRUE(page.read_until("\"frame\""));
  std::vector<std::unique_ptr<OpenConnection>> slow;
  for (int i = 0; i < 200; ++i) slow.push_back(std::make_unique<OpenConnection>(port_));
  for (const auto& one : slow) (void)one->send("GET / HTT");
  const std::string here = "127.0.0.1:" + std::to_string(port_);
  EXPECT_EQ(http_status(port_, get(path_of(address_), here)), "HTTP/1.1 200 OK");
  PageClient another(address_);
  EXPECT_TRUE(another.ok() && another.read_until("\"frame\""));
  EXPECT_TRUE(page.read_until("\"frame\"")) << "who was let in keeps his place";
  // A request has its time, however many letters come meanwhile.
  EXPECT_TRUE(eventually([&] {
    return std::ranges::all_of(slow, [](const auto& one) { return !one->send("P") || one->ended(); });
  }));
  EXPECT_TRUE(another.read_until("\"frame\""));
}

TEST_F(View, OnePageHasTheHandAndAnybodyMayStop) {
  start_slave();
  start_master({"--operator", "none"});
  start_view();
  PageClient one(address_), other(address_);
  ASSERT_TRUE(one.ok() && other.ok());
  ASSERT_TRUE(one.read_until("\"frame\""));
  ASSERT_TRUE(eventually([this] { return master_.state() == "Observing"; }));
  EXPECT_TRUE(other.send(R"({"do":"engage"})"));
  EXPECT_TRUE(other.read_until("take control first"));
  EXPECT_TRUE(one.send(R"({"take":true})"));
  std::atomic<bool> reaches = false;
  std::thread aiming([&] { aim(one, std::chrono::seconds(10), reaches); });
  EXPECT_TRUE(other.read_until(R"("holder":"other")"));
  EXPECT_TRUE(other.send(R"({"take":true})"));
  EXPECT_TRUE(other.read_until("another page has control"));
  EXPECT_TRUE(one.send(R"({"do":"engage"})"));
  EXPECT_TRUE(both_engaged()) << outputs();
  reaches = true;  // not before: the centre of rate mode is where the handle was when it began
  EXPECT_TRUE(eventually([this] {
    const auto status = master_.status();
    return status && status->goal_m_size() == 3 && status->goal_m(0) > 0.002;
  })) << outputs();
  EXPECT_TRUE(other.send(R"({"do":"stop"})"));
  EXPECT_TRUE(eventually([this] { return slave_.state() == "Stopped" && master_.state() == "Stopped"; }));
  aiming.join();
}

// The slave's RPC accepts connections and never responds; the session of the master works.
TEST_F(View, AStopOfThePageDoesNotWaitForAnEarlierOne) {
  start_slave();
  start_master({"--operator", "none", "--engage"});
  ASSERT_TRUE(both_engaged()) << outputs();
  const DelayedTcp silent("127.0.0.1:" + std::to_string(ports_.slave_rpc), {.delay = std::chrono::hours(1)});
  start_view({}, silent.address());
  PageClient page(address_);
  ASSERT_TRUE(page.read_until("\"frame\""));
  slave_program_->signal(SIGSTOP);  // no session, either: the first stop waits for the slave
  EXPECT_TRUE(page.send(R"({"do":"stop"})"));
  EXPECT_TRUE(eventually([this] { return master_.state() == "Stopped"; })) << outputs();
  // From then on the first stop waits for nothing but the slave's own response, which does not come.
  std::this_thread::sleep_for(std::chrono::seconds(4));
  slave_program_->signal(SIGCONT);
  EXPECT_TRUE(eventually([this] { return slave_.state() == "Stopped"; })) << outputs();
  ASSERT_TRUE(engaged()) << outputs();
  PageClient later(address_);  // the first one, which does not read, is closed after 10 s
  ASSERT_TRUE(later.read_until("\"frame\""));
  EXPECT_TRUE(later.send(R"({"do":"stop"})"));
  EXPECT_TRUE(eventually([this] { return slave_.state() == "Stopped"; }, std::chrono::seconds(10)))
      << outputs();
}

TEST_F(View, AViewerThatDoesNotReadMissesFramesAndNothingElse) {
  start_slave();
  start_master();
  start_view();
  PageClient slow(address_), quick(address_);
  ASSERT_TRUE(slow.read_until("\"frame\""));
  const auto seconds = [](const std::string& message) {
    const std::string before = "{\"frame\":{\"seconds\":";
    return message.starts_with(before) ? std::stod(message.substr(before.size())) : -1.0;
  };
  // The other one is shown everything meanwhile.
  double first = -1.0, last = -1.0, gap = 0.0;
  while (first < 0.0 || last - first < 8.0) {
    const auto message = quick.read();
    ASSERT_TRUE(message) << view_->output();
    if (seconds(*message) < 0.0) continue;
    if (first < 0.0) first = seconds(*message);
    last = seconds(*message);
  }
  for (double before = first; before < last;) {
    const auto message = slow.read();
    ASSERT_TRUE(message) << view_->output();
    if (seconds(*message) < 0.0) continue;
    if (seconds(*message) > first) gap = std::max(gap, seconds(*message) - before);
    before = std::max(before, seconds(*message));
  }
  EXPECT_GT(gap, 1.0) << "what it did not read was kept for it";
}

TEST_F(View, AHandWhoseServerIsKilledIsAHold) {
  start_slave();
  start_master({"--operator", "none"});
  start_view();
  PageClient page(address_);
  ASSERT_TRUE(page.read_until("\"frame\""));
  ASSERT_TRUE(eventually([this] { return master_.state() == "Observing"; }));
  EXPECT_TRUE(page.send(R"({"take":true})"));
  const std::atomic<bool> reaches = true;
  std::thread aiming([&] { aim(page, std::chrono::minutes(2), reaches); });
  EXPECT_TRUE(page.read_until(R"("hand_outside":true)"));
  EXPECT_EQ(master_.engage(), "");
  EXPECT_TRUE(both_engaged()) << outputs();
  view_->signal(SIGKILL);
  EXPECT_TRUE(eventually([this] { return master_.state() == "Holding" && slave_.state() == "Holding"; }))
      << outputs();
  EXPECT_EQ(master_.status()->cause(), "hand stale");
  aiming.join();
}

/// Requests and messages as fast as they go, from several connections, none of which reads.
void flood(const std::string& address, std::chrono::seconds time) {
  std::vector<std::jthread> senders;
  const auto end = std::chrono::steady_clock::now() + time;
  for (int i = 0; i < 4; ++i)
    senders.emplace_back([=] {
      while (std::chrono::steady_clock::now() < end) {
        const PageClient page(address);
        for (int k = 0; k < 1000 && page.send(R"({"scale":0.5})"); ++k) {
        }
        const int port = port_of(address);
        (void)http_status(port, get(path_of(address) + "view.js", "127.0.0.1:" + std::to_string(port)));
      }
    });
}

TEST_F(View, AServerThatIsFloodedFrozenOrKilledDisturbsNothing) {
  start_slave();
  start_master({"--operator", "script", "--engage", "--set", "operator.probe_cycles=1000"});
  ASSERT_TRUE(both_engaged()) << outputs();
  ASSERT_TRUE(eventually([this] { return pressing(); })) << outputs();
  const auto engagement = master_.status()->engagement();
  struct Trial {
    const char* name;
    std::function<void()> run;
  };
  constexpr std::chrono::seconds kTime(4);
  const std::vector<Trial> trials = {{"without it", [&] { std::this_thread::sleep_for(kTime); }},
                                     {"looked at",
                                      [&] {
                                        start_view();
                                        PageClient page(address_);
                                        EXPECT_TRUE(page.read_until("\"frame\""));
                                        std::this_thread::sleep_for(kTime);
                                      }},
                                     {"flooded", [&] { flood(address_, kTime); }},
                                     {"frozen",
                                      [&] {
                                        const PageClient page(address_);
                                        view_->signal(SIGSTOP);
                                        std::this_thread::sleep_for(kTime);
                                        view_->signal(SIGCONT);
                                      }},
                                     {"killed", [&] {
                                        view_->signal(SIGKILL);
                                        std::this_thread::sleep_for(std::chrono::seconds(1));
                                      }}};
  for (const Trial& trial : trials) {
    Disturbance disturbance(slave_, master_);
    trial.run();
    disturbance.expect_none(trial.name);
    EXPECT_EQ(master_.state(), "Engaged") << trial.name << outputs();
    EXPECT_EQ(master_.status()->engagement(), engagement) << trial.name;
  }
  EXPECT_TRUE(eventually([this] { return pressing(); })) << outputs();
}

}  // namespace
}  // namespace longreach::view_test
