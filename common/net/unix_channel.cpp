#include "common/net/unix_channel.hpp"

#include <sys/fsuid.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "common/config/adapter_address.hpp"
#include "common/core/check.hpp"
#include "common/net/address.hpp"

namespace longreach {
namespace {

constexpr int kLookEvery = 20;  // sends

}  // namespace

std::string unix_path(const std::string& address) {
  if (const std::string why = adapter_address_trouble(address); !why.empty())
    throw AddressError("'" + address + "'" + why);
  return adapter_path(address);
}

int connect_unix(const std::string& path) {
  sockaddr_un there{};
  there.sun_family = AF_UNIX;
  path.copy(there.sun_path, sizeof there.sun_path - 1);
  const int fd = ::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (fd < 0 || ::connect(fd, reinterpret_cast<const sockaddr*>(&there), sizeof there) == 0) return fd;
  const int why = errno;
  ::close(fd);
  errno = why;
  return -1;
}

int connect_unix_as(uid_t user, const std::string& path) {
  const uid_t own = ::geteuid();
  constexpr auto kKeep = static_cast<uid_t>(-1);
  // Of this thread alone, which looks paths up as the user that it was.
  if (::syscall(SYS_setresuid, kKeep, user, kKeep) != 0) return -1;
  ::setfsuid(own);
  const int fd = connect_unix(path);
  const int why = errno;
  CHECK(::syscall(SYS_setresuid, kKeep, own, kKeep) == 0);
  errno = why;
  return fd;
}

std::string no_socket_there(const std::string& path) {
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0)
    return errno == ENOENT ? "there is no such file"
                           : std::string("it is not accessible: ") + std::strerror(errno);
  if (S_ISDIR(found.st_mode)) return "it is a folder, not a socket";
  return S_ISSOCK(found.st_mode) ? "" : "it is a file, not a socket";
}

std::string why_not_connected(const std::string& path, int error) {
  if (const std::string why = no_socket_there(path); !why.empty()) return why;
  if (error == ECONNREFUSED) return "it is a socket, but no program is listening on it";
  if (error == EPROTOTYPE) return "it is not a socket of type SOCK_SEQPACKET";
  if (error == EAGAIN) return "another program is connected, and other programs are waiting";
  return std::string("the connection failed: ") + std::strerror(error);
}

std::optional<uid_t> peer_user(int socket) {
  ucred peer{};
  socklen_t size = sizeof peer;
  if (::getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0) return std::nullopt;
  return peer.uid;
}

bool may_be_trusted(uid_t user) { return user == ::geteuid() || user == 0; }

UnixChannel::UnixChannel(const std::string& address) : path_(unix_path(address)) {}

UnixChannel::~UnixChannel() { leave(); }

void UnixChannel::check_socket() {
  if (wait_-- > 0) return;
  wait_ = kLookEvery;
  socket_ = connect_unix(path_);
  if (socket_ < 0) return;
  const std::optional<uid_t> user = peer_user(socket_);
  unknown_peer_.reset();
  if (user && may_be_trusted(*user)) return;
  unknown_peer_ = user.value_or(static_cast<uid_t>(-1));
  leave();
}

void UnixChannel::leave() {
  if (socket_ >= 0) ::close(socket_);
  socket_ = -1;
}

// These sockets are not Asio's: it has no class for Unix sockets of type SOCK_SEQPACKET, its generic one needs an
// io_context with three more descriptors for each channel, and the number of system calls would be the same.
std::optional<std::size_t> UnixChannel::receive(std::span<std::byte> buffer) {
  if (socket_ < 0) return std::nullopt;
  const ssize_t size = ::recv(socket_, buffer.data(), buffer.size(), MSG_DONTWAIT | MSG_TRUNC);
  if (size > 0) return static_cast<std::size_t>(size);
  const bool waits = size < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR);
  if (!waits) leave();
  return std::nullopt;
}

void UnixChannel::send(std::span<const std::byte> datagram) {
  if (socket_ < 0) check_socket();
  if (socket_ < 0) return;
  const ssize_t sent = ::send(socket_, datagram.data(), datagram.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
  if (sent < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR) leave();
}

}  // namespace longreach
