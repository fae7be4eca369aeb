// The RPC server seen through a plain gRPC client on loopback.

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>
#include <vector>

#include "common/rpc/rpc_server.hpp"
#include "proto/control.grpc.pb.h"
#include "tests/unit/common/rpc/control_fake_backend.hpp"

namespace longreach::control_rpc_test {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kAnyPort = "127.0.0.1:0";

struct Served {
  FakeBackend side{"slave"};
  RpcServer server{kAnyPort, side, "slave"};
  std::unique_ptr<proto::Control::Stub> stub =
      proto::Control::NewStub(grpc::CreateChannel(server.address(), grpc::InsecureChannelCredentials()));
};

/// Limits every call, so that a defect fails instead of hanging.
struct Limited {
  Limited() { context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(30)); }
  grpc::ClientContext* get() { return &context; }
  grpc::ClientContext context;
};

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

proto::Action setting(const std::string& value) {
  proto::Action action;
  proto::Assignment& assignment = *action.mutable_set()->add_assignment();
  assignment.set_path("estimator.forgetting");
  assignment.set_value(value);
  return action;
}

proto::Action engaging() {
  proto::Action action;
  action.mutable_engage();
  return action;
}

/// Each action of the schema once.
std::vector<proto::Action> actions() {
  std::vector<proto::Action> all(8);
  all[0].set_mode(proto::RATE);
  all[1].set_scale(0.75);
  all[2] = engaging();
  all[3] = setting("0.995");
  all[4].mutable_link()->mutable_impairment()->set_delay_s(0.65);
  all[5].mutable_start_recording()->set_name("drill");
  all[6].mutable_stop_recording();
  all[7].set_kv_per_s(2.5);
  return all;
}

TEST(RpcServer, CarriesEveryCallToItsBackend) {
  EXPECT_EQ(actions().size(), static_cast<std::size_t>(proto::Action::descriptor()->field_count()));
  Served served;
  proto::Outcome outcome;
  proto::Status status;
  EXPECT_TRUE(served.stub->GetStatus(Limited().get(), {}, &status).ok());
  EXPECT_EQ(status.side(), "slave");
  EXPECT_EQ(status.state(), "Engaged");

  for (const proto::Action& action : actions())
    EXPECT_TRUE(served.stub->Do(Limited().get(), action, &outcome).ok()) << action.ShortDebugString();
  EXPECT_TRUE(served.stub->Stop(Limited().get(), {}, &outcome).ok());
  EXPECT_EQ(served.side.calls(),
            (std::vector<std::string>{"mode RATE", "scale", "engage", "set_config", "set_link",
                                      "start_recording drill", "stop_recording", "kv_per_s", "stop"}));

  proto::GetConfigRequest get;
  get.set_path("estimator.forgetting");
  proto::GetConfigResponse config;
  EXPECT_TRUE(served.stub->GetConfig(Limited().get(), get, &config).ok());
  EXPECT_EQ(config.text(), "0.995");
  proto::Impairment link;
  EXPECT_TRUE(served.stub->GetLink(Limited().get(), {}, &link).ok());
  EXPECT_EQ(link.delay_s(), 0.65);
}

TEST(RpcServer, TellsEachKindOfRefusalByItsCodeAndWhoRefused) {
  const std::vector<std::pair<Refusal::Kind, grpc::StatusCode>> kinds{
      {Refusal::Kind::kInvalid, grpc::StatusCode::INVALID_ARGUMENT},
      {Refusal::Kind::kPrecondition, grpc::StatusCode::FAILED_PRECONDITION},
      {Refusal::Kind::kUnavailable, grpc::StatusCode::UNAVAILABLE}};
  Served served;
  for (const auto& [kind, code] : kinds) {
    served.side.refuse(Refusal{kind, "no, because 5 N > 3 N"});
    const auto expect_refused = [&](auto method, const auto& request) {
      Limited limited;
      proto::Outcome outcome;
      const grpc::Status status = (served.stub.get()->*method)(&limited.context, request, &outcome);
      EXPECT_EQ(status.error_code(), code);
      EXPECT_EQ(status.error_message(), "no, because 5 N > 3 N");
      EXPECT_EQ(limited.context.GetServerTrailingMetadata().count(std::string(kRefusedBy)), 1U);
    };
    expect_refused(&proto::Control::Stub::Stop, proto::StopRequest());
    for (const proto::Action& action : actions()) expect_refused(&proto::Control::Stub::Do, action);
  }
}

