#pragma once
// Seeded random streams. The only source of randomness in the system; a stream is named by (seed, path of
// child names), so that adding a consumer never changes what another one draws. Generator: xoshiro256++
// (Blackman, Vigna 2019), seeded through SplitMix64. Normal deviates: Marsaglia's polar method, own code
// because std::normal_distribution is not the same on every library.

#include <array>
#include <cstdint>
#include <string_view>

namespace longreach {

class Random {
 public:
  explicit Random(std::uint64_t seed);

  /// An independent stream named by `name`; does not advance this one.
  [[nodiscard]] Random child(std::string_view name) const;

  std::uint64_t next();  // uniform over all 64-bit values
  double uniform();      // [0, 1)
  double uniform(double low, double high);
  double normal();  // mean 0, standard deviation 1
  bool chance(double probability) { return uniform() < probability; }

 private:
  std::uint64_t seed_;
  std::array<std::uint64_t, 4> state_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace longreach
