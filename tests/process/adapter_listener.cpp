#include "tests/process/adapter_listener.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>

namespace longreach {

AdapterListener::AdapterListener(bool anyone)
    : anyone_(anyone), fd_(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
  std::string name = (std::filesystem::temp_directory_path() / "adapter-XXXXXX").string();
  folder_ = ::mkdtemp(name.data());
  path_ = folder_ / "socket";
  sockaddr_un own{};
  own.sun_family = AF_UNIX;
  path_.string().copy(own.sun_path, sizeof own.sun_path - 1);
  ::bind(fd_, reinterpret_cast<const sockaddr*>(&own), sizeof own);
  ::listen(fd_, 1);
}

AdapterListener::~AdapterListener() {
  if (peer_ >= 0) ::close(peer_);
  ::close(fd_);
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

std::optional<std::size_t> AdapterListener::receive(std::span<std::byte> buffer) {
  if (peer_ < 0) peer_ = ::accept4(fd_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (peer_ < 0) return std::nullopt;
  ucred who{};
  socklen_t length = sizeof who;
  ::getsockopt(peer_, SOL_SOCKET, SO_PEERCRED, &who, &length);
  if (!anyone_ && who.uid != ::geteuid()) {
    ::close(peer_);
    peer_ = -1;
    return std::nullopt;
  }
  const ssize_t size = ::recv(peer_, buffer.data(), buffer.size(), MSG_DONTWAIT);
  if (size > 0) return static_cast<std::size_t>(size);
  if (size == 0 || errno != EAGAIN) {
    ::close(peer_);
    peer_ = -1;
  }
  return std::nullopt;
}

void AdapterListener::send(std::span<const std::byte> datagram) const {
  if (peer_ >= 0) ::send(peer_, datagram.data(), datagram.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
}

}  // namespace longreach
