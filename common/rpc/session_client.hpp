#pragma once
// Keeps the master in a session with its slave. It requests a session at the start, and again if no datagram
// from the slave has arrived for some time, because the slave may have restarted. If the slave still has the
// old session, that session is kept. After a failure it retries, first after 0.1 s and then at intervals of
// up to 2 s. If another master has taken control of the robot, this object retries until that master returns
// control. Runs in its own thread, for which the loop never waits.

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "common/crypto/session.hpp"
#include "common/site/rpc_security.hpp"

namespace grpc {
class ClientContext;
}

namespace longreach {

class SessionClient {
 public:
  /// State of the loop, which determines whether a session is needed.
  struct Present {
    std::uint64_t session = 0;  // 0: no session
    // Time since the last datagram from the slave in this session; infinite if there was none.
    double silence_s = 0.0;
    std::string slave{};              // address to which the master sends datagrams
    std::uint64_t unknown_peers = 0;  // datagrams from other addresses
    double delay_s = 0.0;             // artificial round-trip delay of datagrams, which does not apply to RPC
  };
  using Presence = std::function<Present()>;
  /// Passes a session to the loop. Returns false if the loop did not accept it.
  using Adopt = std::function<bool(const Session&)>;

  /// `address` is the address of the slave's RPC server. If `take` is set, the first session takes control
  /// from another master. `send_hz` is the rate at which this master sends commands. `presence` and `adopt`
  /// are called in the thread of this object.
  SessionClient(std::string address, const RpcSecurity& security, bool take, double send_hz,
                Presence presence, Adopt adopt);
  /// Cancels a call in progress and returns control of the robot. Takes at most 2 s.
  ~SessionClient();
  SessionClient(const SessionClient&) = delete;
  SessionClient& operator=(const SessionClient&) = delete;

  /// Returns why there is no session or why no datagrams of the session arrive, in one sentence with the
  /// address of the slave and a remedy. Returns an empty string if there is no problem or the first response
  /// is pending.
  [[nodiscard]] std::string trouble() const;
  /// Returns the address of the master that took control of the robot. Returns an empty string if this master
  /// has control or never had it.
  [[nodiscard]] std::string taken_by() const;

 private:
  struct Rpc;
  void run();
  std::string connect(std::uint64_t present, double more_time_s = 0.0);
  [[nodiscard]] std::string unreceived(const Present& present) const;
  void give_back();
  bool wait(std::chrono::milliseconds time);

  const std::string address_;
  const Presence presence_;
  const Adopt adopt_;
  std::unique_ptr<Rpc> rpc_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::atomic<bool> ended_ = false;
  bool take_;
  const double send_hz_;
  grpc::ClientContext* call_ = nullptr;  // in progress
  // Used only by the thread of this object: when the session was adopted, and how long the last call took.
  std::chrono::steady_clock::time_point adopted_at_{};
  std::chrono::steady_clock::duration call_took_{};
  std::string trouble_;
  std::string taken_by_;
  std::thread thread_;
};

/// Returns the address of the slave's RPC server: `slave_rpc`, or, if that is empty, the default port at the
/// host of `slave`.
std::string slave_rpc_address(const std::string& slave, const std::string& slave_rpc);

}  // namespace longreach
