#pragma once
// Keeps the master in a session with its slave: requests one at the start, and again if the slave was silent,
// since it may have been restarted. Uses its own thread: the loop never waits for it. A session that the
// slave still knows is kept. After a failure it retries after 0.1 s, later up to 2 s, until it is ended. If
// another master has taken control of the robot, it waits until that master returns it.

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
  /// State of the loop.
  struct Present {
    std::uint64_t session = 0;  // 0: none
    double silence_s = 0.0;     // since the last datagram of the slave in this session; infinite: none
    std::string slave{};        // destination of datagrams
    double delay_s = 0.0;       // artificial round-trip delay, which RPC does not have
  };
  using Presence = std::function<Present()>;
  /// Passes a session to the loop; false: the loop did not accept it.
  using Adopt = std::function<bool(const Session&)>;

  /// `address`: address of the slave's RPC server. Both functions are called in the thread of this object.
  /// `take`: once, take control from another master. `send_hz`: rate of this master.
  SessionClient(std::string address, const RpcSecurity& security, bool take, double send_hz,
                Presence presence, Adopt adopt);
  /// Returns the robot, within 2 s. Cancels a call in progress.
  ~SessionClient();
  SessionClient(const SessionClient&) = delete;
  SessionClient& operator=(const SessionClient&) = delete;

  /// Returns why there is no session, or why none of its datagrams arrives: one sentence with the address of
  /// the slave and a remedy. Empty: there is a session, or the first answer is pending.
  [[nodiscard]] std::string trouble() const;
  /// Address of the master that has taken control of the robot. Empty: this master has control, or never had.
  [[nodiscard]] std::string taken_by() const;

 private:
  struct Rpc;
  void run();
  std::string connect(std::uint64_t present);
  [[nodiscard]] std::string unreceived(const Present& present) const;
  void give_back();
  bool wait(std::chrono::milliseconds time);

  const std::string address_;
  const Presence presence_;
  const Adopt adopt_;
  std::unique_ptr<Rpc> rpc_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  bool ended_ = false;
  bool take_;
  const double send_hz_;
  grpc::ClientContext* call_ = nullptr;  // in progress
  // Used by this thread only: when the session was adopted, and the duration of a call.
  std::chrono::steady_clock::time_point adopted_at_{};
  std::chrono::steady_clock::duration call_took_{};
  std::string trouble_;
  std::string taken_by_;
  std::thread thread_;
};

/// Address of the slave's RPC server: `slave_rpc`, or if that is empty the default port at the address of
/// `slave`.
std::string slave_rpc_address(const std::string& slave, const std::string& slave_rpc);

}  // namespace longreach
