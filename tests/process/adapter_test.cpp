// Real devices and robots behind adapters: the reference adapters in a loop, killed, and tried.

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <future>

#include "tests/process/broken_adapter.hpp"
#include "tests/process/robot_box.hpp"
#include "tests/support/station.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::adapter_test {
namespace {

using std::chrono::seconds;

struct Tried {
  int status = -1;
  std::string output;
};

Tried try_adapter(const std::vector<std::string>& options) {
  std::vector<std::string> words{"adapter", "check"};
  words.insert(words.end(), options.begin(), options.end());
  RunningProgram client("longreach", words);
  const int status = client.wait(seconds(60)).value_or(-1);
  return {status, client.output()};
}

class Adapters : public Station {
 protected:
  /// Starts one of the reference adapters; where it listens. Again: killed by the system, as it were.
  std::string start(std::unique_ptr<RunningProgram>& program, const std::string& kind,
                    const std::vector<std::string>& options = {}) const {
    program.reset();
    const std::string path = folder_.path() / kind;
    std::vector<std::string> words{path};
    words.insert(words.end(), options.begin(), options.end());
    program = std::make_unique<RunningProgram>("longreach-reference-" + kind, words);
    EXPECT_TRUE(eventually([&] { return program->output().find("listening on") != std::string::npos; }));
    return "unix:" + path;
  }

