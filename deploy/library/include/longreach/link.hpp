#pragma once
// A simulated link between two endpoints: delays, loses, duplicates, reorders and corrupts datagrams as a
// real link would, reproducibly for a given seed. The caller supplies the time, so that a link can run in
// real or virtual time. Both programs apply the same model to received datagrams with --profile.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace longreach {

/// Conditions in one direction. All times are one-way.
struct LinkConditions {
  double delay_s = 0.0;     // mean delay, 0 to 100
  double jitter_s = 0.0;    // standard deviation, independent for each datagram, 0 to 10
  double loss = 0.0;        // mean fraction of lost datagrams, 0 to 1
  double loss_burst = 1.0;  // mean length of a loss burst, datagrams, 1 to 1000
  double duplicate = 0.0, reorder = 0.0, corrupt = 0.0;      // fractions, 0 to 1
  double rate_bit_per_s = 0.0;                               // 0: unlimited
  double blackout_start_s = 0.0, blackout_duration_s = 0.0;  // total loss of datagrams; duration 0: none
};

struct LinkPair {
  LinkConditions up;    // from the master to the slave
  LinkConditions down;  // from the slave to the master
};

/// Returns the conditions of a profile: the name of an installed profile, e.g. "moon", or a .txtpb file. They do
/// not include steps, drift and repeated blackouts; use SimulatedLink(profile, seed) for these. Throws InputError.
[[gnu::visibility("default")]] LinkPair link_conditions(const std::string& profile);

struct LinkCounts {
  std::uint64_t sent = 0, delivered = 0, lost = 0, duplicated = 0, reordered = 0, corrupted = 0;
};

enum class LinkEnd : std::uint8_t { kMaster, kSlave };

class [[gnu::visibility("default")]] SimulatedLink {
 public:
  static constexpr std::size_t kDatagramMax = 600;  // maximum size of a datagram, bytes

  /// Throws InputError for a value outside its range.
  SimulatedLink(const LinkPair& conditions, std::uint64_t seed);
  /// Creates a link with all effects of a profile. Throws InputError.
  SimulatedLink(const std::string& profile, std::uint64_t seed);
  ~SimulatedLink();
  SimulatedLink(SimulatedLink &&) noexcept;
  SimulatedLink& operator=(SimulatedLink&&) noexcept;

  /// Sends a datagram from an end at the time `now_s`, which must not decrease. Throws InputError if the
  /// datagram exceeds kDatagramMax bytes or the time is not finite.
  void send(LinkEnd from, double now_s, std::span<const std::byte> datagram);
  /// Returns the next datagram that is due at an end, or std::nullopt if none is due yet.
  std::optional<std::vector<std::byte>> receive(LinkEnd at, double now_s);
  /// Returns the counts of the direction towards an end.
  [[nodiscard]] LinkCounts counts(LinkEnd at) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace longreach
