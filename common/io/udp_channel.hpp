#pragma once
// A channel over one UDP socket, IPv4 or IPv6. Never waits; allocates nothing after construction.
//
// The calling side (master) names its peer: it sends there, and what others send is dropped and counted. The
// answering side (slave) names none: it takes what anybody sends, and answers to where the newest authentic
// datagram came from (`answer_to`). Until then it sends nothing.
//
// Datagrams are taken from the system by the batch (recvmmsg). A batch that is not full was all there was,
// and none follows it; what has come since is there at the next call. So a tick with little to read makes one
// system call.

#include <sys/socket.h>

#include <array>
#include <asio/io_context.hpp>
#include <asio/ip/udp.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "common/link/header.hpp"
#include "common/wire/channel.hpp"

namespace longreach {

class UdpChannel : public Channel {
 public:
  /// Throws AddressError for an address that is none, std::runtime_error when the socket cannot be bound.
  explicit UdpChannel(const std::string& listen, const std::optional<std::string>& peer = std::nullopt);

  std::optional<std::size_t> receive(std::span<std::byte> buffer) override;
  [[nodiscard]] Origin origin() const override { return origin_; }
  void answer_to(const Origin& origin) override;
  void send(std::span<const std::byte> datagram) override;

  [[nodiscard]] std::string local_address() const;
  [[nodiscard]] std::optional<std::string> peer_address() const;
  [[nodiscard]] std::uint64_t strangers() const { return strangers_; }  // datagrams of others, dropped
  [[nodiscard]] std::uint64_t unsent() const { return unsent_; }        // the system refused to send them

 private:
  static constexpr std::size_t kBatch = 32;
  /// Room for what came with one system call.
  struct Batch {
    std::array<mmsghdr, kBatch> messages{};
    std::array<iovec, kBatch> parts{};
    std::array<sockaddr_storage, kBatch> senders{};
    std::array<std::array<std::byte, kDatagramMaxBytes>, kBatch> bytes;
    std::size_t count = 0;
    std::size_t next = 0;
  };
  [[nodiscard]] bool refill();

  asio::io_context context_{1};
  asio::ip::udp::socket socket_;
  bool fixed_peer_;
  std::optional<asio::ip::udp::endpoint> peer_{};
  Origin origin_{};
  Batch batch_{};
  std::uint64_t strangers_ = 0;
  std::uint64_t unsent_ = 0;
};

}  // namespace longreach
