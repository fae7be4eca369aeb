#pragma once
// Which address each session of a peer was last heard from, judged by undamaged headers alone. An old
// sequence does not move a session to another address, so that a replayed datagram cannot. Bounded: the
// session that was heard least recently gives way. Allocates nothing.

#include <array>
#include <asio/ip/udp.hpp>
#include <cstdint>
#include <optional>

#include "common/link/envelope.hpp"

namespace longreach {

class SenderBook {
 public:
  void note(const Header& header, const asio::ip::udp::endpoint& sender);
  [[nodiscard]] std::optional<asio::ip::udp::endpoint> find(std::uint64_t session) const;

 private:
  struct Entry {
    std::uint64_t session = 0;  // 0: free
    std::uint64_t sequence = 0;
    std::uint64_t heard = 0;  // counts notes
    asio::ip::udp::endpoint sender{};
  };
  std::array<Entry, 16> entries_{};
  std::uint64_t notes_ = 0;
};

}  // namespace longreach
