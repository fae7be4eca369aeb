#include "deploy/cli/adapter/adapter_socket.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "common/net/unix_channel.hpp"

namespace longreach {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

std::int64_t nanoseconds(const timespec& t) { return t.tv_sec * kSecond_ns + t.tv_nsec; }

/// Time at which the kernel received the datagram, or the present time if there is no time stamp.
std::int64_t taken_ns(msghdr& message) {
  for (cmsghdr* c = CMSG_FIRSTHDR(&message); c != nullptr; c = CMSG_NXTHDR(&message, c)) {
    if (c->cmsg_level != SOL_SOCKET || c->cmsg_type != SCM_TIMESTAMPNS) continue;
    timespec t{};
    std::memcpy(&t, CMSG_DATA(c), sizeof t);
    return nanoseconds(t);
  }
  return AdapterSocket::now_ns();
}

}  // namespace

AdapterSocket::AdapterSocket(const std::string& address, std::optional<uid_t> user)
    : path_(unix_path(address)), user_(user) {
  reach();
}

void AdapterSocket::reach() const {
  if (fd_ >= 0) return;
  fd_ = user_ ? connect_unix_as(*user_, path_) : connect_unix(path_);
  error_ = errno;
  if (fd_ < 0) return;
  const auto user = peer_user(fd_);
  if (!user || !may_be_trusted(*user)) {
    leave();
    throw std::runtime_error("the program listening at unix:" + path_ +
                             " belongs to another user: start the adapter as the user that runs longreach");
  }
  const int on = 1;
  ::setsockopt(fd_, SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on);
}

void AdapterSocket::leave() const {
  if (fd_ >= 0) ::close(fd_);
  fd_ = -1;
}

AdapterSocket::~AdapterSocket() { leave(); }

std::string AdapterSocket::trouble() const { return fd_ < 0 ? why_not_connected(path_, error_) : ""; }

bool AdapterSocket::open_to_others() const {
  struct stat found {};
  return ::stat(path_.c_str(), &found) == 0 && (found.st_mode & (S_IWGRP | S_IWOTH)) != 0;
}

std::int64_t AdapterSocket::now_ns() {
  timespec t{};
  clock_gettime(CLOCK_REALTIME, &t);
  return nanoseconds(t);
}

std::int64_t AdapterSocket::send(std::span<const std::byte> datagram) const {
  // Errors are ignored: a missing adapter is detected because nothing is received.
  reach();
  [[maybe_unused]] const ssize_t sent = ::send(fd_, datagram.data(), datagram.size(), MSG_NOSIGNAL);
  return now_ns();
}

// Asio has no call that returns the time stamp of a datagram.
std::optional<AdapterSocket::Arrival> AdapterSocket::receive(std::int64_t end_ns) const {
  for (;;) {
    Arrival out;
    iovec part{out.bytes.data(), out.bytes.size()};
    alignas(cmsghdr) std::array<char, 128> control{};
    msghdr message{};
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    message.msg_control = control.data();
    message.msg_controllen = control.size();
    const ssize_t size = ::recvmsg(fd_, &message, MSG_DONTWAIT | MSG_TRUNC);
    if (size == 0 || (size < 0 && errno != EAGAIN)) leave();
    if (size > 0) {
      out.size = static_cast<std::size_t>(size);
      out.at_ns = taken_ns(message);
      return out;
    }
    const std::int64_t left_ns = end_ns - now_ns();
    if (left_ns <= 0) return std::nullopt;
    const timespec wait{static_cast<time_t>(left_ns / kSecond_ns), static_cast<long>(left_ns % kSecond_ns)};
    pollfd readable{fd_, POLLIN, 0};  // without a connection this only waits
    ::ppoll(&readable, 1, &wait, nullptr);
  }
}

}  // namespace longreach
