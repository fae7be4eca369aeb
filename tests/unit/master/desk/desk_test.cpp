// The desk over RPC, in clear on loopback: pictures out, one hand in.
#include "master/desk/desk.hpp"

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <thread>
#include <vector>

#include "master/desk/desk_frame.hpp"

namespace longreach::desk_test {
namespace {

struct Desk {
  Desk() {
    grpc::ServerBuilder builder;
    int port = 0;
    builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port);
    builder.RegisterService(&service);
    server = builder.BuildAndStart();
    stub = proto::Desk::NewStub(
        grpc::CreateChannel("127.0.0.1:" + std::to_string(port), grpc::InsecureChannelCredentials()));
  }
  ~Desk() { server->Shutdown(std::chrono::system_clock::now()); }

  RemoteAim newest() {
    const std::lock_guard lock(mutex);
    return aims.empty() ? RemoteAim{} : aims.back();
  }
  bool eventually(const std::function<bool(const RemoteAim&)>& is_so) {
    for (int i = 0; i < 600; ++i) {
      if (is_so(newest())) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
  }

  std::mutex mutex;
  std::vector<RemoteAim> aims;
  ConsoleSnapshot shown;
  DeskService service{{.translation_m = 0.075, .rotation_rad = 0.8},
                      [this] { return shown; },
                      [this](const RemoteAim& aim) {
                        const std::lock_guard lock(mutex);
                        aims.push_back(aim);
                      }};
  std::unique_ptr<grpc::Server> server;
  std::unique_ptr<proto::Desk::Stub> stub;
};

struct Hand {
  explicit Hand(Desk& desk) : stream(desk.stub->Hold(&context, &outcome)) {}

  grpc::ClientContext context;
  proto::Outcome outcome;
  std::unique_ptr<grpc::ClientWriter<proto::HandAim>> stream;
};

proto::HandAim last_word() {
  proto::HandAim aim;
  aim.set_lets_go(true);
  return aim;
}

proto::HandAim aim_at(double x, double y, double z) {
  proto::HandAim aim;
  for (const double v : {x, y, z}) aim.add_position_m(v);
  return aim;
}

TEST(Desk, RealDeviceIsTakenByNoClient) {
  Desk desk;
  DeskService real{{}, [] { return ConsoleSnapshot{}; }, {}};
  grpc::ServerBuilder builder;
  int port = 0;
  builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port);
  builder.RegisterService(&real);
  const auto server = builder.BuildAndStart();
  desk.stub = proto::Desk::NewStub(
      grpc::CreateChannel("127.0.0.1:" + std::to_string(port), grpc::InsecureChannelCredentials()));
  Hand hand(desk);
  const grpc::Status status = hand.stream->Finish();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::FAILED_PRECONDITION);
  EXPECT_EQ(status.error_message(), "the handle is a real device, so no client can take control of it");
}

// Hands that take the handle one after the other and say nothing more: each would keep a thread of the
// server.
TEST(Desk, SilentHandsKeepNoMoreThanSomeThreads) {
  Desk desk;
  std::vector<std::unique_ptr<Hand>> hands;
  std::vector<std::thread> waiting;
  std::atomic<int> ended = 0;
  constexpr int kHands = kHandsMax + 4;
  for (int i = 0; i < kHands; ++i) {
    hands.push_back(std::make_unique<Hand>(desk));
    Hand& hand = *hands.back();
    ASSERT_TRUE(hand.stream->Write(aim_at(0.001 * i, 0, 0)));
    ASSERT_TRUE(desk.eventually([&](const RemoteAim& aim) { return aim.position_m.x() == 0.001 * i; })) << i;
    std::this_thread::sleep_for(std::chrono::milliseconds(350));  // silent for long enough
    waiting.emplace_back([&] {
      (void)hand.stream->Finish();  // when the server ends it
      ++ended;
    });
  }
  EXPECT_TRUE(desk.eventually([&](const RemoteAim&) { return ended >= kHands - kHandsMax; })) << ended;
  EXPECT_LT(ended, kHands) << "the last one is there";
  for (const auto& hand : hands) hand->context.TryCancel();
  for (std::thread& one : waiting) one.join();
}

TEST(Desk, ShowsFramesUntilTheFollowerLeaves) {
  Desk desk;
  desk.shown.view.scale = 0.35;
  grpc::ClientContext context;
  const auto stream = desk.stub->Follow(&context, {});
  proto::Frame frame;
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(stream->Read(&frame));
    EXPECT_EQ(frame.view().scale(), 0.35);
    EXPECT_EQ(frame.workspace_m(), 0.075);
  }
  context.TryCancel();
  EXPECT_EQ(stream->Finish().error_code(), grpc::StatusCode::CANCELLED);
}

