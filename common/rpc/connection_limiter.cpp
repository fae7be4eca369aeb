#include "common/rpc/connection_limiter.hpp"

#include <linux/tcp.h>
#include <malloc.h>
#include <netdb.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <utility>

#include "common/config/host_and_port.hpp"
#include "common/rpc/rpc_refusals.hpp"

namespace longreach {
namespace {

constexpr auto kLook = std::chrono::milliseconds(50);  // how soon an end is noticed
constexpr std::size_t kAcceptedAtOnce = 64;
constexpr std::uint64_t kProvenBytes = 1000;  // a certificate and its signature have more
constexpr std::size_t kGivenBackBy = 32;      // connections that ended
constexpr const char* kNoDescriptors =
    "no file descriptors are left: close unused connections, or raise the limit with `ulimit -n` or "
    "LimitNOFILE=";

int bound(const addrinfo& at) {
  const int fd = ::socket(at.ai_family, at.ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, at.ai_protocol);
  if (fd < 0) return -1;
  const int yes = 1;
  ::setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);  // after a restart; two at once still fail
  if (::bind(fd, at.ai_addr, at.ai_addrlen) == 0 && ::listen(fd, SOMAXCONN) == 0) return fd;
  ::close(fd);
  return -1;
}

std::array<unsigned char, 16> host_of(int fd) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  std::array<unsigned char, 16> host{};
  if (::getpeername(fd, reinterpret_cast<sockaddr*>(&address), &size) != 0) return host;
  if (address.ss_family == AF_INET6)
    std::memcpy(host.data(), &reinterpret_cast<const sockaddr_in6&>(address).sin6_addr, sizeof(in6_addr));
  else
    std::memcpy(host.data(), &reinterpret_cast<const sockaddr_in&>(address).sin_addr, sizeof(in_addr));
  return host;
}

/// "192.0.2.9:4711"; "connection" when it has gone.
std::string address_of(int fd) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  std::array<char, NI_MAXHOST> host{};
  std::array<char, NI_MAXSERV> port{};
  auto* any = reinterpret_cast<sockaddr*>(&address);
  if (::getpeername(fd, any, &size) != 0 || ::getnameinfo(any, size, host.data(), host.size(), port.data(),
                                                          port.size(), NI_NUMERICHOST | NI_NUMERICSERV) != 0)
    return "connection";
  const std::string name = host.data();
  return (name.find(':') == std::string::npos ? name : "[" + name + "]") + ":" + port.data();
}

std::size_t inside_max() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return ConnectionLimiter::kInsideMax;
  return std::min<std::size_t>(ConnectionLimiter::kInsideMax, limit.rlim_cur / 2);
}

}  // namespace

ListeningSocket::ListeningSocket(const std::string& listen) {
  const auto parts = host_and_port(listen);
  if (!parts) return;
  addrinfo wanted{};
  wanted.ai_family = AF_UNSPEC;
  wanted.ai_socktype = SOCK_STREAM;
  wanted.ai_flags = AI_PASSIVE;
  addrinfo* found = nullptr;
  if (::getaddrinfo(parts->host.c_str(), std::to_string(parts->port).c_str(), &wanted, &found) != 0) return;
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> all(found, &::freeaddrinfo);
  for (const addrinfo* one = found; one != nullptr && fd_ < 0; one = one->ai_next) fd_ = bound(*one);
}

ListeningSocket::~ListeningSocket() {
  if (fd_ >= 0) ::close(fd_);
}

int ListeningSocket::port() const {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  if (::getsockname(fd_, reinterpret_cast<sockaddr*>(&address), &size) != 0) return 0;
  return ntohs(address.ss_family == AF_INET6 ? reinterpret_cast<const sockaddr_in6&>(address).sin6_port
                                             : reinterpret_cast<const sockaddr_in&>(address).sin_port);
}

ConnectionLimiter::ConnectionLimiter(const ListeningSocket& socket, std::function<void(int)> let_in)
    : listener_(socket.fd()), let_in_(std::move(let_in)), thread_([this] { run(); }) {}

ConnectionLimiter::~ConnectionLimiter() {
  ended_ = true;
  thread_.join();
  for (const Silent& one : silent_) ::close(one.fd);
}

void ConnectionLimiter::run() {
  while (!ended_) {
    wait();
    accept_all();
    receive();
    expire();
    count_inside();
  }
}

