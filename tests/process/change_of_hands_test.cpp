// Every change of who has the hand begins where the handle is: at the keyboard and through clients, in free space and
// against a wall, and after release, loss, stop and hold. Other operators: own_operators_test.cpp.
#include <array>
#include <memory>

#include "common/link/adapter_datagram.hpp"
#include "tests/process/device_box.hpp"
#include "tests/process/hand_client.hpp"
#include "tests/process/quiet_station.hpp"
#include "tests/process/terminal.hpp"

namespace longreach::change_of_hands_test {
namespace {

class ChangesOfHands : public QuietStation, public ::testing::WithParamInterface<bool> {
 protected:
  void expect_keys_move(const std::string& keys, double least_m) {
    bool typed = false;
    expect_moves(
        [&] {
          if (!std::exchange(typed, true)) terminal_.type(keys);
        },
        least_m);
  }

  const Terminal terminal_;
};

TEST_P(ChangesOfHands, OfKeyboardAndClientsMoveNothing) {
  const bool contact = GetParam();
  start_slave(place(contact));
  start_master({"--view", "plain", "--operator", "keyboard", "--mode", "position", "--set", "mapping.scale=1",
                "--set", "hand.grip=FIRM"},
               {terminal_.inner, -1, -1});
  ASSERT_TRUE(engaged()) << outputs();
  expect_keys_move(contact ? "WWWWWW" : "WWW", 0.01);
  const auto press_again = [&] {
    if (contact) press([this] { terminal_.type("w"); });
  };
  const auto still_moves = [&] {
    if (!contact) expect_keys_move("W", 5e-4);
    press_again();
  };
  press_again();
  std::unique_ptr<HandClient> page;
  const auto take = [&] { page = std::make_unique<HandClient>(ports_.master_rpc); };
  expect_quiet_engaged("a client takes the hand", take);
  if (!contact) {
    page->aim(0.01);
    ASSERT_TRUE(rests());
  }
  expect_quiet_engaged("keys while a client has the hand", [this] { terminal_.type("www"); });
  EXPECT_TRUE(says(*master_program_, "no effect, because another client has the handle")) << outputs();
  expect_quiet_engaged("the client releases the hand", [&] { page->release(); });
  still_moves();
  expect_quiet_engaged("a client takes the hand again", take);
  expect_quiet(
      "the client is lost", [&] { page->lose(); }, [this] { return held_now(); });
  expect_quiet_engaged("the keyboard engages", [this] { terminal_.type("e"); });
  still_moves();
  take();
  ASSERT_TRUE(rests());
  page->lose();
  ASSERT_TRUE(eventually([this] { return held_now(); }));
  HandClient other(ports_.master_rpc);
  expect_quiet_engaged("another client engages", [this] { EXPECT_EQ(master_.engage(), ""); });
  expect_quiet_engaged("it releases the hand", [&] { other.release(); });
  press_again();
  expect_quiet(
      "stop", [this] { terminal_.type("x"); }, [this] { return stopped_now(); });
  terminal_.type("WW");
  expect_quiet_engaged("keys while stopped, then engage", [this] { terminal_.type("e"); });
  print_worst(contact ? "contact" : "free");
}

INSTANTIATE_TEST_SUITE_P(Places, ChangesOfHands, ::testing::Bool(),
                         [](const auto& contact) { return std::string(contact.param ? "contact" : "free"); });

/// What arrives by accident: keys in a burst, arrow keys of the mouse wheel, chattering and held buttons.
class Accidents : public Station {
 protected:
  double scale() {
    const auto s = master_.status();
    return s ? s->scale() : NAN;
  }
};

TEST_F(Accidents, ABurstOfKeysMovesTheHandByFewSteps) {
  const Terminal terminal;
  start_slave({"--set", "scene_file=scenes/free.txtpb"});
  start_master(
      {"--view", "plain", "--operator", "keyboard", "--mode", "position", "--set", "mapping.scale=1"},
      {terminal.inner, -1, -1});
  ASSERT_TRUE(engaged()) << outputs();
  terminal.paste(std::string(60, 'w'));
  EXPECT_TRUE(
      says(*master_program_, "keys had no effect, because they arrived faster than a keyboard repeats"))
      << outputs();
  std::this_thread::sleep_for(std::chrono::seconds(1));
  EXPECT_GT(master_.status()->hand_m(0), 0.002);
  EXPECT_LE(master_.status()->hand_m(0),
            0.013);  // the steps of a poll that is late by 0.2 s, and a little more
}

TEST_F(Accidents, TheMouseWheelSendsNoKeysWhileTheViewRuns) {
  const Terminal terminal;
  start_slave();
  start_master({"--view", "auto", "--operator", "keyboard"}, {terminal.inner, terminal.inner, -1});
  std::string seen;
  const auto shows = [&](const std::string& words) {
    return eventually([&] {
      std::array<char, 4096> bytes{};
      pollfd waiting{terminal.outer, POLLIN, 0};
      while (::poll(&waiting, 1, 0) > 0) {
        const ssize_t n = ::read(terminal.outer, bytes.data(), bytes.size());
        if (n <= 0) break;
        seen.append(bytes.data(), static_cast<std::size_t>(n));
      }
      return seen.find(words) != std::string::npos;
    });
  };
  EXPECT_TRUE(shows("\x1b[?1007s\x1b[?1007l"));
  terminal.type("q");
  EXPECT_TRUE(shows("\x1b[?1007r")) << outputs();
}

TEST_F(Accidents, AButtonThatChattersCountsOnceAndAHeldOneWhenItIsPressedAgain) {
  using adapter::HandleDatagram;
  DeviceBox device(HandleDatagram::kMode);
  start_slave({"--set", "scene_file=scenes/free.txtpb"});
  start_master({"--adapter", device.address(), "--mode", "position", "--set", "mapping.scale=0.8"});
  ASSERT_TRUE(engaged()) << outputs();
  EXPECT_EQ(master_.status()->mode(), "position") << "the button was held at the start";
  const auto press = [&](std::uint32_t button) {
    for (const std::uint32_t now : {0U, button, 0U}) {
      device.press(now);
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
    }
  };
  press(HandleDatagram::kScaleDown);
  EXPECT_NEAR(scale(), 0.75, 1e-9);
  press(HandleDatagram::kScaleDown);
  EXPECT_NEAR(scale(), 0.7, 1e-9);
  press(HandleDatagram::kMode);
  EXPECT_EQ(master_.status()->mode(), "rate");
}

}  // namespace
}  // namespace longreach::change_of_hands_test
