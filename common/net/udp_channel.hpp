#pragma once
// Channel over one UDP socket, IPv4 or IPv6. It never blocks, and it does not allocate memory after
// construction.
//
// The master has a fixed peer: it sends to this address, and drops and counts datagrams from other addresses.
// The slave has no fixed peer: it receives from any address and sends to the origin of the newest authentic
// datagram (`answer_to`), from the address that this datagram was sent to, so that a host with several
// addresses is reachable by each. Before the first authentic datagram, it sends nothing.

#include <asio/io_context.hpp>
#include <asio/ip/udp.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "common/wire/channel.hpp"

namespace longreach {

class UdpChannel : public Channel {
 public:
  /// Throws AddressError for an invalid address, std::runtime_error if the socket cannot be bound.
  explicit UdpChannel(const std::string& listen, const std::optional<std::string>& peer = std::nullopt);

  std::optional<std::size_t> receive(std::span<std::byte> buffer) override;
  [[nodiscard]] const Origin& origin() const override { return origin_; }
  void answer_to(const Origin& origin) override;
  void send(std::span<const std::byte> datagram) override;

  [[nodiscard]] std::string local_address() const;
  [[nodiscard]] std::optional<std::string> peer_address() const;
  [[nodiscard]] std::uint64_t unknown_peers() const override { return unknown_peers_; }
  [[nodiscard]] std::uint64_t unsent() const override { return unsent_; }

 private:
  asio::io_context context_{1};
  asio::ip::udp::socket socket_;
  bool fixed_peer_;
  std::optional<Origin> peer_{};
  Origin origin_{};
  std::uint64_t unknown_peers_ = 0;
  std::uint64_t unsent_ = 0;
};

}  // namespace longreach
