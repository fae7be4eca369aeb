#pragma once
// Puts load on a program on loopback: idle connections, requests, or forged datagrams. Every load is limited
// in number and duration. BareLoops distinguishes a stall of the machine from a stall of a program, and
// Disturbance checks that a load does not affect the two sides.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>
#include <vector>

#include "common/loop/loop_figures.hpp"
#include "common/site/rpc_security.hpp"
#include "tests/support/station.hpp"

namespace longreach {

/// Opens idle TCP connections to a port and closes them in the destructor.
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

/// Calls GetStatus over mutual TLS from several channels with many concurrent calls, at a rate of at most
/// `rate_hz`.
LoadCounts request_status(RpcRole role, int port, double rate_hz, std::chrono::seconds time);

/// Sends forged datagrams at `rate_hz`. Three out of four have a command header with the session number, a
/// sequence number that is new, old or far ahead, and a random body; the fourth is entirely random.
LoadCounts forge(int port, std::uint64_t session, double rate_hz, std::chrono::seconds time);

/// Empty 1 kHz loops with real-time priority, one per processor. If one of them is late, the machine was
/// stalled.
class BareLoops {
 public:
  struct Figures {
    std::uint64_t stalls = 0;  // number of ticks that were more than 33 ms late
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

/// Checks the effect of a load on both sides during the lifetime of this object. Stalls of the machine are
/// excluded.
class Disturbance {
 public:
  Disturbance(StationSide& slave, StationSide& master) : slave_(slave), master_(master) {}
  /// Ends the check and prints the results. Expects that no limit was violated and, unless the machine was
  /// stalled, that no tick was more than 100 ms late and no false hold occurred.
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
