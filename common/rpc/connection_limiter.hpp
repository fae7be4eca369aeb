#pragma once
// Accepts the connections of a server and lets in those that say something. One that says nothing costs a
// descriptor and no more: it is closed after kSilent, or when there are kSilentMax younger ones or no
// descriptor is left. At most kInsideMax are inside at once, never more than half of the program's
// descriptors, and half of them of one host, so that no other host can shut this one out. Where there is no
// room, the oldest that has not even shown a certificate gives way. Who is closed is noted as refused
// (rpc_refusals). A thread of its own.

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

/// A socket that listens, closed with the object.
class ListeningSocket {
 public:
  /// `listen`: address:port; port 0: any free one. Invalid where it cannot be had.
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

  /// `let_in` takes a connection over and closes it when it ends. `socket` must outlive this.
  ConnectionLimiter(const ListeningSocket& socket, std::function<void(int)> let_in);
  ~ConnectionLimiter();
  ConnectionLimiter(const ConnectionLimiter&) = delete;
  ConnectionLimiter& operator=(const ConnectionLimiter&) = delete;

 private:
  struct Silent {
    int fd = -1;
    Clock::time_point since{};
  };
  /// The descriptor is somebody else's by now; its socket's number tells whether it is open still.
  struct Inside {
    int fd = -1;
    ino_t socket = 0;
    std::array<unsigned char, 16> host{};  // IPv6, or IPv4 in front
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
  std::size_t most_inside_ = 0;  // since memory was given back
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

}  // namespace longreach
