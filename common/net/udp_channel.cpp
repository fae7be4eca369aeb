#include "common/net/udp_channel.hpp"

#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

#include "common/net/address.hpp"

namespace longreach {
namespace {

constexpr int kUnknownPeersPerReceive = 1024;
constexpr int kReceiveBufferBytes = 1 << 20;  // two seconds of 1 kHz while the loop is held up

/// How `endpoint` looks on a socket of the family of `own`: on an IPv6 socket, IPv4 peers are mapped
/// addresses.
asio::ip::udp::endpoint as_seen_by(const asio::ip::udp::endpoint& own,
                                   const asio::ip::udp::endpoint& endpoint) {
  if (!own.address().is_v6() || !endpoint.address().is_v4()) return endpoint;
  return {asio::ip::make_address_v6(asio::ip::v4_mapped, endpoint.address().to_v4()), endpoint.port()};
}

// An Origin is the socket address of the sender, followed by the own address that it sent to.
constexpr std::size_t kSenderBytes = sizeof(sockaddr_in6);
static_assert(sizeof(Origin) == kSenderBytes + sizeof(in6_addr));

Origin to_origin(const asio::ip::udp::endpoint& endpoint) {
  Origin out{};
  std::memcpy(out.data(), endpoint.data(), std::min(endpoint.size(), kSenderBytes));
  return out;
}

bool same_sender(const Origin& a, const Origin& b) {
  return std::equal(a.begin(), a.begin() + kSenderBytes, b.begin());
}

/// A datagram with the buffers of recvmsg and sendmsg.
struct Message {
  Message(Origin& origin, std::span<const std::byte> datagram)
      : bytes{const_cast<std::byte*>(datagram.data()), datagram.size()} {
    header.msg_name = origin.data();
    header.msg_namelen = kSenderBytes;
    header.msg_iov = &bytes;
    header.msg_iovlen = 1;
    header.msg_control = control.data();
    header.msg_controllen = control.size();
  }

  /// Stores the own address that a received datagram was sent to.
  void read_own_address(Origin& origin) {
    for (cmsghdr* one = CMSG_FIRSTHDR(&header); one != nullptr; one = CMSG_NXTHDR(&header, one)) {
      if (one->cmsg_level == IPPROTO_IP && one->cmsg_type == IP_PKTINFO)
        std::memcpy(origin.data() + kSenderBytes,
                    &reinterpret_cast<in_pktinfo*>(CMSG_DATA(one))->ipi_spec_dst, sizeof(in_addr));
      if (one->cmsg_level == IPPROTO_IPV6 && one->cmsg_type == IPV6_PKTINFO)
        std::memcpy(origin.data() + kSenderBytes, &reinterpret_cast<in6_pktinfo*>(CMSG_DATA(one))->ipi6_addr,
                    sizeof(in6_addr));
    }
  }

  /// Sends from the own address in `origin`, or, if it has none, from the one that the system selects.
  void choose_own_address(const Origin& origin) {
    const bool v6 = reinterpret_cast<const sockaddr*>(origin.data())->sa_family == AF_INET6;
    const auto own = std::span(origin).subspan(kSenderBytes);
    if (std::ranges::all_of(own, [](std::uint8_t byte) { return byte == 0; })) {
      header.msg_controllen = 0;
      return;
    }
    const std::size_t size = v6 ? sizeof(in6_pktinfo) : sizeof(in_pktinfo);
    header.msg_controllen = CMSG_SPACE(size);
    cmsghdr* one = CMSG_FIRSTHDR(&header);
    one->cmsg_level = v6 ? IPPROTO_IPV6 : IPPROTO_IP;
    one->cmsg_type = v6 ? IPV6_PKTINFO : IP_PKTINFO;
    one->cmsg_len = CMSG_LEN(size);
    in_pktinfo from4{};
    in6_pktinfo from6{};
    std::memcpy(&from4.ipi_spec_dst, own.data(), sizeof(in_addr));
    std::memcpy(&from6.ipi6_addr, own.data(), sizeof(in6_addr));
    std::memcpy(CMSG_DATA(one), v6 ? static_cast<const void*>(&from6) : &from4, size);
  }

  iovec bytes;
  alignas(cmsghdr) std::array<char, 2 * CMSG_SPACE(sizeof(in6_pktinfo))> control{};
  msghdr header{};
};

}  // namespace

UdpChannel::UdpChannel(const std::string& listen, const std::optional<std::string>& peer)
    : socket_(context_), fixed_peer_(peer.has_value()) {
  const auto own = parse_udp_address(listen);
  if (peer) {
    const auto other = parse_udp_address(*peer);
    if (other.port() == 0) throw AddressError("'" + *peer + "' has no port to send to; write address:port");
    if (other.address().is_v6() && own.address().is_v4()) {
      throw AddressError("'" + *peer + "' cannot be reached from '" + listen +
                         "': one is IPv6, the other IPv4; listen on [::]:0 instead");
    }
    peer_ = to_origin(as_seen_by(own, other));
  }
  asio::error_code error;
  socket_.open(own.protocol(), error);
  if (!error) socket_.bind(own, error);
  if (!error) socket_.non_blocking(true, error);
  if (error) {
    throw std::runtime_error("cannot listen on UDP " + listen + ": " + error.message() +
                             "; set link.listen to another address, or stop the program that is using "
                             "this one");
  }
  const int yes = 1;
  const bool v6 = own.address().is_v6();
  (void)::setsockopt(socket_.native_handle(), v6 ? IPPROTO_IPV6 : IPPROTO_IP,
                     v6 ? IPV6_RECVPKTINFO : IP_PKTINFO, &yes, sizeof yes);
  // Less than asked for is fine.
  socket_.set_option(asio::socket_base::receive_buffer_size(kReceiveBufferBytes), error);
}

// Datagrams pass the socket of Asio by its native handle, because Asio has no call for packet information, which
// states to which of several own addresses a datagram was sent. Asio would make the same system calls: one for each
// datagram, and one that finds no further datagram.
std::optional<std::size_t> UdpChannel::receive(std::span<std::byte> buffer) {
  for (int i = 0; i < kUnknownPeersPerReceive; ++i) {
    Origin sender{};
    Message message(sender, buffer);
    const ssize_t size = ::recvmsg(socket_.native_handle(), &message.header, MSG_DONTWAIT | MSG_TRUNC);
    if (size < 0) return std::nullopt;
    if (fixed_peer_ && !same_sender(sender, *peer_)) {
      ++unknown_peers_;
      continue;
    }
    message.read_own_address(sender);
    origin_ = sender;
    return static_cast<std::size_t>(size);
  }
  return std::nullopt;
}

void UdpChannel::send(std::span<const std::byte> datagram) {
  if (!peer_) return;
  Message message(*peer_, datagram);
  message.choose_own_address(*peer_);
  if (::sendmsg(socket_.native_handle(), &message.header, MSG_DONTWAIT | MSG_NOSIGNAL) < 0) ++unsent_;
}

void UdpChannel::answer_to(const Origin& origin) {
  if (fixed_peer_) return;
  peer_ = origin == kNowhere ? std::nullopt : std::optional(origin);
}

std::string UdpChannel::local_address() const {
  asio::error_code error;
  return to_string(socket_.local_endpoint(error));
}

std::optional<std::string> UdpChannel::peer_address() const {
  if (!peer_) return std::nullopt;
  asio::ip::udp::endpoint peer;
  std::memcpy(peer.data(), peer_->data(), std::min(peer.capacity(), kSenderBytes));
  return to_string(peer);
}

}  // namespace longreach
