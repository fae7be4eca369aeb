#include "deploy/wire/packet_relay.hpp"

#include <fcntl.h>
#include <linux/if.h>
#include <linux/if_tun.h>
#include <poll.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>

namespace longreach {
namespace {

constexpr std::size_t kQueuedDatagramsMax = 65'536;  // under way, each way; what comes beyond is dropped
constexpr auto kRelayWait = std::chrono::milliseconds(100);

Descriptor opened(const std::string& file, int flags) {
  const int number = ::open(file.c_str(), flags | O_CLOEXEC);
  if (number < 0) throw std::runtime_error(file + ": " + std::strerror(errno));
  return Descriptor(number);
}

void enter(const Descriptor& network_namespace, const std::string& whose) {
  if (::setns(network_namespace.number(), CLONE_NEWNET) != 0)
    throw std::runtime_error("cannot enter the network namespace of " + whose + ": " + std::strerror(errno));
}

/// One end of the cable, in the network namespace of a process.
Descriptor cable_end(pid_t host) {
  const std::string process = std::to_string(host);
  const Descriptor here = opened("/proc/self/ns/net", O_RDONLY);
  const Descriptor there = opened("/proc/" + process + "/ns/net", O_RDONLY);
  enter(there, "process " + process);
  // An interface is made in the namespace in which its file was opened.
  Descriptor tunnel = opened("/dev/net/tun", O_RDWR | O_NONBLOCK);
  ifreq request{};
  request.ifr_flags = IFF_TUN | IFF_NO_PI;
  std::strncpy(request.ifr_name, "cable", IFNAMSIZ - 1);
  const bool made = ::ioctl(tunnel.number(), TUNSETIFF, &request) == 0;
  const std::string why = std::strerror(errno);
  enter(here, "this process");
  if (!made)
    throw std::runtime_error("cannot create the network interface of the cable for process " + process +
                             ": " + why);
  return tunnel;
}

}  // namespace

Descriptor::~Descriptor() {
  if (number_ >= 0) ::close(number_);
}

PacketRelay::PacketRelay(const WireConfig& config, std::array<pid_t, 2> hosts)
    : config_(config),
      delay_(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(config.delay_s))),
      random_(config.seed),
      cable_{cable_end(hosts[0]), cable_end(hosts[1])} {}

void PacketRelay::read(std::size_t from) {
  std::array<std::byte, 65'536> packet;
  for (;;) {
    const ssize_t size = ::read(cable_[from].number(), packet.data(), packet.size());
    if (size <= 0) return;
    ++packets_;
    if (std::bernoulli_distribution(config_.loss)(random_) ||
        queued_datagrams_[from].size() >= kQueuedDatagramsMax) {
      ++dropped_;
      continue;
    }
    queued_datagrams_[from].push_back({Clock::now() + delay_, {packet.begin(), packet.begin() + size}});
  }
}

void PacketRelay::release(std::size_t from) {
  const auto now = Clock::now();
  auto& queued_datagrams = queued_datagrams_[from];
  while (!queued_datagrams.empty() && queued_datagrams.front().due <= now) {
    const auto& packet = queued_datagrams.front().packet;
    // A packet that the other end does not accept counts as loss.
    if (::write(cable_[1 - from].number(), packet.data(), packet.size()) < 0) ++dropped_;
    queued_datagrams.pop_front();
  }
}

void PacketRelay::step() {
  using std::chrono::nanoseconds;
  const auto now = Clock::now();
  nanoseconds wait = kRelayWait;
  for (const auto& queued_datagrams : queued_datagrams_)
    if (!queued_datagrams.empty())
      wait = std::clamp<nanoseconds>(queued_datagrams.front().due - now, nanoseconds(0), wait);
  timespec timeout{};
  timeout.tv_nsec = static_cast<long>(wait.count());
  std::array<pollfd, 2> ends{{{cable_[0].number(), POLLIN, 0}, {cable_[1].number(), POLLIN, 0}}};
  ::ppoll(ends.data(), ends.size(), &timeout, nullptr);
  for (const std::size_t end : {std::size_t{0}, std::size_t{1}}) {
    read(end);
    release(end);
  }
}

}  // namespace longreach
