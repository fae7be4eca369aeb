#pragma once
// Notifies systemd, if it has started the program, that the program is ready and, while the control loop
// ticks, that it is alive (sd_notify(3): a datagram to $NOTIFY_SOCKET). If the loop stalls, the notifications
// stop; WatchdogSec= of the unit defines the timeout.

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

  /// Reads $NOTIFY_SOCKET and $WATCHDOG_USEC; without the former nothing is sent.
  ServiceWatch();
  ~ServiceWatch();
  ServiceWatch(const ServiceWatch&) = delete;
  ServiceWatch& operator=(const ServiceWatch&) = delete;

  /// Call it often, outside the loop. `ticks`: number of ticks of the loop.
  void update(std::uint64_t ticks);

 private:
  void notify(std::string_view words) const;

  int socket_ = -1;  // -1: not started by systemd
  sockaddr_un address_{};
  socklen_t address_size_ = 0;
  std::optional<std::chrono::microseconds> period_{};
  bool ready_ = false;
  std::uint64_t reported_ticks_ = 0;
  Clock::time_point reported_{};
};

}  // namespace longreach
