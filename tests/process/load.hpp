#pragma once
// Loads for a program on loopback, each bounded in count and time, each ended with its object: idle
// connections, requests, forged datagrams; and a bare loop, which tells a stall of the whole machine from one
// of a program.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>
#include <vector>

#include "common/io/loop_figures.hpp"
#include "common/io/rpc_security.hpp"

namespace longreach {

/// TCP connections to a port that say nothing.
class IdleConnections {
 public:
  IdleConnections(int port, int count);
  ~IdleConnections();
  IdleConnections(const IdleConnections&) = delete;
  IdleConnections& operator=(const IdleConnections&) = delete;
  [[nodiscard]] int connected() const { return static_cast<int>(sockets_.size()); }

 private:
  std::vector<int> sockets_;
};

struct LoadCounts {
  std::uint64_t done = 0;
  std::uint64_t failed = 0;
  double seconds = 0.0;
  [[nodiscard]] double rate_hz() const { return done > 0 ? static_cast<double>(done) / seconds : 0.0; }
};

/// GetStatus over mutual TLS from several channels, many calls under way at once, no more than `rate_hz`.
LoadCounts request_status(RpcRole role, int port, double rate_hz, std::chrono::seconds time);

/// Datagrams that are nobody's, `rate_hz` of them: three of four with a command's header, the session's
/// number, and a number that is new, old or far ahead; their bodies are random, and so is the fourth.
LoadCounts forge(int port, std::uint64_t session, double rate_hz, std::chrono::seconds time);

/// A loop of 1 kHz with real-time priority that does nothing, for as long as it lives.
class BareLoop {
 public:
  BareLoop();
  ~BareLoop();
  BareLoop(const BareLoop&) = delete;
  BareLoop& operator=(const BareLoop&) = delete;
  LoopFigures end();

 private:
  std::atomic<bool> ended_{false};
  LoopFigures figures_{};
  std::thread thread_;
};

}  // namespace longreach
