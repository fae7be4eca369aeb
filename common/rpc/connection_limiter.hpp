#pragma once
// Accepts the connections of a server and admits those that send data. A connection that does not send data
// costs only a descriptor. It is closed after kSilent, or earlier if there are more than kSilentMax such
// connections or no descriptor is left. At most kInsideMax connections are admitted at the same time, but not
// more than half of the program's descriptors, and at most half of these from one host, so that no host can
// exclude another. If there is no room for a new connection, the oldest connection without a completed
// handshake is closed. Closed connections are counted as refused (rpc_refusals). Runs in its own thread.

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

/// A listening socket, which the destructor closes.
class ListeningSocket {
 public:
  /// `listen` is address:port; port 0 stands for any free port. The socket is invalid if it cannot be opened.
  explicit ListeningSocket(const std::string& listen);
  ~ListeningSocket();
  ListeningSocket(const ListeningSocket&) = delete;
  ListeningSocket& operator=(const ListeningSocket&) = delete;

  [[nodiscard]] int fd() const { return fd_; }  // -1 if the socket is invalid
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

  /// `let_in` takes ownership of an admitted connection and closes it at the end. `socket` must outlive this
  /// object.
  ConnectionLimiter(const ListeningSocket& socket, std::function<void(int)> let_in);
  ~ConnectionLimiter();
  ConnectionLimiter(const ConnectionLimiter&) = delete;
  ConnectionLimiter& operator=(const ConnectionLimiter&) = delete;

 private:
  struct Silent {
    int fd = -1;
    Clock::time_point since{};
  };
  /// An admitted connection. Other code owns its descriptor; the inode number of the socket shows whether the
  /// connection is still open.
  struct Inside {
    int fd = -1;
    ino_t socket = 0;
    std::array<unsigned char, 16> host{};  // IPv6 address, or IPv4 address in the first four bytes
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
  std::size_t most_inside_ = 0;  // maximum number admitted since memory was last released
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

}  // namespace longreach