  void start_both(const std::string& silence_s, const std::vector<std::string>& device_options) {
    device_address_ = start(device_, "device", device_options);
    robot_address_ = start(robot_, "robot", {"--wall", "0.02"});
    start_slave({"--adapter", robot_address_, "--set", "robot_file=robots/cartesian.txtpb", "--set",
                 "robot_adapter.silence_s=" + silence_s});
    start_master({"--adapter", device_address_, "--set", "device_adapter.silence_s=" + silence_s});
  }
  /// The last silence in the loop's own time: within 20 ms, but for what this machine was late.
  void expect_prompt_report(StationSide& side) {
    const std::uint64_t after_us = side.counter("adapter_silent_after_us");
    std::printf("told after %.1f ms of silence\n", 1e-3 * static_cast<double>(after_us));
    EXPECT_GE(after_us, 19'000u);
    EXPECT_LE(after_us, 20'000u + side.counter("lateness_max_us") + side.counter("busy_max_us"));
  }

  TemporaryFolder folder_;
  std::unique_ptr<RunningProgram> device_, robot_;
  std::string device_address_, robot_address_;
};

TEST_F(Adapters, ATouchIsFeltThroughBothAdapters) {
  start_both("0.5", {"--push", "0.05"});
  // At home, between two pushes, so that the next one leads to the wall.
  ASSERT_TRUE(eventually([this] {
    const auto s = master_.status();
    return s && s->link().rtt_known() && std::abs(s->hand_m(0)) < 1e-4;
  })) << outputs();
  ASSERT_TRUE(engaged()) << outputs();
  EXPECT_TRUE(eventually([this] {
    const auto s = master_.status();
    return s && s->in_contact() && s->force_n() > 1.0 && s->stiffness_n_per_m() > 800.0 &&
           s->stiffness_n_per_m() < 1200.0;
  })) << outputs();
  EXPECT_EQ(slave_.counter("limit_violations"), 0u);
  EXPECT_EQ(slave_.counter("adapter_malformed") + master_.counter("adapter_malformed"), 0u);
  EXPECT_GT(slave_.counter("adapter_accepted"), 1000u);
}

TEST_F(Adapters, AKilledAdapterOfTheDeviceIsAHold) {
  start_both("0.02", {});
  ASSERT_TRUE(engaged()) << outputs();
  device_->signal(SIGKILL);
  ASSERT_TRUE(eventually([this] { return master_.state() == "Fault" && slave_.state() == "Holding"; }))
      << outputs();
  EXPECT_EQ(master_.status()->cause(), "device fault");
  expect_prompt_report(master_);
  const std::string why = master_.engage();
  EXPECT_NE(why.find("stopped sending; if this persists, restart the adapter"), std::string::npos) << why;
  EXPECT_TRUE(says(*master_program_, "stopped sending; if this persists, restart the adapter")) << outputs();
  // Back again, it is not engaged by itself.
  start(device_, "device");
  ASSERT_TRUE(eventually([this] { return master_.counter("adapter_restarts") == 1; })) << outputs();
  EXPECT_EQ(master_.state(), "Fault");
  EXPECT_TRUE(engaged()) << outputs();
}

TEST_F(Adapters, KilledRobotAdapterIsFaultAndRobotResumesInPlace) {
  start_both("0.02", {});
  ASSERT_TRUE(engaged()) << outputs();
  robot_->signal(SIGKILL);
  ASSERT_TRUE(eventually([this] { return slave_.state() == "Fault" && master_.state() == "Holding"; }))
      << outputs();
  EXPECT_EQ(slave_.status()->cause(), "robot fault");
  expect_prompt_report(slave_);
  EXPECT_NE(slave_.status()->trouble().find("stopped sending; if this persists, restart the adapter"),
            std::string::npos);
  start(robot_, "robot");
  ASSERT_TRUE(eventually([this] { return slave_.counter("adapter_restarts") == 1; })) << outputs();
  EXPECT_EQ(slave_.state(), "Fault");
  EXPECT_TRUE(engaged()) << outputs();
}

TEST_F(Adapters, TheReferenceAdaptersKeepTheRules) {
  const std::string device = start(device_, "device"), robot = start(robot_, "robot");
  const auto passes = [](const std::vector<std::string>& options) {
    Tried tried;
    // The rate is that of the machine, too.
    for (int i = 0; i < 5 && tried.status != 0; ++i) tried = try_adapter(options);
    EXPECT_EQ(tried.status, 0) << tried.output;
    EXPECT_NE(tried.output.find("0 failures"), std::string::npos) << tried.output;
  };
  passes({"--device", device});
  passes({"--robot", robot, "--move", "0.01"});
}

TEST_F(Adapters, ABrokenAdapterIsToldWhatIsWrong) {
  struct Case {
    Flaw flaw;
    const char* reported;
    const char* advice;
  };
  const Case cases[] = {
      {Flaw::kNoWatchdog, "it does not react to 0.6 s without datagrams", "rule 4"},
      {Flaw::kMute, "it stops sending when it receives no datagrams", "rule 4"},
      {Flaw::kNoCount, "number 1 follows 1", "increase the sequence"},
      {Flaw::kNoEcho, "is 0 after", "echo the sequence number"},
      {Flaw::kNotFinite, "a value is not finite", "compare its layout with"},
      {Flaw::kShort, "191 bytes instead of 192", "compare its layout with"},
      {Flaw::kSlow, "99 % of the gaps", "500 to 4000 datagrams per second"},
      {Flaw::kTakesAnything, "it accepts a wrong magic", "rules 1 and 3"},
      {Flaw::kTakesOldNumbers, "it accepts an old sequence number", "rules 1 and 3"},
      {Flaw::kTakesNoRestart, "a restarted program is not accepted", "rule 3"},
      {Flaw::kNoWrench, "commanded to render 0.5 N along z, but force_n is 0 0 0",
       "generated wrench in force_n"},
      {Flaw::kFailed, "it reports a failure", "set kOk"},
      {Flaw::kTakesAnyone, "it responds to a program of another user", "getsockopt(SO_PEERCRED)"}};
  const auto found = [](const Case& c, const Tried& tried) {
    if (c.flaw == Flaw::kTakesAnyone && ::geteuid() != 0) return true;  // root alone can try that
    return tried.status == 1 && tried.output.find(c.reported) != std::string::npos &&
           tried.output.find(c.advice) != std::string::npos;
  };
  const auto check = [&](const Case& c) {
    Tried tried;
    // A machine that stood still may hide a flaw, or have more.
    for (int i = 0; i < 5 && !found(c, tried); ++i) {
      const BrokenAdapter broken(c.flaw);
      tried = try_adapter({"--device", broken.address()});
    }
    return tried;
  };
  constexpr std::size_t kAtOnce = 4;
  for (std::size_t first = 0; first < std::size(cases); first += kAtOnce) {
    std::vector<std::future<Tried>> checks;
    const std::size_t last = std::min(first + kAtOnce, std::size(cases));
    for (std::size_t i = first; i < last; ++i)
      checks.push_back(std::async(std::launch::async, check, cases[i]));
    for (std::size_t i = 0; i < checks.size(); ++i) {
      const Case& c = cases[first + i];
      const Tried tried = checks[i].get();
      EXPECT_TRUE(found(c, tried)) << c.reported << ", " << c.advice << "\n" << tried.output;
    }
  }
  EXPECT_EQ(try_adapter({}).status, 2);
}

TEST_F(Adapters, TheCheckSaysWhyThereIsNoConnection) {
  const std::string path = folder_.path() / "place";
  const auto expect = [&](const std::string& words) {
    for (const std::string kind : {"--device", "--robot"}) {
      const Tried tried = try_adapter({kind, "unix:" + path});
      EXPECT_EQ(tried.status, 1);
      EXPECT_NE(tried.output.find("cannot connect to the adapter: " + words), std::string::npos)
          << tried.output;
    }
  };
  expect("there is no such file");
  std::ofstream(path) << "text";
  expect("it is a file, not a socket");
  std::filesystem::remove(path);
  std::filesystem::create_directory(path);
  expect("it is a folder, not a socket");
}

TEST_F(Adapters, ASocketThatOthersMayUseIsReported) {
  const std::string address = start(device_, "device");
  ::chmod(address.substr(5).c_str(), 0777);
  const Tried tried = try_adapter({"--device", address});
  EXPECT_EQ(tried.status, 1);
  EXPECT_NE(tried.output.find("other users can connect to its socket"), std::string::npos) << tried.output;
}

TEST_F(Adapters, OnlyASocketOfThisMachineIsAnAdapter) {
  for (const std::string address : {"192.0.2.7:47101", "127.0.0.1:47101", "unix:here"}) {
    start_master({"--adapter", address});
    EXPECT_EQ(master_program_->wait(seconds(20)), 2);
    EXPECT_NE(master_program_->output().find("device_adapter.address = " + address +
                                             " is not an adapter address: write unix:/PATH"),
              std::string::npos)
        << outputs();
    start_slave({"--adapter", address});
    EXPECT_EQ(slave_program_->wait(seconds(20)), 2);
    EXPECT_EQ(try_adapter({"--robot", address}).status, 2);
  }
}

TEST_F(Adapters, NothingRealIsMovedByWhomRpcInClearLetsIn) {
  start_slave({"--insecure", "--adapter", "unix:/nowhere"});
  EXPECT_EQ(slave_program_->wait(seconds(20)), 2);
  EXPECT_NE(slave_program_->output().find("omit --insecure"), std::string::npos) << outputs();
  start_master({"--insecure", "--adapter", "unix:/nowhere"});
  EXPECT_EQ(master_program_->wait(seconds(20)), 2);
  EXPECT_NE(master_program_->output().find("omit --insecure"), std::string::npos) << outputs();
}

TEST_F(Adapters, ASecondProgramIsNotHeardWhileTheFirstHasTheAdapter) {
  start_both("0.5", {});
  ASSERT_TRUE(engaged()) << outputs();
  // However long the first is held up.
  slave_program_->signal(SIGSTOP);
  const Tried tried = try_adapter({"--robot", robot_address_, "--move", "0.1"});
  slave_program_->signal(SIGCONT);
  EXPECT_EQ(tried.status, 1);
  EXPECT_NE(tried.output.find("no datagram arrived within 2 s"), std::string::npos) << tried.output;
}

TEST_F(Adapters, WithoutItsAdapterASideSaysSoAndDoesNothing) {
  start_slave({"--adapter", "unix:/nowhere"});
  start_master({"--adapter", "unix:/nowhere", "--engage"});
  ASSERT_TRUE(eventually([this] { return slave_.state() == "Fault" && master_.state() == "Fault"; }))
      << outputs();
  EXPECT_TRUE(
      says(*slave_program_,
           "the adapter of the robot at unix:/nowhere does not respond: there is no such file; start the "
           "adapter"))
      << outputs();
  EXPECT_TRUE(says(*master_program_, "the adapter of the haptic device at unix:/nowhere does not respond"))
      << outputs();
}

// The black box: what a robot is sent, whatever the slave says of itself.
TEST_F(Adapters, ARobotIsSentMotionsOnlyWhileSomebodyIsEngaged) {
  RobotBox robot;
  const auto rests_for = [&](std::uint64_t datagrams) {
    const std::uint64_t live = robot.live(), end = robot.reported() + datagrams;
    return eventually([&] { return robot.reported() >= end; }) && robot.live() == live;
  };
  start_slave({"--adapter", robot.address(), "--set", "robot_file=robots/cartesian.txtpb", "--set",
               "robot_adapter.silence_s=0.5"});
  ASSERT_TRUE(eventually([this] { return slave_.state() == "Idle"; })) << outputs();
  EXPECT_TRUE(rests_for(300));
  start_master({"--operator", "none"});
  ASSERT_TRUE(eventually([this] { return slave_.state() == "Observing"; })) << outputs();
  // Somebody moves it by 0.1 m at least; there it stays.
  robot.push(0.1);
  ASSERT_TRUE(eventually([&] { return robot.joint(2) > 0.1; }));
  robot.push(0.0);
  EXPECT_TRUE(rests_for(500));
  EXPECT_EQ(robot.live(), 0u);
  const double at_m = robot.joint(2);
  ASSERT_GE(at_m, 0.1);
  ASSERT_TRUE(engaged()) << outputs();
  ASSERT_TRUE(eventually([&] { return robot.live() > 500; }));
  EXPECT_LT(std::abs(robot.joint(2) - at_m), 1e-3);
  EXPECT_LT(robot.first_step(), 1e-4);
  // Readings that leap: a fault, and not one more motion.
  robot.sensor_fault(0.3);
  ASSERT_TRUE(eventually([this] { return slave_.state() == "Fault"; })) << outputs();
  EXPECT_TRUE(rests_for(500));
  EXPECT_NE(slave_.status()->trouble().find("joint 3 of the robot jumped"), std::string::npos)
      << slave_.status()->trouble();
  robot.sensor_fault(0.0);
  EXPECT_TRUE(rests_for(500));
  EXPECT_LT(std::abs(robot.joint(2) - at_m), 1e-3);
  EXPECT_LT(robot.step(), 1e-3);
  EXPECT_TRUE(engaged()) << outputs();
}

/// Does what the check asks for, until it ends. Its exit status and what it said.
Tried pushed(SensorFlaw flaw) {
  RobotBox robot;
  robot.set_flaw(flaw);
  RunningProgram check("longreach", {"adapter", "check", "--push", "--robot", robot.address(), "--robot-file",
                                     "robots/cartesian.txtpb", "--patience", "2"});
  std::optional<int> status;
  while (!(status = check.wait(std::chrono::milliseconds(10)))) {
    const std::string said = check.output();
    const auto push = said.rfind("PUSH"), turn = said.rfind("TURN"), done = said.rfind("release the tool");
    const bool turns = turn != std::string::npos;
    const auto asked = turns ? turn : push;
    std::array<double, 3> force_n{}, moment_nm{};
    if (asked != std::string::npos && (done == std::string::npos || done < asked)) {
      const auto axis = said.find('+', asked);
      if (axis == std::string::npos || axis + 1 >= said.size()) continue;
      auto& felt = turns ? moment_nm : force_n;
      felt = {0.1, -0.1, 0.05};  // a hand is not straight
      for (double& x : felt) x *= turns ? 2.0 : 20.0;
      felt[static_cast<std::size_t>(said[axis + 1] - 'x')] = turns ? 2.0 : 20.0;
    }
    robot.push_tool(force_n, moment_nm);
  }
  return {*status, check.output()};
}

TEST_F(Adapters, APushSaysWhatIsWrongWithAForceSensor) {
  struct Case {
    SensorFlaw flaw;
    const char* reported;
    const char* advice;
  };
  const Case cases[] = {
      {SensorFlaw::kSign, "has the wrong sign", "the environment exerts on the tool"},
      {SensorFlaw::kBase, "is reported in the base frame", "into the tool frame"},
      {SensorFlaw::kExchanged, "the reported x, y, z are y, x, z of the tool", "in the order"},
      {SensorFlaw::kWeight, "is 15.0 0.0 0.0 N without contact", "sensing.tool"},
      {SensorFlaw::kDead, "does not respond to a push along y of the base", "a channel is dead"}};
  // A person each, all at once.
  auto uncorrupted = std::async(std::launch::async, pushed, SensorFlaw::kNone);
  std::vector<std::future<Tried>> persons;
  for (const Case& c : cases) persons.push_back(std::async(std::launch::async, pushed, c.flaw));
  for (const Case& c : cases) {
    const Tried tried = persons[static_cast<std::size_t>(&c - cases)].get();
    EXPECT_EQ(tried.status, 1) << tried.output;
    EXPECT_NE(tried.output.find(c.reported), std::string::npos) << c.reported << "\n" << tried.output;
    EXPECT_NE(tried.output.find(c.advice), std::string::npos) << c.advice << "\n" << tried.output;
  }
  const Tried right = uncorrupted.get();
  EXPECT_EQ(right.status, 0) << right.output;
  EXPECT_NE(right.output.find("0 warnings, 0 failures"), std::string::npos) << right.output;
  EXPECT_EQ(try_adapter({"--push", "--robot", "unix:/nowhere"}).status, 2);
}

}  // namespace
}  // namespace longreach::adapter_test
