#pragma once
// Accepts the connections of a server and admits those that send data. A silent connection only costs a
// descriptor: it is closed after kSilent, or if there are kSilentMax newer ones or no descriptor is left. At
// most kInsideMax are admitted at once, never more than half of the descriptors of the program, and at most
// half of them from one host, so that no host can exclude another one. If there is no room, the oldest
// connection without a verified certificate is closed. Closed connections are counted as refused
// (rpc_refusals). Uses its own thread.

#include <sys/types.h>

#include <array>
#include <atomic>
#include <chrono>
#include <deque>
#include <functional>
#include <string>
#include <thread>
#include <vector>

namespace longreach {

/// A listening socket, closed with the object.
class ListeningSocket {
 public:
  /// `listen`: address:port; port 0: any free one. Invalid if the socket cannot be opened.
  explicit ListeningSocket(const std::string& listen);
  ~ListeningSocket();
  ListeningSocket(const ListeningSocket&) = delete;
  ListeningSocket& operator=(const ListeningSocket&) = delete;

  [[nodiscard]] int fd() const { return fd_; }  // -1: invalid
  [[nodiscard]] int port() const;

 private:
  int fd_ = -1;
};

class ConnectionLimiter {
 public:
  using Clock = std::chrono::steady_clock;

  static constexpr std::size_t kSilentMax = 256;
  static constexpr std::size_t kInsideMax = 256;
  static constexpr std::chrono::seconds kSilent{10};

  /// `let_in` takes ownership of a connection and closes it at its end. `socket` must outlive this object.
  ConnectionLimiter(const ListeningSocket& socket, std::function<void(int)> let_in);
  ~ConnectionLimiter();
  ConnectionLimiter(const ConnectionLimiter&) = delete;
  ConnectionLimiter& operator=(const ConnectionLimiter&) = delete;

 private:
  struct Silent {
    int fd = -1;
    Clock::time_point since{};
  };
  /// The descriptor now belongs to other code; the number of its socket tells whether it is still open.
  struct Inside {
    int fd = -1;
    ino_t socket = 0;
    std::array<unsigned char, 16> host{};  // IPv6, or IPv4 at the front
  };

  void run();
  void wait() const;
  void accept_all();
  bool accept_one();
  void receive();
  void expire();
  void let_in(int fd);
  [[nodiscard]] const char* crowded(const Inside& who) const;
  void shut_unproven(const Inside& in_favour_of);
  void close_oldest(const char* why);
  void count_inside();

  const int listener_;
  const std::function<void(int)> let_in_;
  std::deque<Silent> silent_;  // oldest first
  std::vector<Inside> inside_;
  std::size_t most_inside_ = 0;  // since memory was last released
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

}  // namespace longreach
