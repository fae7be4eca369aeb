#include "common/net/udp_channel.hpp"

#include <sys/socket.h>

#include <algorithm>
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

Origin to_origin(const asio::ip::udp::endpoint& endpoint) {
  Origin out{};
  std::memcpy(out.data(), endpoint.data(), std::min(endpoint.size(), out.size()));
  return out;
}

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
  // Less than asked for is fine.
  socket_.set_option(asio::socket_base::receive_buffer_size(kReceiveBufferBytes), error);
}

// Not by Asio: it does not report the true size of what was cut.
std::optional<std::size_t> UdpChannel::receive(std::span<std::byte> buffer) {
  for (int i = 0; i < kUnknownPeersPerReceive; ++i) {
    Origin sender{};
    socklen_t length = sizeof sender;
    const ssize_t size =
        ::recvfrom(socket_.native_handle(), buffer.data(), buffer.size(), MSG_DONTWAIT | MSG_TRUNC,
                   reinterpret_cast<sockaddr*>(sender.data()), &length);
    if (size < 0) return std::nullopt;
    if (fixed_peer_ && sender != *peer_) {
      ++unknown_peers_;
      continue;
    }
    origin_ = sender;
    return static_cast<std::size_t>(size);
  }
  return std::nullopt;
}

void UdpChannel::send(std::span<const std::byte> datagram) {
  if (!peer_) return;
  const ssize_t sent =
      ::sendto(socket_.native_handle(), datagram.data(), datagram.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
               reinterpret_cast<const sockaddr*>(peer_->data()), sizeof(Origin));
  if (sent < 0) ++unsent_;
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
  std::memcpy(peer.data(), peer_->data(), std::min(peer.capacity(), peer_->size()));
  return to_string(peer);
}

}  // namespace longreach
