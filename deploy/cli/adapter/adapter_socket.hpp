#pragma once
// The socket of `longreach adapter check`: sends to an adapter and hears what it sends back, with the times
// at which the system took it, so that a late reader blames nobody. The adapter may come later, end and come
// again.

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
    std::size_t size = 0;    // true size, also of what was cut
    std::array<std::byte, 1024> bytes{};
  };

  /// `user`: connects as a program of that user; root alone can. Throws AddressError or std::runtime_error.
  explicit AdapterSocket(const std::string& address, std::optional<uid_t> user = {});
  ~AdapterSocket();
  AdapterSocket(const AdapterSocket&) = delete;
  AdapterSocket& operator=(const AdapterSocket&) = delete;

  /// Why there is no connection, or empty.
  [[nodiscard]] std::string trouble() const;
  /// Whether another user than the owner of the path may connect.
  [[nodiscard]] bool open_to_others() const;

  /// Returns when.
  std::int64_t send(std::span<const std::byte> datagram) const;
  /// The next datagram; none until `end_ns`.
  [[nodiscard]] std::optional<Arrival> receive(std::int64_t end_ns) const;
  [[nodiscard]] static std::int64_t now_ns();

 private:
  void reach() const;
  void leave() const;

  std::string path_;
  std::optional<uid_t> user_;
  mutable int fd_ = -1;    // none: nobody listens
  mutable int error_ = 0;  // of the last attempt to connect
};

}  // namespace longreach
