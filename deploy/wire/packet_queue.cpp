#include "deploy/wire/packet_queue.hpp"

#include <arpa/inet.h>
#include <libnetfilter_queue/libnetfilter_queue.h>
#include <linux/netfilter.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>

namespace longreach {
namespace {

constexpr std::uint32_t kPacketsMax = 65'536;  // under way; what comes beyond, the kernel drops
constexpr unsigned kReceiveBufferBytes = 8U << 20U;
constexpr auto kLongestWait = std::chrono::milliseconds(100);

[[noreturn]] void refuse(const std::string& what) {
  throw std::runtime_error(
      what + " (" + std::strerror(errno) +
      "): this needs CAP_NET_ADMIN in the network namespace and the kernel's "
      "nfnetlink_queue; run as root, after `modprobe nfnetlink_queue` if it is a module");
}

}  // namespace

void PacketQueue::Close::operator()(nfq_handle* handle) const { nfq_close(handle); }

PacketQueue::PacketQueue(const WireConfig& config, std::uint16_t number)
    : config_(config),
      delay_(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(config.delay_s))),
      random_(config.seed),
      handle_(nfq_open()) {
  if (!handle_) refuse("the kernel's packet queues cannot be opened");
  const auto callback = [](nfq_q_handle*, nfgenmsg*, nfq_data* packet, void* self) {
    if (const auto* header = nfq_get_msg_packet_hdr(packet))
      static_cast<PacketQueue*>(self)->take(ntohl(header->packet_id));
    return 0;
  };
  queue_ = nfq_create_queue(handle_.get(), number, callback, this);
  if (queue_ == nullptr) refuse("packet queue " + std::to_string(number) + " cannot be created");
  // The kernel keeps the packets; only their IDs are passed to this process.
  if (nfq_set_mode(queue_, NFQNL_COPY_META, 0) < 0 || nfq_set_queue_maxlen(queue_, kPacketsMax) < 0)
    refuse("the packet queue cannot be configured");
  nfnl_rcvbufsiz(nfq_nfnlh(handle_.get()), kReceiveBufferBytes);
}

PacketQueue::~PacketQueue() {
  if (queue_ != nullptr) nfq_destroy_queue(queue_);
}

void PacketQueue::take(std::uint32_t id) {
  ++packets_;
  if (std::bernoulli_distribution(config_.loss)(random_)) {
    ++dropped_;
    nfq_set_verdict(queue_, id, NF_DROP, 0, nullptr);
    return;
  }
  queued_datagrams_.push_back({Clock::now() + delay_, id});
}

void PacketQueue::step() {
  using std::chrono::nanoseconds;
  const auto now = Clock::now();
  nanoseconds wait = kLongestWait;
  if (!queued_datagrams_.empty())
    wait = std::clamp<nanoseconds>(queued_datagrams_.front().due - now, nanoseconds(0), wait);
  timespec timeout{};
  timeout.tv_nsec = static_cast<long>(wait.count());
  pollfd socket{nfq_fd(handle_.get()), POLLIN, 0};
  if (::ppoll(&socket, 1, &timeout, nullptr) > 0) read();
  release();
}

void PacketQueue::read() {
  std::array<char, 65'536> bytes{};
  const ssize_t size = ::recv(nfq_fd(handle_.get()), bytes.data(), bytes.size(), MSG_DONTWAIT);
  // ENOBUFS: the kernel has dropped packets for lack of space, which counts as loss.
  if (size > 0) nfq_handle_packet(handle_.get(), bytes.data(), static_cast<int>(size));
}

void PacketQueue::release() {
  const auto now = Clock::now();
  while (!queued_datagrams_.empty() && queued_datagrams_.front().due <= now) {
    nfq_set_verdict(queue_, queued_datagrams_.front().id, NF_ACCEPT, 0, nullptr);
    queued_datagrams_.pop_front();
  }
}

}  // namespace longreach
