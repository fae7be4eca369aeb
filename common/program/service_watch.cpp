#include "common/program/service_watch.hpp"

#include <sys/socket.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>

namespace longreach {

ServiceWatch::ServiceWatch() {
  const char* path = std::getenv("NOTIFY_SOCKET");
  if (path == nullptr || (path[0] != '/' && path[0] != '@')) return;
  const std::size_t size = std::strlen(path);
  if (size >= sizeof address_.sun_path) return;
  address_.sun_family = AF_UNIX;
  std::memcpy(address_.sun_path, path, size);
  if (path[0] == '@') address_.sun_path[0] = '\0';  // an abstract name
  address_size_ = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + size);
  socket_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const char* within = std::getenv("WATCHDOG_USEC");
  const long long us = within == nullptr ? 0 : std::atoll(within);
  if (us > 0) period_ = std::chrono::microseconds(us / 4);
}

ServiceWatch::~ServiceWatch() {
  if (socket_ >= 0) ::close(socket_);
}

void ServiceWatch::update(std::uint64_t ticks) {
  if (socket_ < 0 || ticks == reported_ticks_) return;
  if (!ready_) notify("READY=1");
  ready_ = true;
  if (!period_ || Clock::now() - reported_ < *period_) return;
  notify("WATCHDOG=1");
  reported_ = Clock::now();
  reported_ticks_ = ticks;
}

void ServiceWatch::notify(std::string_view words) const {
  (void)::sendto(socket_, words.data(), words.size(), MSG_NOSIGNAL,
                 reinterpret_cast<const sockaddr*>(&address_), address_size_);
}

}  // namespace longreach
