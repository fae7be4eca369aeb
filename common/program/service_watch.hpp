#pragma once
// Tells systemd, where it has started the program, that it is ready and, as long as the control loop ticks,
// that it lives (sd_notify(3): a datagram to $NOTIFY_SOCKET). A loop that stands still is told by silence;
// WatchdogSec= of the unit says for how long.

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

  /// Reads $NOTIFY_SOCKET and $WATCHDOG_USEC; without the first nothing is ever sent.
  ServiceWatch();
  ~ServiceWatch();
  ServiceWatch(const ServiceWatch&) = delete;
  ServiceWatch& operator=(const ServiceWatch&) = delete;

  /// Call it often, from outside of the loop. `ticks`: of the loop so far.
  void update(std::uint64_t ticks);

 private:
  void notify(std::string_view words) const;

  int socket_ = -1;  // -1: nobody to tell
  sockaddr_un address_{};
  socklen_t address_size_ = 0;
  std::optional<std::chrono::microseconds> period_{};
  bool ready_ = false;
  std::uint64_t reported_ticks_ = 0;
  Clock::time_point reported_{};
};

}  // namespace longreach
