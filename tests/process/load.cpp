#include "tests/process/load.hpp"

#include <arpa/inet.h>
#include <grpcpp/grpcpp.h>
#include <netinet/in.h>
#include <netinet/udp.h>
#include <sched.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <memory>
#include <numeric>

#include "common/core/random.hpp"
#include "common/link/header.hpp"
#include "common/loop/real_time_loop.hpp"
#include "common/rpc/rpc_channel.hpp"
#include "proto/control.grpc.pb.h"
#include "tests/support/test_site.hpp"

namespace longreach {
namespace {

using Clock = std::chrono::steady_clock;

sockaddr_in loopback(int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

double seconds_since(Clock::time_point began) {
  return std::chrono::duration<double>(Clock::now() - began).count();
}

/// How many of a steady row should have been begun by now.
std::uint64_t due(Clock::time_point began, double rate_hz) {
  return static_cast<std::uint64_t>(rate_hz * seconds_since(began));
}

/// One channel and its calls, in one thread.
class Caller {
 public:
  Caller(RpcRole role, int port, std::size_t width)
      : stub_(proto::Control::NewStub(
            connect_rpc("127.0.0.1:" + std::to_string(port), role, test_site(RpcRole::kClient)))),
        width_(width) {}

  LoadCounts run(double rate_hz, std::chrono::seconds time) {
    constexpr auto kPeriod = std::chrono::milliseconds(2);  // what is due is begun together
    const auto began = Clock::now();
    LoadCounts counts;
    std::size_t open = 0;
    auto next = std::chrono::system_clock::now();
    while (Clock::now() - began < time || open > 0) {
      const bool more = Clock::now() - began < time;
      while (more && open < width_ && counts.done + counts.failed + open < due(began, rate_hz)) {
        begin();
        ++open;
      }
      next += kPeriod;
      void* tag = nullptr;
      bool answered = false;
      while (queue_.AsyncNext(&tag, &answered, next) == grpc::CompletionQueue::GOT_EVENT) {
        const std::unique_ptr<Call> call(static_cast<Call*>(tag));
        ++(call->status.ok() ? counts.done : counts.failed);
        --open;
      }
    }
    counts.seconds = seconds_since(began);
    return counts;
  }

 private:
  struct Call {
    grpc::ClientContext context;
    grpc::Status status;
    proto::Status answer;
    std::unique_ptr<grpc::ClientAsyncResponseReader<proto::Status>> reader;
  };

  void begin() {
    auto call = std::make_unique<Call>();
    call->context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(5));
    call->reader = stub_->AsyncGetStatus(&call->context, {}, &queue_);
    Call* raw = call.release();  // comes back as the tag
    raw->reader->Finish(&raw->answer, &raw->status, raw);
  }

  std::unique_ptr<proto::Control::Stub> stub_;
  std::size_t width_;
  grpc::CompletionQueue queue_;
};

}  // namespace

IdleConnections::IdleConnections(int port, int count) {
  const sockaddr_in address = loopback(port);
  for (int i = 0; i < count; ++i) {
    const int one = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (one < 0) return;
    if (::connect(one, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
      ::close(one);
      return;
    }
    sockets_.push_back(one);
  }
}

IdleConnections::~IdleConnections() {
  for (const int one : sockets_) ::close(one);
}

LoadCounts request_status(RpcRole role, int port, double rate_hz, std::chrono::seconds time) {
  constexpr std::size_t kCallers = 2;
  constexpr std::size_t kCallsAtOnce = 64;
  std::array<LoadCounts, kCallers> counts{};
  std::vector<std::thread> threads;
  for (LoadCounts& own : counts) {
    threads.emplace_back([&] { own = Caller(role, port, kCallsAtOnce).run(rate_hz / kCallers, time); });
  }
  LoadCounts sum;
  for (std::size_t i = 0; i < kCallers; ++i) {
    threads[i].join();
    sum.done += counts[i].done;
    sum.failed += counts[i].failed;
    sum.seconds = std::max(sum.seconds, counts[i].seconds);
  }
  return sum;
}

LoadCounts forge(int port, std::uint64_t session, double rate_hz, std::chrono::seconds time) {
  constexpr std::size_t kBatch = 64;
  constexpr int kBytes = 95;  // of a command
  Random random(session);
  std::array<std::array<std::byte, kBytes>, kBatch> datagrams{};
  for (auto& datagram : datagrams)
    for (auto& byte : datagram) byte = static_cast<std::byte>(random.next());
  const sockaddr_in address = loopback(port);
  const int own = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  // The system cuts each batch into datagrams.
  if (::connect(own, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      ::setsockopt(own, SOL_UDP, UDP_SEGMENT, &kBytes, sizeof kBytes) != 0) {
    ::close(own);
    return {};
  }
  LoadCounts counts;
  const auto began = Clock::now();
  while (Clock::now() - began < time) {
    if (counts.done >= due(began, rate_hz)) {
      std::this_thread::sleep_for(std::chrono::microseconds(200));
      continue;
    }
    for (std::size_t i = 0; i < kBatch; ++i) {
      if (i % 4 == 0) continue;
      const std::uint64_t ahead = i % 4 == 1 ? counts.done + i : i % 4 == 2 ? i : random.next() >> 8U;
      write_header({DatagramType::kMotionCommand, session, ahead}, datagrams[i]);
      datagrams[i][kHeaderBytes] = static_cast<std::byte>(random.next());
    }
    const bool sent = ::send(own, datagrams.data(), sizeof datagrams, 0) == sizeof datagrams;
    (sent ? counts.done : counts.failed) += kBatch;
  }
  counts.seconds = seconds_since(began);
  ::close(own);
  return counts;
}

BareLoops::BareLoops() {
  std::vector<int> processors;
  cpu_set_t allowed;
  sched_getaffinity(0, sizeof allowed, &allowed);
  for (int i = 0; i < CPU_SETSIZE; ++i)
    if (CPU_ISSET(i, &allowed)) processors.push_back(i);
  figures_.resize(processors.size());
  for (std::size_t i = 0; i < processors.size(); ++i)
    threads_.emplace_back([this, i, processor = processors[i]] {
      cpu_set_t own;
      CPU_ZERO(&own);
      CPU_SET(processor, &own);
      sched_setaffinity(0, sizeof own, &own);
      (void)ask_for_real_time(LoopConfig{});
      RealTimeLoop loop(1000.0);
      loop.run(ended_, [](Time, const LoopFigures&) {});
      figures_[i] = loop.figures();
    });
}

BareLoops::~BareLoops() { (void)end(); }

BareLoops::Figures BareLoops::end() {
  ended_ = true;
  Figures out;
  for (std::size_t i = 0; i < threads_.size(); ++i) {
    if (threads_[i].joinable()) threads_[i].join();
    const auto octaves = figures_[i].lateness_octaves();
    out.stalls += std::accumulate(octaves.begin() + 16, octaves.end(), std::uint64_t{0});  // over 2^15 us
    out.lateness_max = std::max(out.lateness_max, figures_[i].lateness_max);
  }
  return out;
}

void Disturbance::expect_none(const std::string& load) {
  const BareLoops::Figures machine = bare_.end();
  const auto judge = [&](const char* name, StationSide& side, const Counts& before) {
    const Counts after(side);
    const std::uint64_t late = after.late - before.late;
    EXPECT_LE(late, machine.stalls) << load << ", " << name;
    EXPECT_LE(after.false_holds - before.false_holds, machine.stalls) << load << ", " << name;
    EXPECT_EQ(after.violations, before.violations) << load << ", " << name;
    std::cout << late << " of " << name << "'s";
  };
  std::cout << load << ": ticks late by over 100 ms: ";
  judge("slave", slave_, slave_before_);
  std::cout << ", ";
  judge("master", master_, master_before_);
  std::cout << "; loops that do nothing: " << machine.stalls << " late by over 33 ms, at most by "
            << 1e3 * to_seconds(machine.lateness_max) << " ms\n";
}

}  // namespace longreach
