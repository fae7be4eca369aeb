// Changes of hands with the other operators that a master may have: a SpaceMouse, a script, a haptic device behind an
// adapter, and another master that takes control of the robot; in free space and against a wall. Keyboard:
// change_of_hands_test.cpp.
#include <array>
#include <csignal>
#include <memory>

#include "tests/process/device_box.hpp"
#include "tests/process/hand_client.hpp"
#include "tests/process/quiet_station.hpp"
#include "tests/process/terminal.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/master/input/fake_daemon.hpp"

namespace longreach::own_operators_test {
namespace {

class OwnOperators : public QuietStation, public ::testing::WithParamInterface<bool> {
 protected:
  void start(std::vector<std::string> master, const Streams& streams = {}) {
    // The script begins in rate mode, in which a tool whose handle is at home would ease its force.
    master.insert(master.end(), {"--mode", "position", "--set", "mapping.scale=1", "--set", "hand.grip=FIRM",
                                 "--set", "rendering.rate_force_ratio=0"});
    start_slave(place(contact_));
    start_master(master, streams);
    ASSERT_TRUE(engaged()) << outputs();
  }
  void expect_quiet_holding(const std::string& what, const std::function<void()>& act) {
    expect_quiet(what, act, [this] { return held_now(); });
  }
  void expect_quiet_stopped(const std::string& what, const std::function<void()>& act) {
    expect_quiet(what, act, [this] { return stopped_now(); });
  }
  void engage_by_client() { EXPECT_EQ(master_.engage(), ""); }
  void print(const std::string& what) const { print_worst(what + (contact_ ? ", contact" : ", free")); }

  const bool contact_ = GetParam();
};

/// The puck of a SpaceMouse, which is pushed along x.
struct Puck {
  static constexpr int kFull = 350, kLightly = 60, kEngage = 0, kStop = 1;

  void push(int deflection) { daemon.motion({0, 0, -deflection, 0, 0, 0}); }
  /// Releases the puck for several polls.
  void centre() {
    push(0);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  void press_button(int button) {
    daemon.button(button, true);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    daemon.button(button, false);
  }

  FakeDaemon daemon;
};

TEST_P(OwnOperators, SpaceMouseAndClientsMoveNothing) {
  const TemporaryFolder folder;
  const std::string path = folder.path() / "daemon";
  ::setenv("SPNAV_SOCKET", path.c_str(), 1);
  Puck puck{FakeDaemon(path)};
  start({"--operator", "spacemouse"});
  ::unsetenv("SPNAV_SOCKET");
  const auto pushes = [&](int deflection, double least_m) {
    puck.centre();
    expect_moves([&] { puck.push(deflection); }, least_m);
    puck.centre();
  };
  const auto press_again = [&] {
    if (!contact_) return;
    press([&] {
      puck.push(Puck::kLightly);
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
      puck.centre();
    });
  };
  const auto still_moves = [&] {
    if (!contact_) pushes(Puck::kFull, 2e-3);
    puck.centre();
    press_again();
  };
  pushes(Puck::kFull, 0.02);
  press_again();
  std::unique_ptr<HandClient> client;
  const auto take = [&] { client = std::make_unique<HandClient>(ports_.master_rpc); };
  expect_quiet_engaged("a client takes the hand", take);
  expect_quiet_engaged("the client releases the hand to a puck that is pushed", [&] {
    puck.push(Puck::kFull);
    client->release();
    puck.push(Puck::kFull);
  });
  still_moves();
  expect_quiet_engaged("a client takes the hand again", take);
  expect_quiet_holding("the client is lost", [&] { client->lose(); });
  expect_quiet_engaged("the SpaceMouse engages", [&] { puck.press_button(Puck::kEngage); });
  still_moves();
  expect_quiet_holding("the SpaceMouse is unplugged", [&] { puck.daemon.unplugged(); });
  puck.daemon.plugged_in();
  puck.push(Puck::kFull);
  EXPECT_TRUE(eventually([this] {
    return master_.engage().find("the puck is not centred") != std::string::npos;
  })) << outputs();
  expect_quiet_engaged("it is centred and engages", [&] {
    puck.centre();
    EXPECT_TRUE(eventually([this] { return master_.engage().empty(); })) << outputs();
  });
  still_moves();
  expect_quiet_stopped("stop", [&] { puck.press_button(Puck::kStop); });
  expect_quiet_engaged("it engages after the stop", [&] { puck.press_button(Puck::kEngage); });
  print("SpaceMouse");
}

// The script approaches at 10 um/s, and reacts to the contact only after 2 s. The released handle stays where it is.
TEST_P(OwnOperators, ScriptAndClientsMoveNothing) {
  start({"--operator", "script", "--set", "operator.rate_distance_m=0", "--set",
         "operator.approach_speed_m_per_s=1e-5", "--set", "operator.reaction_s=2", "--set",
         "device.behaviour.idle=STAY"});
  std::unique_ptr<HandClient> client;
  const auto take = [&] { client = std::make_unique<HandClient>(ports_.master_rpc); };
  // The client moves the hand to the wall, or by 20 mm.
  const auto moves = [&](double m) {
    double aim_m = m;
    client->aim(aim_m);
    ASSERT_TRUE(rests());
    if (contact_) press([&] { client->aim(aim_m += 1e-3); });
  };
  expect_quiet_engaged("a client takes the hand from the script", take);
  moves(0.025);
  expect_quiet_engaged("the client returns the hand, which waits", [&] { client->release(); });
  expect_quiet_engaged("a client takes the waiting hand", take);
  moves(0.0);
  expect_quiet_holding("the client is lost", [&] { client->lose(); });
  expect_quiet_engaged("the script is engaged where the hand was lost", [this] { engage_by_client(); });
  expect_quiet_stopped("stop", [this] { EXPECT_EQ(master_.stop(), ""); });
  expect_quiet_engaged("the script is engaged after the stop", [this] { engage_by_client(); });
  print("script");
}

// Clients cannot take a real device.
TEST_P(OwnOperators, DeviceBehindAnAdapterMovesNothing) {
  auto device = std::make_unique<DeviceBox>();
  start({"--adapter", device->address()});
  device->move_to(0.02);
  expect_moves([] {}, 0.015);
  double at_m = contact_ ? 0.028 : 0.02;
  const auto deeper = [&] { device->move_to(at_m += 5e-4); };
  if (contact_) press(deeper);
  HandClient client(ports_.master_rpc);
  expect_quiet_engaged("a client asks for the hand", [&] { client.aim(0.03); });
  EXPECT_EQ(client.refusal(), "the handle is a real device, so no client can take control of it");
  expect_quiet_holding("the device is silent", [&] { device->mute(true); });
  device->move_to(-0.01);
  ASSERT_TRUE(eventually([&] { return device->at_m() <= -0.01; }));
  expect_quiet(
      "it sends again from another place", [&] { device->mute(false); },
      [this] { return held_now() && master_.counter("adapter_restarts") + 1 > 0; });
  expect_quiet_engaged("it is engaged there", [this] {
    EXPECT_TRUE(eventually([this] { return master_.engage().empty(); })) << outputs();
  });
  if (!contact_) {
    device->move_to(0.0);
    expect_moves([] {}, 5e-3);
  }
  expect_quiet_stopped("stop", [this] { EXPECT_EQ(master_.stop(), ""); });
  const double moved_m = device->at_m() + 0.02;
  device->move_to(moved_m);
  ASSERT_TRUE(eventually([&] { return device->at_m() >= moved_m; }));
  expect_quiet_engaged("it is engaged after the stop", [this] { engage_by_client(); });
  print("device");
}

class TwoMasters : public OwnOperators {
 protected:
  /// Starts another master, which takes control of the robot.
  void start_second() {
    const std::vector<std::string> words{
        "--set",      "link.slave=" + link_address(),
        "--set",      "link.slave_rpc=127.0.0.1:" + std::to_string(ports_.slave_rpc),
        "--set",      "link.listen=127.0.0.1:0",
        "--set",      "rpc.listen=127.0.0.1:" + std::to_string(second_ports_.master_rpc),
        "--set",      "mapping.scale=1",
        "--set",      "hand.grip=FIRM",
        "--view",     "none",
        "--operator", "keyboard",
        "--mode",     "position",
        "--take"};
    program_ = std::make_unique<RunningProgram>("longreach-master", words, Streams{keys_[1].inner, -1, -1});
  }
  bool engaged_as(int master) {
    return slave_.state() == "Engaged" && (master_.state() == "Engaged") == (master == 0) &&
           (master == 0 || second_.state() == "Engaged");
  }
  void expect_quiet_engaged_as(int master, const std::string& what) {
    const auto engages = [&, master] {
      keys_[static_cast<std::size_t>(master)].type("e");
      return engaged_as(master);
    };
    expect_quiet(
        what, [&] { EXPECT_TRUE(eventually(engages)) << outputs(); },
        [&, master] { return engaged_as(master); });
  }
  /// Moves the tool to the wall, or deeper, or moves it in free space.
  void move_as(int master, const std::string& keys) {
    const Terminal& terminal = keys_[static_cast<std::size_t>(master)];
    if (contact_) return press([&] { terminal.type("w"); });
    bool typed = false;
    expect_moves(
        [&] {
          if (!std::exchange(typed, true)) terminal.type(keys);
        },
        5e-4);
  }

