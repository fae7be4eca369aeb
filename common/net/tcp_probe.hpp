#pragma once
// A TCP handshake with an address, which shows whether its host answers and how long a round trip takes. The
// connection is closed without data. Only the name of the host is resolved in the constructor, which may
// block.

#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <chrono>
#include <optional>
#include <string>

namespace longreach {

class TcpProbe {
 public:
  enum class State { kPending, kAccepted, kFailed };

  /// Starts the handshake. `address` is HOST:PORT; an invalid address or an unknown host is a failure.
  explicit TcpProbe(const std::string& address);

  /// Continues for at most `time`, and returns the present state.
  State run_for(std::chrono::milliseconds time);
  /// Duration of the handshake, s; none if no connection was accepted.
  [[nodiscard]] std::optional<double> handshake_s() const { return handshake_s_; }

 private:
  const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  asio::io_context context_{1};
  asio::ip::tcp::socket socket_{context_};
  std::optional<double> handshake_s_{};
  bool failed_ = false;
};

}  // namespace longreach
