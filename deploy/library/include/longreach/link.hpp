#pragma once
// A simulated link between two endpoints: datagrams are delayed, lost, duplicated, reordered and corrupted as a real link
// does it, reproducibly from a seed. The caller supplies the time, so that a link runs in real or in virtual time. Equal to
// what both programs apply to received datagrams with --profile.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace longreach {

/// One direction. All times one-way.
struct LinkConditions {
  double delay_s = 0.0;     // 0 to 100
  double jitter_s = 0.0;    // standard deviation, independent a datagram, 0 to 10
  double loss = 0.0;        // mean fraction of lost datagrams, 0 to 1
  double loss_burst = 1.0;  // mean length of a loss burst, datagrams, 1 to 1000
  double duplicate = 0.0, reorder = 0.0, corrupt = 0.0;      // fractions, 0 to 1
  double rate_bit_per_s = 0.0;                               // 0: unlimited
  double blackout_start_s = 0.0, blackout_duration_s = 0.0;  // loss of signal; duration 0: none
};

struct LinkPair {
  LinkConditions up;    // from the master to the slave
  LinkConditions down;  // from the slave to the master
};

/// Conditions of a profile: the name of an installed one, e.g. "moon", or a .txtpb file. Steps, drift and repeated
/// blackouts of a profile are applied by SimulatedLink(profile, seed) only. Throws InputError.
[[gnu::visibility("default")]] LinkPair link_conditions(const std::string& profile);

struct LinkCounts {
  std::uint64_t sent = 0, delivered = 0, lost = 0, duplicated = 0, reordered = 0, corrupted = 0;
};

enum class LinkEnd : std::uint8_t { kMaster, kSlave };

class [[gnu::visibility("default")]] SimulatedLink {
 public:
  static constexpr std::size_t kDatagramMax = 600;  // bytes

  /// Throws InputError for a value outside its range.
  SimulatedLink(const LinkPair& conditions, std::uint64_t seed);
  /// A profile with all its effects. Throws InputError.
  SimulatedLink(const std::string& profile, std::uint64_t seed);
  ~SimulatedLink();
  SimulatedLink(SimulatedLink &&) noexcept;
  SimulatedLink& operator=(SimulatedLink&&) noexcept;

  /// Sends a datagram from an end at the time `now_s`, which must not decrease. Throws InputError for more than
  /// kDatagramMax bytes or a time that is not finite.
  void send(LinkEnd from, double now_s, std::span<const std::byte> datagram);
  /// The next datagram that is due at an end; none: call again later.
  std::optional<std::vector<std::byte>> receive(LinkEnd at, double now_s);
  /// Of the direction towards an end.
  [[nodiscard]] LinkCounts counts(LinkEnd at) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