  const std::array<Terminal, 2> keys_;
  const Ports second_ports_ = free_ports();
  StationSide second_{RpcRole::kMaster, second_ports_.master_rpc};
  std::unique_ptr<RunningProgram> program_;
};

// Both masters are operated from keyboards. The second one takes control, is stopped, returns control, takes it again and
// is killed.
TEST_P(TwoMasters, TakingControlMovesNothing) {
  start({"--operator", "keyboard"}, {keys_[0].inner, -1, -1});
  keys_[0].type(contact_ ? "WWWWWW" : "WW");
  ASSERT_TRUE(rests());
  move_as(0, "W");
  expect_quiet_holding("another master takes control", [&] { start_second(); });
  keys_[0].type("WWWe");
  expect_quiet_engaged_as(1, "it engages");
  keys_[0].type("WWe");
  move_as(1, "W");
  expect_quiet_stopped("it stops", [&] { keys_[1].type("x"); });
  expect_quiet_engaged_as(1, "it engages again");
  expect_quiet_holding("it ends", [&] { program_->signal(SIGTERM); });
  expect_quiet_engaged_as(0, "the first master engages");
  move_as(0, "W");
  program_->wait(std::chrono::seconds(20));
  expect_quiet_holding("another master takes control again", [&] { start_second(); });
  expect_quiet_engaged_as(1, "it engages");
  move_as(1, "W");
  expect_quiet_holding("it is lost", [&] { program_->signal(SIGKILL); });
  expect_quiet_engaged_as(0, "the first master engages after the loss");
  print("another master");
}

std::string place_name(const ::testing::TestParamInfo<bool>& contact) {
  return contact.param ? "contact" : "free";
}

INSTANTIATE_TEST_SUITE_P(Places, OwnOperators, ::testing::Bool(), place_name);
INSTANTIATE_TEST_SUITE_P(Places, TwoMasters, ::testing::Bool(), place_name);

}  // namespace
}  // namespace longreach::own_operators_test
