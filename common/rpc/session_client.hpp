#pragma once
// Keeps the master in a session with its slave: asks for one at the start, and again when the slave has been
// silent, since it may have been restarted. A thread of its own: the loop never waits for it. A session that
// the slave still knows is kept. After a failure it asks again, after 0.1 s at first and 2 s at last, until
// it is ended. A robot that was taken from it is never taken back: it waits until that one returns it.

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
  /// What the loop knows.
  struct Present {
    std::uint64_t session = 0;  // 0: none
    double silence_s = 0.0;     // since the slave was heard in it; infinite: never
    std::string slave{};        // where datagrams are sent to
    double delay_s = 0.0;       // that is artificial, there and back: RPC knows nothing of it
  };
  using Presence = std::function<Present()>;
  /// Hands a session to the loop; false: it did not take it.
  using Adopt = std::function<bool(const Session&)>;

  /// `address`: of the slave's RPC server. Both functions are called in the seeker's thread.
  /// `take`: once, the robot is taken from a master that has it. `send_hz`: of this master.
  SessionClient(std::string address, const RpcSecurity& security, bool take, double send_hz,
                Presence presence, Adopt adopt);
  /// Returns the robot, which takes 2 s at most. Ends a call that is under way.
  ~SessionClient();
  SessionClient(const SessionClient&) = delete;
  SessionClient& operator=(const SessionClient&) = delete;

  /// Why there is no session, or no datagram of it comes back: one sentence that names the slave's address
  /// and what to do. Empty: there is one, or the first answer is awaited.
  [[nodiscard]] std::string trouble() const;
  /// Address of the master that has taken the robot from this one. Empty: it has it, or never had.
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
  grpc::ClientContext* call_ = nullptr;  // under way
  // Of this thread: when the session was adopted, and how long a call takes.
  std::chrono::steady_clock::time_point adopted_at_{};
  std::chrono::steady_clock::duration call_took_{};
  std::string trouble_;
  std::string taken_by_;
  std::thread thread_;
};

/// Where the slave's RPC server listens: `slave_rpc`, or where that is empty its usual port at the address of
/// `slave`.
std::string slave_rpc_address(const std::string& slave, const std::string& slave_rpc);

}  // namespace longreach
