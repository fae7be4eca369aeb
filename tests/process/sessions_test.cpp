// Sessions of a person at the keyboard of the real programs, drawn by a script: a run in which all protections did their
// work ends well or with events, and a run that ends in a fault names it and has exit status 1.
#include <csignal>
#include <cstdio>
#include <future>
#include <regex>
#include <thread>

#include "common/core/random.hpp"
#include "tests/process/terminal.hpp"
#include "tests/support/station.hpp"

namespace longreach::sessions_test {
namespace {

constexpr int kTogether = 3;  // pairs that run at the same time

/// Both programs, with a wall of 1 N/mm 20 mm in front of the tool and a keyboard at the master.
class KeyboardPair : public Station {
 public:
  void TestBody() override {}

  /// Returns false if the robot does not follow the hand in time.
  bool start() {
    start_slave({"--profile", "lab", "--set", "scene.surface.wall.plane.point_m=0.02,0,0"});
    start_the_master();
    return both_engaged();
  }
  void start_the_master() {
    start_master({"--profile", "lab", "--operator", "keyboard", "--engage", "--seconds", "600", "--mode",
                  "position", "--view", "plain", "--set", "hand.grip=FIRM"},
                 {terminal_->inner, -1, -1});
  }
  void type(const std::string& keys) {
    for (const char key : keys) {
      terminal_->type(std::string(1, key));
      std::this_thread::sleep_for(std::chrono::milliseconds(key == 'e' || key == 'x' ? 700 : 60));
    }
  }
  /// Ends the session and returns its exit status.
  int quit() {
    terminal_->type("q");
    return ended();
  }
  int ended() { return master_program_->wait(std::chrono::seconds(60)).value_or(-1); }
  void close_terminal() { terminal_.reset(); }
  RunningProgram& slave() { return *slave_program_; }
  RunningProgram& master() { return *master_program_; }
  std::string text() const { return master_program_ ? master_program_->output() : ""; }
  std::string verdict() const {
    const std::string all = text();
    const std::size_t at = all.find("verdict: ended ");
    return at == std::string::npos ? "no verdict" : all.substr(at, all.find('\n', at) - at);
  }
  bool waits_for(const std::string& situation) {
    return eventually([&] { return master_.status().value_or(proto::Status{}).situation() == situation; });
  }

 private:
  std::optional<Terminal> terminal_{std::in_place};
};

/// Presses, slides, changes mode and scale, uses the clutch and the gripper, stops and engages again.
std::string drawn_keys(Random random) {
  static const std::vector<std::string> kDone = {"WWWWWW", "SSS", "wwww", "AAD",  "RF", "c",
                                                 "+",      "--",  "xe",   "WWWW", "dd", "WWWWcc",
                                                 "mWWm",   "ggg", " ",    "??"};
  std::string keys = "WWWW";
  for (int i = 0; i < 6; ++i)
    keys += kDone[static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(kDone.size())))];
  return keys;
}

TEST(Sessions, OfAPersonAtTheKeyboardEndWellOrWithEvents) {
  constexpr int kSessions = 20;
  std::vector<std::future<void>> running;
  std::vector<std::unique_ptr<KeyboardPair>> pairs;  // ports are drawn one after the other
  for (int i = 0; i < kSessions; ++i) pairs.push_back(std::make_unique<KeyboardPair>());
  for (int lane = 0; lane < kTogether; ++lane) {
    running.push_back(std::async(std::launch::async, [&pairs, lane] {
      for (int i = lane; i < kSessions; i += kTogether) {
        KeyboardPair& pair = *pairs[static_cast<std::size_t>(i)];
        const std::string keys = drawn_keys(Random(static_cast<std::uint64_t>(i) + 1));
        EXPECT_TRUE(pair.start()) << pair.text();
        pair.type(keys);
        const int status = pair.quit();
        const std::string verdict = pair.verdict();
        EXPECT_EQ(status, 0) << keys << "\n" << pair.text();
        EXPECT_TRUE(verdict == "verdict: ended well" || verdict == "verdict: ended with events")
            << keys << "\n"
            << pair.text();
        std::printf("session %d, keys \"%s\": %s, exit status %d\n", i + 1, keys.c_str(), verdict.c_str(),
                    status);
        pairs[static_cast<std::size_t>(i)].reset();
      }
    }));
  }
  for (auto& lane : running) lane.get();
}

struct Fault {
  const char* name;
  std::function<void(KeyboardPair&)> act;  // leaves a master that has ended or is about to
  const char* named;                       // regular expression
  bool starts = true;
};

TEST(Sessions, ThatEndInAFaultNameIt) {
  static const std::vector<Fault> kFaults = {
      {"the slave is killed",
       [](KeyboardPair& p) { p.slave().signal(SIGKILL), p.waits_for("silent"), p.type("q"); },
       "(nothing received from the slave|no program is listening there)"},
      {"the slave is suspended",
       [](KeyboardPair& p) { p.slave().signal(SIGSTOP), p.waits_for("silent"), p.type("q"); },
       "(nothing received from the slave|no program is listening there)"},
      {"the slave ends in a contact",
       [](KeyboardPair& p) {
         p.type("WWWWWWWW");
         p.waits_for("touching");
         p.slave().signal(SIGTERM);
         p.waits_for("silent");
         p.type("q");
       },
       "(nothing received from the slave|no program is listening there)"},
      {"the keyboard is gone",
       [](KeyboardPair& p) {
         p.close_terminal();
         p.waits_for("fault");
         p.master().signal(SIGTERM);
       },
       "no keyboard is available", true},
      {"the slave was never there", [](KeyboardPair& p) { p.start_the_master(), p.type("ww"), p.type("q"); },
       "round trip: not measured", false},
  };
  for (int repeat = 0; repeat < 2; ++repeat) {
    std::vector<std::future<void>> running;
    std::vector<std::unique_ptr<KeyboardPair>> pairs;
    for (std::size_t i = 0; i < kFaults.size(); ++i) pairs.push_back(std::make_unique<KeyboardPair>());
    for (std::size_t i = 0; i < kFaults.size(); ++i) {
      running.push_back(std::async(std::launch::async, [&pair = *pairs[i], &fault = kFaults[i]] {
        EXPECT_TRUE(!fault.starts || pair.start()) << fault.name << "\n" << pair.text();
        fault.act(pair);
        const int status = pair.ended();
        EXPECT_EQ(status, 1) << fault.name << "\n" << pair.text();
        EXPECT_EQ(pair.verdict().find("verdict: ended in a fault: "), 0u) << fault.name << "\n"
                                                                          << pair.text();
        EXPECT_TRUE(std::regex_search(pair.verdict(), std::regex(fault.named))) << fault.name << "\n"
                                                                                << pair.text();
        std::printf("%s: %s, exit status %d\n", fault.name, pair.verdict().c_str(), status);
      }));
    }
    for (auto& one : running) one.get();
  }
}

}  // namespace
}  // namespace longreach::sessions_test
