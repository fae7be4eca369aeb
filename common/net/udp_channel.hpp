#pragma once
// A channel over one UDP socket, IPv4 or IPv6. Never waits; allocates nothing after construction.
//
// The calling side (master) names its peer: it sends there, and what others send is dropped and counted. The
// answering side (slave) names none: it takes what anybody sends, and answers to where the newest authentic
// datagram came from (`answer_to`). Until then it sends nothing.

#include <asio/io_context.hpp>
#include <asio/ip/udp.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "common/wire/channel.hpp"

namespace longreach {

class UdpChannel : public Channel {
 public:
  /// Throws AddressError for an address that is none, std::runtime_error when the socket cannot be bound.
  explicit UdpChannel(const std::string& listen, const std::optional<std::string>& peer = std::nullopt);

  std::optional<std::size_t> receive(std::span<std::byte> buffer) override;
  [[nodiscard]] const Origin& origin() const override { return origin_; }
  void answer_to(const Origin& origin) override;
  void send(std::span<const std::byte> datagram) override;

  [[nodiscard]] std::string local_address() const;
  [[nodiscard]] std::optional<std::string> peer_address() const;
  [[nodiscard]] std::uint64_t unknown_peers() const {
    return unknown_peers_;
  }                                                               // datagrams of others, dropped
  [[nodiscard]] std::uint64_t unsent() const { return unsent_; }  // the system refused to send them

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
