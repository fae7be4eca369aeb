#pragma once
// Loads for a program on loopback, each bounded in count and time, each ended with its object: idle
// connections, requests, forged datagrams; loops that do nothing, which tell a stall of the machine from one
// of a program; and what a load may not do to both sides.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>
#include <vector>

#include "common/loop/loop_figures.hpp"
#include "common/site/rpc_security.hpp"
#include "tests/support/station.hpp"

namespace longreach {

/// TCP connections to a port that say nothing.
class IdleConnections {
 public:
  IdleConnections(int port, int count);
  ~IdleConnections();
  IdleConnections(const IdleConnections&) = delete;
  IdleConnections& operator=(const IdleConnections&) = delete;
  [[nodiscard]] int connected() const { return static_cast<int>(sockets_.size()); }
  [[nodiscard]] int socket(std::size_t i) const { return sockets_[i]; }

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

/// Loops of 1 kHz with real-time priority that do nothing, one on each processor, for as long as they live:
/// where one of them is late, the machine stood still.
class BareLoops {
 public:
  struct Figures {
    std::uint64_t stalls = 0;  // ticks late by over 33 ms
    Duration lateness_max{0};
  };

  BareLoops();
  ~BareLoops();
  BareLoops(const BareLoops&) = delete;
  BareLoops& operator=(const BareLoops&) = delete;
  Figures end();

 private:
  std::atomic<bool> ended_{false};
  std::vector<LoopFigures> figures_;
  std::vector<std::thread> threads_;
};

/// What a load may not do to both sides while this lives, beyond what the machine did to itself.
class Disturbance {
 public:
  Disturbance(StationSide& slave, StationSide& master) : slave_(slave), master_(master) {}
  /// Ends it: no tick late by over 100 ms and no false hold but where the machine stood still, no violated
  /// limit. Prints what was seen.
  void expect_none(const std::string& load);

 private:
  struct Counts {
    std::uint64_t late = 0, false_holds = 0, violations = 0;
    explicit Counts(StationSide& side)
        : late(side.counter("ticks_late_100ms")),
          false_holds(side.counter("false_holds")),
          violations(side.counter("limit_violations")) {}
  };

  StationSide& slave_;
  StationSide& master_;
  BareLoops bare_;
  const Counts slave_before_{slave_}, master_before_{master_};
};

}  // namespace longreach
