#pragma once
// A fake SpaceMouse daemon.

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>

namespace longreach {

/// Imitates spacenavd: sends events that consist of eight numbers over a UNIX socket, and replies to the
/// handshake of protocol version 1 and to the request for the name of the device.
class FakeDaemon {
 public:
  explicit FakeDaemon(const std::string& path) : path_(path) {
    std::filesystem::remove(path_);
    listener_ = ::socket(AF_UNIX, SOCK_STREAM, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path_.c_str(), sizeof address.sun_path - 1);
    EXPECT_EQ(::bind(listener_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(::listen(listener_, 1), 0);
    thread_ = std::thread([this] { serve(); });
  }
  ~FakeDaemon() {
    ended_ = true;
    thread_.join();
    if (client_ >= 0) ::close(client_);
    ::close(listener_);
    std::filesystem::remove(path_);
  }
  FakeDaemon(const FakeDaemon&) = delete;
  FakeDaemon& operator=(const FakeDaemon&) = delete;

  void motion(std::array<std::int32_t, 6> axes) {
    send({0, axes[0], axes[1], axes[2], axes[3], axes[4], axes[5], 16});
  }
  /// Pushes as a person does: a puck that is pushed at the moment of an engagement counts only when it has been
  /// released once, so every twentieth call releases it.
  void push(std::array<std::int32_t, 6> axes) {
    if (++pushes_ % 20 == 0) axes.fill(0);
    motion(axes);
  }
  void button(int number, bool down) { send({down ? 1 : 2, number}); }
  void unplugged() { send({3, 1}); }
  void plugged_in() { send({3, 0}); }

 private:
  void send(std::array<std::int32_t, 8> event) {
    const std::lock_guard lock(writing_);
    EXPECT_EQ(::send(client_, event.data(), sizeof event, MSG_NOSIGNAL), static_cast<ssize_t>(sizeof event));
  }

  void serve() {
    while (!ended_) {
      std::array<pollfd, 2> ends{{{listener_, POLLIN, 0}, {client_, POLLIN, 0}}};
      ::poll(ends.data(), ends.size(), 10);
      if ((ends[0].revents & POLLIN) != 0) client_ = ::accept(listener_, nullptr, nullptr);
      if (client_ >= 0 && (ends[1].revents & POLLIN) != 0) answer();
    }
  }

  // The first request is a single number, which is echoed. Each later request consists of eight numbers; the
  // last number of the reply is a status, which is >= 0.
  void answer() {
    std::array<std::int32_t, 8> asked{};
    const ssize_t n = ::recv(client_, asked.data(), greeted_ ? sizeof asked : sizeof asked[0], 0);
    if (n <= 0) return;
    const std::lock_guard lock(writing_);
    if (!greeted_) {
      greeted_ = true;
      ::send(client_, asked.data(), sizeof asked[0], MSG_NOSIGNAL);
      return;
    }
    for (std::size_t i = 1; i < 8; ++i) asked[i] = 0;
    ::send(client_, asked.data(), sizeof asked, MSG_NOSIGNAL);
  }

  std::string path_;
  int listener_ = -1;
  int pushes_ = 0;
  std::atomic<int> client_{-1};
  std::atomic<bool> ended_{false};
  std::atomic<bool> greeted_{false};
  std::mutex writing_;
  std::thread thread_;
};

}  // namespace longreach
