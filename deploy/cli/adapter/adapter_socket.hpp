#pragma once
// Socket of `longreach adapter check`: sends datagrams to an adapter and receives its datagrams. Received
// datagrams carry the kernel's time stamps, so reading them late does not affect the result. The adapter may
// start late, exit or restart during the check.

#include <sys/types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace longreach {

class AdapterSocket {
 public:
  struct Arrival {
    std::int64_t at_ns = 0;  // CLOCK_REALTIME
    std::size_t size = 0;    // size as sent, even if `bytes` is truncated
    std::array<std::byte, 1024> bytes{};
  };

  /// If `user` is given, connects as a process of that user, which requires root. Throws AddressError or
  /// std::runtime_error.
  explicit AdapterSocket(const std::string& address, std::optional<uid_t> user = {});
  ~AdapterSocket();
  AdapterSocket(const AdapterSocket&) = delete;
  AdapterSocket& operator=(const AdapterSocket&) = delete;

  /// Returns the reason why there is no connection, or an empty string if there is one.
  [[nodiscard]] std::string trouble() const;
  /// Returns whether users other than the owner of the socket path may connect.
  [[nodiscard]] bool open_to_others() const;

  /// Returns the time at which the datagram was sent, in ns of CLOCK_REALTIME.
  std::int64_t send(std::span<const std::byte> datagram) const;
  /// Returns the next datagram, or std::nullopt if none arrives before `end_ns`.
  [[nodiscard]] std::optional<Arrival> receive(std::int64_t end_ns) const;
  [[nodiscard]] static std::int64_t now_ns();

 private:
  void reach() const;
  void leave() const;

  std::string path_;
  std::optional<uid_t> user_;
  mutable int fd_ = -1;    // -1: no process is listening
  mutable int error_ = 0;  // errno of the last attempt to connect
};

}  // namespace longreach