TEST(RpcServer, ALongRefusalArrivesCutAtAWholeCharacter) {
  Served served;
  std::string message;
  while (message.size() < 20'000) message += "\u2264";  // three bytes each
  served.side.refuse(Refusal{Refusal::Kind::kPrecondition, message});
  proto::Outcome outcome;
  const grpc::Status status = served.stub->Do(Limited().get(), engaging(), &outcome);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::FAILED_PRECONDITION);
  EXPECT_TRUE(status.error_message().starts_with("\u2264\u2264"));
  EXPECT_TRUE(status.error_message().ends_with("\u2264..."));
}

TEST(RpcServer, RefusesAnOversizedRequestWithoutTroublingTheBackend) {
  Served served;
  const proto::Action set = setting(std::string(2U << 20U, '1'));
  proto::Outcome outcome;
  EXPECT_EQ(served.stub->Do(Limited().get(), set, &outcome).error_code(),
            grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_TRUE(served.side.calls().empty());
  EXPECT_TRUE(served.stub->Stop(Limited().get(), {}, &outcome).ok());
}

TEST(RpcServer, PacesAWatcherAtItsRateWithinTheLimits) {
  Served served;
  struct Case {
    double rate_hz;
    int count;
    double least_s;  // (count - 1) periods of the rate that is granted, with room
  };
  for (const Case& c : {Case{20.0, 11, 0.4}, Case{1e9, 31, 0.4}, Case{60.0, 31, 0.4}}) {
    Limited limited;
    proto::WatchRequest request;
    request.set_rate_hz(c.rate_hz);
    const auto start = Clock::now();
    const auto reader = served.stub->Watch(&limited.context, request);
    proto::Status status;
    for (int i = 0; i < c.count; ++i) ASSERT_TRUE(reader->Read(&status)) << c.rate_hz << " Hz, " << i;
    EXPECT_GT(seconds_since(start), c.least_s) << c.rate_hz;
    EXPECT_LT(seconds_since(start), 15.0) << c.rate_hz;
    limited.context.TryCancel();
    while (reader->Read(&status)) {
    }
    reader->Finish();
  }
}

TEST(RpcServer, AWatcherWithAnImpossibleRateGetsTheSlowestOne) {
  for (const double rate_hz : {0.0, -5.0, 1e-300, std::nan("")}) {
    Served served;
    Limited limited;
    proto::WatchRequest request;
    request.set_rate_hz(rate_hz);
    const auto reader = served.stub->Watch(&limited.context, request);
    proto::Status status;
    EXPECT_TRUE(reader->Read(&status)) << rate_hz;  // the first comes at once
    const auto start = Clock::now();
    served.server.stop();  // long before the second
    EXPECT_FALSE(reader->Read(&status)) << rate_hz;
    reader->Finish();
    EXPECT_LT(seconds_since(start), 5.0);
  }
}

TEST(RpcServer, StopsAtOnceWithFiftyWatchers) {
  Served served;
  std::vector<std::thread> watchers;
  std::atomic<int> watching = 0;
  std::atomic<int> ended = 0;
  for (int i = 0; i < 50; ++i) {
    watchers.emplace_back([&] {
      Limited limited;
      proto::WatchRequest request;
      request.set_rate_hz(10.0);
      const auto reader = served.stub->Watch(&limited.context, request);
      proto::Status status;
      if (reader->Read(&status)) ++watching;
      while (reader->Read(&status)) {
      }
      if (!reader->Finish().ok()) ++ended;
    });
  }
  for (int i = 0; i < 2000 && watching < 50; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(watching, 50);
  const auto start = Clock::now();
  served.server.stop();
  EXPECT_LT(seconds_since(start), 5.0);
  for (std::thread& watcher : watchers) watcher.join();
  EXPECT_EQ(ended, 50);
}

TEST(RpcServer, LimitsWatchersAndReusesFreedSlots) {
  Served served;
  struct Watcher {
    Limited limited;
    std::unique_ptr<grpc::ClientReader<proto::Status>> reader;
  };
  std::vector<std::unique_ptr<Watcher>> watchers;
  proto::Status status;
  const auto watch = [&] {
    auto watcher = std::make_unique<Watcher>();
    watcher->reader = served.stub->Watch(&watcher->limited.context, {});
    return watcher;
  };
  for (int i = 0; i < kWatchersMax; ++i) {
    watchers.push_back(watch());
    ASSERT_TRUE(watchers.back()->reader->Read(&status)) << i;
  }
  const auto one_too_many = watch();
  EXPECT_FALSE(one_too_many->reader->Read(&status));
  EXPECT_EQ(one_too_many->reader->Finish().error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  // The commands that matter still come through.
  proto::Outcome outcome;
  EXPECT_TRUE(served.stub->Stop(Limited().get(), {}, &outcome).ok());

  watchers.front()->limited.context.TryCancel();
  watchers.front()->reader->Finish();
  bool admitted = false;
  for (int i = 0; i < 500 && !admitted; ++i) {
    const auto again = watch();
    admitted = again->reader->Read(&status);
    again->limited.context.TryCancel();
    again->reader->Finish();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_TRUE(admitted);
  served.server.stop();
  for (std::size_t i = 1; i < watchers.size(); ++i) watchers[i]->reader->Finish();
}

// More calls than it has threads, in a backend that does not come back: what else is asked waits, stop does
// not.
TEST(RpcServer, StopsAndReportsStatusWhileAllThreadsWait) {
  Served served;
  served.side.block_changes(true);
  std::vector<std::thread> callers;
  for (int i = 0; i < 120; ++i) {
    callers.emplace_back([&] {
      Limited limited;
      proto::Outcome outcome;
      (void)served.stub->Do(&limited.context, setting("0.995"), &outcome);
    });
  }
  // All threads are taken once a call is not answered any more.
  const auto engages = [&] {
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + std::chrono::milliseconds(300));
    proto::Outcome outcome;
    return served.stub->Do(&context, engaging(), &outcome).ok();
  };
  while (engages()) {
  }
  for (int i = 0; i < 20; ++i) {
    proto::Outcome outcome;
    proto::Status status;
    EXPECT_TRUE(served.stub->Stop(Limited().get(), {}, &outcome).ok());
    EXPECT_TRUE(served.stub->GetStatus(Limited().get(), {}, &status).ok());
  }
  const std::vector<std::string> calls = served.side.calls();
  EXPECT_EQ(std::count(calls.begin(), calls.end(), "stop"), 20);
  EXPECT_EQ(std::count(calls.begin(), calls.end(), "set_config"), 0);
  served.side.block_changes(false);
  for (std::thread& caller : callers) caller.join();
}

TEST(RpcServer, NeverLetsTwoChangesIntoTheBackend) {
  Served served;
  std::vector<std::thread> callers;
  for (int i = 0; i < 8; ++i) {
    callers.emplace_back([&] {
      for (int n = 0; n < 50; ++n) {
        proto::Status status;
        EXPECT_TRUE(served.stub->GetStatus(Limited().get(), {}, &status).ok());
        proto::Action action;
        action.mutable_link()->mutable_impairment()->set_loss(0.5);
        proto::Outcome outcome;
        EXPECT_TRUE(served.stub->Do(Limited().get(), action, &outcome).ok());
      }
    });
  }
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(served.side.overlap(), 1);
}

TEST(RpcServer, SaysWhichAddressItCannotHave) {
  FakeBackend side("slave");
  const RpcServer first(kAnyPort, side, "slave");
  try {
    const RpcServer second(first.address(), side, "slave");
    FAIL() << "two servers on " << first.address();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(first.address()), std::string::npos) << error.what();
  }
  for (const char* address : {"nonsense", ":", "127.0.0.1", "127.0.0.1:", "127.0.0.1:70000", "127.0.0.1:-1",
                              ":47010", "203.0.113.1:47010"})
    EXPECT_THROW(RpcServer(address, side, "slave"), std::runtime_error) << address;
}

TEST(RpcServer, CanBeStoppedTwiceAndItsPortUsedAgain) {
  FakeBackend side("slave");
  RpcServer first(kAnyPort, side, "slave");
  first.stop();
  first.stop();
  EXPECT_NO_THROW(RpcServer(first.address(), side, "slave"));
}

}  // namespace
}  // namespace longreach::control_rpc_test
