// `longreach view` beside both programs: what a browser sees and does, what happens to the robot when the
// page or its server goes, and that neither can disturb the loops.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <thread>

#include "tests/process/load.hpp"
#include "tests/process/page_client.hpp"
#include "tests/process/station.hpp"

namespace longreach {
namespace {

class View : public Station {
 protected:
  void start_view(const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"--master", "127.0.0.1:" + std::to_string(ports_.master_rpc),
                                          "--slave", "127.0.0.1:" + std::to_string(ports_.slave_rpc), "view"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    view_ = std::make_unique<RunningProgram>("longreach", arguments);
    ASSERT_TRUE(says(*view_, "(Ctrl-C ends it)")) << view_->output();
    const std::string said = view_->output();
    const std::size_t begin = said.find("http://");
    address_ = said.substr(begin, said.find("  (") - begin);
    port_ = std::stoi(address_.substr(address_.find(':', 5) + 1));
  }

  /// Drives the page as tests/process/page/drive.mjs describes; pictures stay in the build.
  std::unique_ptr<RunningProgram> driver(const std::string& what) {
    const auto pictures = std::filesystem::path(LONGREACH_BIN).parent_path() / "view";
    std::filesystem::create_directories(pictures);
    // First among what is not real-time, where that is allowed: a picture without a graphics processor takes
    // long.
    const std::vector<std::string> words = {"-n",
                                            "-10",
                                            LONGREACH_NODE,
                                            LONGREACH_PAGE_TESTS "/drive.mjs",
                                            what,
                                            address_,
                                            pictures.string(),
                                            LONGREACH_PAGE,
                                            LONGREACH_CHROMIUM};
    return std::make_unique<RunningProgram>("/usr/bin/nice", words);
  }
  void finish(RunningProgram& driver) {
    const auto status = driver.wait(std::chrono::minutes(9));
    EXPECT_EQ(status, 0) << driver.output() << view_->output() << outputs();
    std::cout << driver.output();
  }
  void drive(const std::string& what) { finish(*driver(what)); }

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

  std::unique_ptr<RunningProgram> view_;
  std::string address_;
  int port_ = 0;
};

TEST_F(View, BrowserFollowsADemoChangesItAndStopsIt) {
  start_slave({"--profile", "analog"});
  start_master(
      {"--profile", "analog", "--operator", "script", "--engage", "--set", "operator.probe_cycles=1000"});
  start_view();
  if (!HasFatalFailure()) drive("demo");
}

TEST_F(View, APersonWithABrowserFeelsTheWallOverTheMoon) {
  start_slave({"--profile", "moon"});
  start_master({"--profile", "moon", "--operator", "none"});
  start_view();
  if (!HasFatalFailure()) drive("path");
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

TEST_F(View, AskedFromElsewhereItSaysNothing) {
  start_slave();
  start_master();
  start_view();
  const std::string get = "GET / HTTP/1.1\r\nHost: ";
  const std::string here = "127.0.0.1:" + std::to_string(port_);
  EXPECT_EQ(http_status(port_, get + here + "\r\n\r\n"), "HTTP/1.1 200 OK");
  EXPECT_EQ(http_status(port_, get + "evil.example\r\n\r\n"), "HTTP/1.1 403 Forbidden");
  EXPECT_EQ(
      http_status(port_,
                  "GET /live HTTP/1.1\r\nHost: " + here +
                      "\r\nOrigin: http://evil.example\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                      "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n"),
      "HTTP/1.1 403 Forbidden");
  EXPECT_EQ(http_status(port_, "POST / HTTP/1.1\r\nHost: " + here + "\r\n\r\n"),
            "HTTP/1.1 405 Method Not Allowed");
  start_view({"--listen", "0.0.0.0:0"});
  const std::string token = address_.substr(address_.find(':', 5));
  EXPECT_GT(token.size(), 30u) << address_;
  EXPECT_EQ(http_status(port_, get + here + "\r\n\r\n"), "HTTP/1.1 403 Forbidden");
  EXPECT_EQ(
      http_status(port_, "GET " + token.substr(token.find('/')) + " HTTP/1.1\r\nHost: anything\r\n\r\n"),
      "HTTP/1.1 200 OK");
}

TEST_F(View, OnePageHasTheHandAndAnybodyMayStop) {
  start_slave();
  start_master({"--operator", "none"});
  start_view();
  PageClient one(port_), other(port_);
  ASSERT_TRUE(one.ok() && other.ok());
  ASSERT_TRUE(one.read_until("\"frame\""));
  ASSERT_TRUE(eventually([this] { return master_.state() == "Observing"; }));
  EXPECT_TRUE(other.send(R"({"do":"engage"})"));
  EXPECT_TRUE(other.read_until("take the hand first"));
  EXPECT_TRUE(one.send(R"({"take":true})"));
  std::atomic<bool> reaches = false;
  std::thread aiming([&] { aim(one, std::chrono::seconds(10), reaches); });
  EXPECT_TRUE(other.read_until(R"("holder":"other")"));
  EXPECT_TRUE(other.send(R"({"take":true})"));
  EXPECT_TRUE(other.read_until("another page has the hand"));
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

TEST_F(View, AViewerThatDoesNotReadMissesFramesAndNothingElse) {
  start_slave();
  start_master();
  start_view();
  PageClient slow(port_), quick(port_);
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
  PageClient page(port_);
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
  EXPECT_EQ(master_.status()->cause(), "operator");
  aiming.join();
}

/// Requests and messages as fast as they go, from several connections, none of which reads.
void flood(int port, std::chrono::seconds time) {
  std::vector<std::jthread> senders;
  const auto end = std::chrono::steady_clock::now() + time;
  for (int i = 0; i < 4; ++i)
    senders.emplace_back([=] {
      while (std::chrono::steady_clock::now() < end) {
        const PageClient page(port);
        for (int k = 0; k < 1000 && page.send(R"({"scale":0.5})"); ++k) {
        }
        (void)http_status(port,
                          "GET /view.js HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) + "\r\n\r\n");
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
                                        PageClient page(port_);
                                        EXPECT_TRUE(page.read_until("\"frame\""));
                                        std::this_thread::sleep_for(kTime);
                                      }},
                                     {"flooded", [&] { flood(port_, kTime); }},
                                     {"frozen",
                                      [&] {
                                        const PageClient page(port_);
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
}  // namespace longreach
