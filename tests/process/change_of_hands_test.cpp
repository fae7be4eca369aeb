// Every change of who has the hand begins where the handle is: at the keyboard, through clients and with another master, in
// free space and against a wall, and after release, loss, stop and hold. Without input, neither the tool moves nor the force
// rises.
#include <grpcpp/grpcpp.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "common/link/adapter_datagram.hpp"
#include "common/rpc/rpc_channel.hpp"
#include "tests/process/device_box.hpp"
#include "tests/process/terminal.hpp"
#include "tests/support/station.hpp"

namespace longreach {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kMoved_m = 1e-3, kMore_n = 0.5;

/// A client that holds the handle, like the page: it sends a target 50 times a second until it releases the handle or its
/// connection breaks.
class HandClient {
 public:
  explicit HandClient(int port)
      : stub_(proto::Desk::NewStub(
            connect_rpc("127.0.0.1:" + std::to_string(port), RpcRole::kMaster, test_site(RpcRole::kClient)))),
        stream_(stub_->Hold(&context_, &outcome_)),
        thread_([this] { send(); }) {}
  ~HandClient() {
    if (thread_.joinable()) lose();
  }
  HandClient(const HandClient&) = delete;
  HandClient& operator=(const HandClient&) = delete;

  void aim(double x_m) { x_m_ = x_m; }
  void release() {
    end_ = true;
    thread_.join();
    proto::HandAim last;
    last.set_lets_go(true);
    stream_->Write(last);
    EXPECT_TRUE(stream_->Finish().ok());
  }
  void lose() {
    end_ = true;
    thread_.join();
    context_.TryCancel();
    (void)stream_->Finish();
  }

 private:
  void send() {
    while (!end_) {
      proto::HandAim aim;
      for (const double v : {x_m_.load(), 0.0, 0.0}) aim.add_position_m(v);
      if (!stream_->Write(aim)) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }

  std::unique_ptr<proto::Desk::Stub> stub_;
  grpc::ClientContext context_;
  proto::Outcome outcome_;
  std::unique_ptr<grpc::ClientWriter<proto::HandAim>> stream_;
  std::atomic<double> x_m_ = 0.0;
  std::atomic<bool> end_ = false;
  std::thread thread_;
};

class ChangesOfHands : public Station, public ::testing::WithParamInterface<bool> {
 protected:
  double tool_x() {
    const auto s = slave_.status();
    return s && s->tool_m_size() == 3 ? s->tool_m(0) : NAN;
  }
  double force_n() {
    const auto s = slave_.status();
    return s ? s->force_n() : NAN;
  }
  /// Waits until the tool has moved by less than 0.05 mm in 0.3 s.
  bool rests() {
    double last_m = tool_x();
    return eventually([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      const double now_m = tool_x();
      return std::abs(now_m - std::exchange(last_m, now_m)) < 5e-5;
    });
  }
  /// Performs a change that ends when `changed` returns true; the second that follows is watched.
  template <class Act>
  void expect_quiet(const std::string& what, Act act, const std::function<bool()>& changed) {
    SCOPED_TRACE(what);
    ASSERT_TRUE(rests()) << outputs();
    const double x_m = tool_x(), before_n = force_n();
    double moved_m = 0.0, most_n = 0.0;
    act();
    const auto watch = [&] {
      moved_m = std::max(moved_m, std::abs(tool_x() - x_m));
      most_n = std::max(most_n, force_n());
    };
    ASSERT_TRUE(eventually([&] {
      watch();
      return changed();
    })) << outputs();
    for (const auto end = Clock::now() + std::chrono::seconds(1); Clock::now() < end;) watch();
    EXPECT_LE(moved_m, kMoved_m) << outputs();
    EXPECT_LE(most_n, before_n + kMore_n);
    worst_m_ = std::max(worst_m_, moved_m);
    worst_n_ = std::max(worst_n_, most_n - before_n);
  }
  /// Types keys and waits until the tool has moved towards +x by at least `least_m`.
  void expect_keys_move(const std::string& keys, double least_m) {
    const double x_m = tool_x();
    terminal_.type(keys);
    EXPECT_TRUE(eventually([&] { return tool_x() - x_m > least_m; }, std::chrono::seconds(10))) << outputs();
    EXPECT_TRUE(rests());
  }
  bool engaged_now() { return master_.state() == "Engaged" && slave_.state() == "Engaged"; }

  const Terminal terminal_;
  double worst_m_ = 0.0, worst_n_ = 0.0;
};

// In contact the wall is pressed by about 3 N: less than the hold limit, which no hold reduces.
TEST_P(ChangesOfHands, OfKeyboardAndClientsMoveNothing) {
  const bool contact = GetParam();
  start_slave(
      {"--set", contact ? "scene.surface.wall.plane.point_m=0.03,0,0" : "scene_file=scenes/free.txtpb"});
  start_master({"--view", "plain", "--operator", "keyboard", "--mode", "position", "--set", "mapping.scale=1",
                "--set", "hand.grip=FIRM"},
               {terminal_.inner, -1, -1});
  ASSERT_TRUE(engaged()) << outputs();
  expect_keys_move(contact ? "WWWWW" : "WWW", 0.01);
  if (contact) {
    for (int i = 0; i < 100 && !(force_n() > 2.5); ++i) expect_keys_move("w", -1.0);
    ASSERT_GT(force_n(), 1.5) << outputs();  // the sensor has noise
  }
  const auto all = [this] { return engaged_now(); };
  auto page = std::make_unique<HandClient>(ports_.master_rpc);
  expect_quiet(
      "a client takes the hand", [] {}, all);
  if (!contact) {
    page->aim(0.01);
    ASSERT_TRUE(rests());
  }
  terminal_.type("www");
  expect_quiet(
      "keys while a client has the hand", [] {}, all);
  EXPECT_TRUE(says(*master_program_, "no effect, because another client has the handle")) << outputs();
  expect_quiet(
      "the client releases the hand", [&] { page->release(); }, all);
  if (!contact) expect_keys_move("W", 5e-4);

  page = std::make_unique<HandClient>(ports_.master_rpc);
  expect_quiet(
      "a client takes the hand again", [] {}, all);
  expect_quiet(
      "the client is lost", [&] { page->lose(); }, [this] { return slave_.state() == "Holding"; });
  expect_quiet(
      "the keyboard engages", [this] { terminal_.type("e"); }, all);
  if (!contact) expect_keys_move("W", 5e-4);

  page = std::make_unique<HandClient>(ports_.master_rpc);
  expect_quiet(
      "a client takes the hand", [] {}, all);
  page->lose();
  ASSERT_TRUE(eventually([this] { return slave_.state() == "Holding"; }));
  auto other = std::make_unique<HandClient>(ports_.master_rpc);
  other->aim(0.0);
  expect_quiet(
      "another client engages", [this] { EXPECT_EQ(master_.engage(), ""); }, all);
  expect_quiet(
      "it releases the hand", [&] { other->release(); }, all);
  expect_quiet(
      "stop", [this] { terminal_.type("x"); }, [this] { return slave_.state() == "Stopped"; });
  terminal_.type("WW");
  expect_quiet(
      "keys while stopped, then engage", [this] { terminal_.type("e"); }, all);
  std::printf("changes of hands, %s: at most %.2f mm, %.2f N more\n", contact ? "contact" : "free",
              1e3 * worst_m_, worst_n_);
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
}  // namespace longreach