void ConnectionLimiter::wait() const {
  std::vector<pollfd> all{{listener_, POLLIN, 0}};
  for (const Silent& one : silent_) all.push_back({one.fd, POLLIN, 0});
  (void)::poll(all.data(), all.size(), static_cast<int>(kLook.count()));
}

void ConnectionLimiter::accept_all() {
  for (std::size_t i = 0; i < kAcceptedAtOnce && accept_one(); ++i) {
  }
}

bool ConnectionLimiter::accept_one() {
  const int fd = ::accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (fd < 0 && (errno == EMFILE || errno == ENFILE)) {
    if (!silent_.empty()) {
      close_oldest(kNoDescriptors);
      return true;
    }
    note_rpc_refusal("connection", kNoDescriptors);
    std::this_thread::sleep_for(kLook);
    return false;
  }
  if (fd < 0) return errno == ECONNABORTED || errno == EINTR;
  const int yes = 1;
  ::setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
  silent_.push_back({fd, Clock::now()});
  // What has come with it is heard before others make it the oldest.
  if (silent_.size() <= kSilentMax) return true;
  receive();
  while (silent_.size() > kSilentMax - kAcceptedAtOnce) close_oldest("too many connections without data");
  return true;
}

/// Lets in who has said something.
void ConnectionLimiter::receive() {
  std::deque<Silent> still;
  for (const Silent& one : silent_) {
    char first = 0;
    const ssize_t n = ::recv(one.fd, &first, 1, MSG_PEEK);
    if (n > 0) {
      let_in(one.fd);
    } else if (n < 0 && (errno == EAGAIN || errno == EINTR)) {
      still.push_back(one);
    } else {
      ::close(one.fd);
    }
  }
  silent_ = std::move(still);
}

void ConnectionLimiter::expire() {
  while (!silent_.empty() && Clock::now() - silent_.front().since > kSilent)
    close_oldest("no data arrived on the connection");
}

void ConnectionLimiter::let_in(int fd) {
  struct stat now {};
  Inside who{.fd = fd, .socket = ::fstat(fd, &now) == 0 ? now.st_ino : 0, .host = host_of(fd)};
  if (crowded(who) != nullptr) count_inside();
  if (crowded(who) != nullptr) shut_unproven(who);
  if (const char* why = crowded(who)) {
    note_rpc_refusal(address_of(fd), why);
    ::close(fd);
    return;
  }
  inside_.push_back(who);
  let_in_(fd);
}

/// Why there is no room; null: there is.
const char* ConnectionLimiter::crowded(const Inside& who) const {
  const std::size_t most = inside_max();
  if (inside_.size() >= most) return "too many connections";
  const auto of_host = std::ranges::count(inside_, who.host, &Inside::host);
  return static_cast<std::size_t>(of_host) >= most / 2 ? "too many connections from one host" : nullptr;
}

void ConnectionLimiter::shut_unproven(const Inside& in_favour_of) {
  const bool full = inside_.size() >= inside_max();
  const auto found = std::ranges::find_if(inside_, [&](const Inside& one) {
    if (!full && one.host != in_favour_of.host) return false;
    tcp_info info{};
    socklen_t size = sizeof info;
    return ::getsockopt(one.fd, IPPROTO_TCP, TCP_INFO, &info, &size) == 0 &&
           info.tcpi_bytes_received < kProvenBytes;
  });
  if (found == inside_.end()) return;
  note_rpc_refusal(address_of(found->fd), "the handshake timed out");
  ::shutdown(found->fd, SHUT_RDWR);  // its owner closes it then
  inside_.erase(found);
}

void ConnectionLimiter::close_oldest(const char* why) {
  note_rpc_refusal(address_of(silent_.front().fd), why);
  ::close(silent_.front().fd);
  silent_.pop_front();
}

void ConnectionLimiter::count_inside() {
  std::erase_if(inside_, [](const Inside& one) {
    struct stat now {};
    return ::fstat(one.fd, &now) != 0 || now.st_ino != one.socket;
  });
  most_inside_ = std::max(most_inside_, inside_.size());
  if (most_inside_ < inside_.size() + kGivenBackBy) return;
  most_inside_ = inside_.size();
  ::malloc_trim(0);  // gives back what is not locked
}

}  // namespace longreach
