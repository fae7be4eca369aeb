#pragma once
// An attacker on the network who has received all datagrams and knows everything except the secret. It
// generates datagrams that neither side has ever sent to the other, or replays earlier ones.

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "common/core/random.hpp"
#include "common/link/header.hpp"

namespace longreach {

enum class Attack { kForged, kMutated, kReplayed, kReflected, kTruncated, kCount };

constexpr std::string_view to_string(Attack attack) {
  constexpr std::array<std::string_view, 5> kNames = {"forged", "mutated", "replayed", "reflected",
                                                      "truncated"};
  return kNames[static_cast<std::size_t>(attack)];
}

class Intruder {
 public:
  using Datagram = std::vector<std::byte>;

  explicit Intruder(Random random) : random_(random) {}

  /// Records a datagram sent to the attacked side, or sent by it.
  void receive_towards(std::span<const std::byte> datagram) {
    towards_.emplace_back(datagram.begin(), datagram.end());
  }
  void receive_from(std::span<const std::byte> datagram) {
    from_.emplace_back(datagram.begin(), datagram.end());
  }

  /// Generates a datagram for the attacked side. At least one datagram must have been recorded in each
  /// direction.
  Datagram make(Attack attack) {
    switch (attack) {
      case Attack::kForged:
        return forged();
      case Attack::kMutated:
        return mutated(any(towards_));
      case Attack::kReplayed:
        return any(towards_);
      case Attack::kReflected:
        return reflected();
      case Attack::kTruncated:
      case Attack::kCount:
        break;
    }
    Datagram cut = any(towards_);
    cut.resize(below(cut.size()));
    return cut;
  }

 private:
  std::size_t below(std::size_t end) { return static_cast<std::size_t>(random_.next() % end); }
  const Datagram& any(const std::vector<Datagram>& heard) { return heard[below(heard.size())]; }
  void fill(std::span<std::byte> bytes) {
    for (auto& b : bytes) b = static_cast<std::byte>(random_.next());
  }

  /// A datagram with the current session, a future sequence number, and otherwise random bytes.
  Datagram forged() {
    const Datagram& like = any(towards_);
    Header header = std::get<Header>(read_header(like));
    header.sequence +=
        1 + (random_.chance(0.5) ? below(100) : random_.next() % (~std::uint64_t{0} - header.sequence));
    Datagram out(kOverheadBytes + below(kDatagramMaxBytes - kOverheadBytes + 1));
    fill(out);
    write_header(header, out);
    return out;
  }

  /// A genuine datagram in which at least one bit is changed. The sequence number is usually a future one, so
  /// only the authentication tag reveals the change.
  Datagram mutated(Datagram bytes) {
    if (random_.chance(0.8)) {
      Header header = std::get<Header>(read_header(bytes));
      header.sequence += 1 + below(1000);
      write_header(header, bytes);
    }
    const std::size_t changes = below(8);
    for (std::size_t i = 0; i < changes; ++i)
      bytes[below(bytes.size())] = static_cast<std::byte>(random_.next());
    bytes[below(bytes.size() - 18) + 18] ^= std::byte{1} << below(8);
    return bytes;
  }

  /// A datagram that the attacked side itself has sent, unchanged or with a different type and sequence
  /// number.
  Datagram reflected() {
    Datagram bytes = any(from_);
    const Header wanted = std::get<Header>(read_header(any(towards_)));
    if (random_.chance(0.7)) bytes[1] = static_cast<std::byte>(wanted.type);
    if (random_.chance(0.3)) {
      Header header = wanted;
      header.sequence += 1 + below(1000);
      write_header(header, bytes);
    }
    return bytes;
  }

  Random random_;
  std::vector<Datagram> towards_;
  std::vector<Datagram> from_;
};

}  // namespace longreach
