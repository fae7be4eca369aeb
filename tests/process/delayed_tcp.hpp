#pragma once
// A TCP proxy on loopback that delays the bytes of both directions, and logs them. It opens the connection to
// the server one delay after it accepted that of the client, as a network would.

#include <array>
#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace longreach {

class DelayedTcp {
 public:
  struct Options {
    std::chrono::duration<double> delay{};  // each way
    int broken = 0;      // number of connections, from the first, that end when the server first responds
    bool reset = false;  // they end with a reset
  };

  DelayedTcp(const std::string& server, const Options& options);
  ~DelayedTcp();
  DelayedTcp(const DelayedTcp&) = delete;
  DelayedTcp& operator=(const DelayedTcp&) = delete;

  [[nodiscard]] std::string address() const;

  /// Round trips of each connection that carried data: one for the handshake of TCP, and one for each time that
  /// bytes of the server follow bytes of the client.
  [[nodiscard]] std::vector<int> round_trips() const;
  /// Bytes that have reached a client.
  [[nodiscard]] std::size_t delivered() const;
  /// One line per packet, for messages of failed tests.
  [[nodiscard]] std::string log() const;

 private:
  struct Link;
  void accept();
  void pump(const std::shared_ptr<Link>& link, bool to_server);
  void pass(const std::shared_ptr<Link>& link, bool to_server, const std::string& bytes);
  void after_delay(const std::function<void()>& act);

  const Options options_;
  asio::io_context context_{1};
  asio::ip::tcp::acceptor acceptor_;
  asio::ip::tcp::endpoint server_;
  mutable std::mutex mutex_;
  struct Entry {
    int connection;
    bool to_server;
    std::size_t bytes;
  };
  std::vector<Entry> entries_;
  std::size_t delivered_ = 0;
  int accepted_ = 0;
  std::thread thread_;
};

}  // namespace longreach
