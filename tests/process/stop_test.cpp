// Stop under what clients can ask for at once: it waits behind nothing. Times are judged beside a thread that
// does nothing but sleep. LONGREACH_FULL: the sizes at which it once took 10.8 s.
#include <grpcpp/grpcpp.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <thread>

#include "common/rpc/rpc_channel.hpp"
#include "common/rpc/rpc_server.hpp"
#include "deploy/lab/campaign_size.hpp"
#include "tests/support/station.hpp"

namespace longreach::stop_test {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr double kTurns = 10.0;  // of threads and sockets on the way of an answer, each as late as a sleeper
constexpr double kStop_s = 0.2;
constexpr int kFollowers = 16;  // as many as the desk has places for

double seconds_since(Clock::time_point began) {
  return std::chrono::duration<double>(Clock::now() - began).count();
}

/// What a thread that only sleeps is late by, at the most.
class Sleeper {
 public:
  ~Sleeper() {
    ended_ = true;
    thread_.join();
  }
  [[nodiscard]] double late_s() const { return late_s_; }

 private:
  std::atomic<bool> ended_ = false;
  std::atomic<double> late_s_ = 0.0;
  std::thread thread_{[this] {
    while (!ended_) {
      const auto began = Clock::now();
      std::this_thread::sleep_for(milliseconds(1));
      late_s_ = std::max(late_s_.load(), seconds_since(began) - 1e-3);
    }
  }};
};

/// Clients that do one thing over and over until the end.
class Crowd {
 public:
  ~Crowd() {
    ended_ = true;
    for (std::thread& one : threads_) one.join();
  }
  template <class Act>
  void add(Act act) {
    threads_.emplace_back([this, act] {
      while (!ended_) {
        act();
        ++acts_;
      }
    });
  }
  [[nodiscard]] int acts() const { return acts_; }

 private:
  std::atomic<bool> ended_ = false;
  std::atomic<int> acts_ = 0;
  std::vector<std::thread> threads_;
};

class StopAtOnce : public Station {
 protected:
  /// Stops it again and again; the longest time an answer took, beyond what a sleeper is late by.
  void expect_stops(StationSide& side, const std::string& load) {
    const Sleeper sleeper;
    double longest_s = 0.0;
    for (int i = 0; i < 20; ++i) {
      const auto began = Clock::now();
      ASSERT_EQ(side.stop(), "") << load << outputs();
      longest_s = std::max(longest_s, seconds_since(began));
      std::this_thread::sleep_for(milliseconds(50));
    }
    std::cout << load << ": stop within " << 1e3 * longest_s << " ms, a sleeper late by "
              << 1e3 * sleeper.late_s() << " ms\n";
    EXPECT_LT(longest_s, kStop_s + kTurns * sleeper.late_s()) << load;
  }

  [[nodiscard]] StationSide another(RpcRole role) const {
    return {role, role == RpcRole::kSlave ? ports_.slave_rpc : ports_.master_rpc};
  }
};

/// A scene of many spheres far away.
std::string scene_of(int surfaces) {
  const std::string file =
      std::filesystem::temp_directory_path() / ("longreach_many_" + std::to_string(::getpid()) + ".txtpb");
  std::ofstream out(file);
  out << "material { name: 'm' }\n";
  for (int i = 0; i < surfaces; ++i)
    out << "surface { name: 's" << i << "' material: 'm' sphere { centre_m: [" << 100 + i << ", 0, 0] } }\n";
  return file;
}

TEST_F(StopAtOnce, WhileClientsSetThousandsOfFieldsOnALargeScene) {
  const std::string scene = scene_of(campaign(6000, 1500));
  start_slave({"--set", "scene_file=" + scene});
  ASSERT_TRUE(eventually([this] { return slave_.state() == "Idle"; })) << outputs();
  std::filesystem::remove(scene);
  Crowd crowd;
  for (const std::size_t fields : {3000U, 3000U, 256U, 256U}) {
    crowd.add([fields, side = std::make_shared<StationSide>(another(RpcRole::kSlave))] {
      (void)side->set(
          std::vector<std::pair<std::string, std::string>>(fields, {"estimator.forgetting", "0.995"}));
    });
  }
  crowd.add([side = std::make_shared<StationSide>(another(RpcRole::kSlave))] { (void)side->get(""); });
  ASSERT_TRUE(eventually([&] { return crowd.acts() > 5; })) << outputs();
  expect_stops(slave_, "3000 fields on a large scene");
}

TEST_F(StopAtOnce, WhileStreamsTakeAllThreads) {
  start_slave();
  start_master({"--operator", "none"});
  ASSERT_TRUE(eventually([this] { return master_.state() == "Observing"; })) << outputs();
  const auto channel = connect_rpc("127.0.0.1:" + std::to_string(ports_.master_rpc), RpcRole::kMaster,
                                   test_site(RpcRole::kClient));
  const auto control = proto::Control::NewStub(channel);
  const auto desk = proto::Desk::NewStub(channel);
  std::vector<std::unique_ptr<grpc::ClientContext>> contexts;
  std::vector<std::unique_ptr<grpc::ClientReader<proto::Status>>> watchers;
  std::vector<std::unique_ptr<grpc::ClientReader<proto::Frame>>> followers;
  std::vector<std::unique_ptr<grpc::ClientWriter<proto::HandAim>>> hands;
  proto::Outcome outcome;
  const auto context = [&contexts] {
    return contexts.emplace_back(std::make_unique<grpc::ClientContext>()).get();
  };
  for (int i = 0; i < kWatchersMax; ++i) watchers.push_back(control->Watch(context(), {}));
  for (int i = 0; i < kFollowers; ++i) followers.push_back(desk->Follow(context(), {}));
  for (int i = 0; i < campaign(110, 20); ++i) {
    hands.push_back(desk->Hold(context(), &outcome));
    proto::HandAim aim;
    for (int k = 0; k < 3; ++k) aim.add_position_m(0.0);
    hands.back()->Write(aim);
    std::this_thread::sleep_for(milliseconds(350));  // then the next one may take the handle
  }
  expect_stops(master_, std::to_string(contexts.size()) + " streams");
  for (const auto& one : contexts) one->TryCancel();
  for (const auto& one : watchers) (void)one->Finish();
  for (const auto& one : followers) (void)one->Finish();
  for (const auto& one : hands) (void)one->Finish();
}

}  // namespace
}  // namespace longreach::stop_test