TEST(Desk, PassesAimsOnWithinReachAndTheEndInOrder) {
  Desk desk;
  Hand hand(desk);
  ASSERT_TRUE(hand.stream->Write(aim_at(3.0, 0.0, 4.0)));
  EXPECT_TRUE(desk.eventually([](const RemoteAim& aim) { return aim.holds; }));
  EXPECT_NEAR(desk.newest().position_m.x(), 0.045, 1e-12);
  EXPECT_NEAR(desk.newest().position_m.z(), 0.06, 1e-12);
  hand.stream->WriteLast(last_word(), {});
  EXPECT_TRUE(hand.stream->Finish().ok());
  EXPECT_FALSE(desk.newest().holds);
}

TEST(Desk, StreamThatEndsWithoutReleaseTimesOut) {
  for (const bool broken : {false, true}) {
    Desk desk;
    {
      Hand hand(desk);
      ASSERT_TRUE(hand.stream->Write(aim_at(0.01, 0.0, 0.0)));
      ASSERT_TRUE(desk.eventually([](const RemoteAim& aim) { return aim.holds; }));
      if (broken) hand.context.TryCancel();
      if (!broken) hand.stream->WritesDone();
      EXPECT_EQ(hand.stream->Finish().error_code(), grpc::StatusCode::CANCELLED);
    }
    EXPECT_TRUE(desk.newest().holds) << broken;
    // And the next hand is let on the handle when that one has been silent for long enough.
    EXPECT_TRUE(desk.eventually([&desk](const RemoteAim&) {
      Hand next(desk);
      next.stream->Write(aim_at(0.0, 0.02, 0.0));
      next.stream->WriteLast(last_word(), {});
      return next.stream->Finish().ok();
    }));
  }
}

TEST(Desk, RefusesASecondHandAndImpossibleAims) {
  Desk desk;
  Hand first(desk);
  std::jthread kept([&first](const std::stop_token& end) {
    while (!end.stop_requested() && first.stream->Write(aim_at(0.01, 0.0, 0.0)))
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
  });
  ASSERT_TRUE(desk.eventually([](const RemoteAim& aim) { return aim.holds; }));
  const grpc::Status refused = Hand(desk).stream->Finish();
  EXPECT_EQ(refused.error_code(), grpc::StatusCode::FAILED_PRECONDITION);
  EXPECT_NE(refused.error_message().find("another client"), std::string::npos);
  kept.request_stop();
  kept.join();
  first.stream->Write(aim_at(std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0));
  EXPECT_EQ(first.stream->Finish().error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_TRUE(desk.newest().position_m.allFinite());
}

TEST(DeskFrame, SaysWhatTheConsoleSays) {
  ConsoleSnapshot s;
  s.view.far_known = true;
  s.view.state = SafetyState::kEngaged;
  s.view.far_state = SafetyState::kEngaged;
  s.view.mode = MotionMode::kRate;
  s.view.goal_m = {0.1, 0.2, 0.3};
  s.view.far.clamps.workspace = true;
  s.view.far.joint_rad = {1, 2, 3, 4, 5, 6};
  s.view.far_age_s = 0.2;
  s.link.rtt_s = 0.6;
  s.shown = {
      Situation::kAtLimit, "the robot cannot move further", {"robot: the goal is outside the workspace"}};
  const proto::Frame frame = to_frame(s, 0.05);
  EXPECT_EQ(frame.state(), "Engaged");
  EXPECT_EQ(frame.situation(), "at a limit");
  EXPECT_DOUBLE_EQ(frame.far_age_s(), 0.5);
  EXPECT_EQ(frame.view().mode(), recording::RATE);
  EXPECT_EQ(frame.happening(), "the robot cannot move further");
  ASSERT_EQ(frame.clamped_size(), 1);
  EXPECT_EQ(frame.clamped(0), "robot: the goal is outside the workspace");
  EXPECT_EQ(frame.view().goal_m().z(), 0.3);
  EXPECT_EQ(frame.view().far().joint_rad().joint6(), 6.0);
  EXPECT_TRUE(frame.view().far().clamps().workspace());
  s.view.far_known = false;
  EXPECT_FALSE(to_frame(s, 0.05).view().far_known());
}

}  // namespace
}  // namespace longreach::desk_test
