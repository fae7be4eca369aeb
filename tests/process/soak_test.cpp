// Faults again and again: slow readers of streams, connections that say nothing, forged datagrams, a link
// that goes, a log on a full disk. Memory and descriptors stay where they were. LONGREACH_FULL: for an hour.
#include <grpcpp/grpcpp.h>
#include <sys/resource.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <vector>

#include "common/rpc/rpc_channel.hpp"
#include "deploy/lab/campaign_size.hpp"
#include "tests/process/load.hpp"
#include "tests/process/program_figures.hpp"
#include "tests/support/station.hpp"

namespace longreach::soak_test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// Streams of the status at its highest rate that nobody reads.
class UnreadStreams {
 public:
  UnreadStreams(RpcRole role, int port, int count)
      : stub_(proto::Control::NewStub(
            connect_rpc("127.0.0.1:" + std::to_string(port), role, test_site(RpcRole::kClient)))) {
    for (int i = 0; i < count; ++i) {
      contexts_.push_back(std::make_unique<grpc::ClientContext>());
      proto::WatchRequest request;
      request.set_rate_hz(60.0);
      streams_.push_back(stub_->Watch(contexts_.back().get(), request));
    }
  }
  ~UnreadStreams() {
    for (const auto& context : contexts_) context->TryCancel();
    proto::Status ignored;
    for (const auto& stream : streams_) {
      while (stream->Read(&ignored)) {
      }
      (void)stream->Finish();
    }
  }
  UnreadStreams(const UnreadStreams&) = delete;
  UnreadStreams& operator=(const UnreadStreams&) = delete;

 private:
  std::unique_ptr<proto::Control::Stub> stub_;
  std::vector<std::unique_ptr<grpc::ClientContext>> contexts_;
  std::vector<std::unique_ptr<grpc::ClientReader<proto::Status>>> streams_;
};

struct Held {
  double mb = 0.0;
  int descriptors = 0;
};

Held held_by(const RunningProgram& program) {
  return {resident_mb(program.pid()), descriptors(program.pid())};
}

class Soak : public Station {
 protected:
  void start() {
    rlimit limit{};
    ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &limit), 0);
    limit.rlim_cur = limit.rlim_max;
    ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &limit), 0);
    start_slave({"--core-dumps", "--log", "/dev/full"});
    start_master({"--core-dumps", "--operator", "none"});
    ASSERT_TRUE(engaged()) << outputs();
  }

  /// One of each fault, on both sides.
  void suffer() {
    for (const int port : {ports_.slave_rpc, ports_.master_rpc}) {
      const IdleConnections idle(port, 300);
      std::this_thread::sleep_for(milliseconds(300));
    }
    {
      const UnreadStreams slow(RpcRole::kSlave, ports_.slave_rpc, 4);
      const UnreadStreams too(RpcRole::kMaster, ports_.master_rpc, 4);
      std::this_thread::sleep_for(milliseconds(700));
    }
    (void)forge(ports_.link, 0x1234, 20'000.0, seconds(1));
    EXPECT_EQ(slave_.set_delay(0.2), "");
    EXPECT_EQ(slave_.set_delay(0.0), "");
    (void)slave_.set("no.such.field", "1");
    EXPECT_EQ(slave_.stop(), "") << outputs();
    EXPECT_TRUE(eventually([this] { return slave_.state() == "Stopped"; }, seconds(20)));
    EXPECT_TRUE(engaged()) << outputs();
  }

  /// Once the connections of the last fault are gone.
  void expect_back(const char* name, const RunningProgram& program, const Held& before) {
    EXPECT_TRUE(eventually([&] { return held_by(program).descriptors <= before.descriptors; }, seconds(30)))
        << name;
    const Held after = held_by(program);
    std::cout << name << ": " << before.mb << " MB and " << before.descriptors << " descriptors, " << after.mb
              << " MB and " << after.descriptors << " after\n";
    EXPECT_LE(after.mb, before.mb + 5.0) << name;
  }
};

TEST_F(Soak, FaultsTakeNoMemoryAndNoDescriptors) {
  start();
  if (HasFatalFailure()) return;
  for (int i = 0; i < 2; ++i) suffer();  // what is had once and kept
  const Held slave = held_by(*slave_program_), master = held_by(*master_program_);
  const auto end = std::chrono::steady_clock::now() + seconds(campaign(3600, 10));
  int rounds = 0;
  for (; !HasFailure() && std::chrono::steady_clock::now() < end; ++rounds) suffer();
  std::cout << rounds << " rounds\n";
  expect_back("slave", *slave_program_, slave);
  expect_back("master", *master_program_, master);
  EXPECT_GT(slave_.counter("log_lost"), 0u);
}

TEST_F(Soak, WhoDoesNotReadItsStreamDelaysNoStop) {
  start();
  if (HasFatalFailure()) return;
  const UnreadStreams slow(RpcRole::kSlave, ports_.slave_rpc, 32);
  BareLoops bare;
  std::this_thread::sleep_for(seconds(3));
  // A machine may be late once; a stop that queues behind a stream is late each time.
  std::chrono::duration<double> least = seconds(20);
  for (int i = 0; i < 3; ++i) {
    const auto began = std::chrono::steady_clock::now();
    EXPECT_EQ(slave_.stop(), "");
    least = std::min<std::chrono::duration<double>>(least, std::chrono::steady_clock::now() - began);
  }
  EXPECT_LT(least.count(), 0.2 + 10.0 * to_seconds(bare.end().lateness_max));
  EXPECT_TRUE(eventually([this] { return slave_.state() == "Stopped"; }, seconds(20)));
}

}  // namespace
}  // namespace longreach::soak_test
