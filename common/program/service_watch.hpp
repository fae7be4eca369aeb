#pragma once
// Notifies systemd, if it started the program, that the program is ready and, while the control loop ticks,
// that it is alive (sd_notify(3): a datagram to $NOTIFY_SOCKET). If the loop stalls, the notifications stop.
// WatchdogSec= in the unit file defines the timeout.

#include <sys/socket.h>
#include <sys/un.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string_view>

namespace longreach {

class ServiceWatch {
 public:
  using Clock = std::chrono::steady_clock;

  /// Reads $NOTIFY_SOCKET and $WATCHDOG_USEC. If $NOTIFY_SOCKET is not set, nothing is sent.
  ServiceWatch();
  ~ServiceWatch();
  ServiceWatch(const ServiceWatch&) = delete;
  ServiceWatch& operator=(const ServiceWatch&) = delete;

  /// Call this frequently, in a thread other than the loop. `ticks` is the number of ticks of the loop so
  /// far.
  void update(std::uint64_t ticks);

 private:
  void notify(std::string_view words) const;

  int socket_ = -1;  // -1 if systemd did not start the program
  sockaddr_un address_{};
  socklen_t address_size_ = 0;
  std::optional<std::chrono::microseconds> period_{};
  bool ready_ = false;
  std::uint64_t reported_ticks_ = 0;
  Clock::time_point reported_{};
};

}  // namespace longreach
