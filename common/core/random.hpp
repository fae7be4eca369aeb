#pragma once
// Seeded random streams, the only source of randomness in the system. A stream is identified by its seed and
// the path of child names, so adding a consumer never changes the numbers that other consumers draw. The
// generator is xoshiro256++ (Blackman, Vigna 2019), seeded by SplitMix64. Normal deviates use Marsaglia's
// polar method, implemented here because std::normal_distribution differs between standard libraries.

#include <array>
#include <cstdint>
#include <string_view>

namespace longreach {

class Random {
 public:
  explicit Random(std::uint64_t seed);

  /// Returns an independent stream named `name` without advancing this one.
  [[nodiscard]] Random child(std::string_view name) const;

  std::uint64_t next();  // uniform over all 64-bit values
  double uniform();      // uniform in [0, 1)
  /// Returns a number uniform in [low, high).
  double uniform(double low, double high);
  /// Returns a number in [low, high) whose logarithm is uniform; 0 < low <= high.
  double log_uniform(double low, double high);
  double normal();  // mean 0, standard deviation 1
  /// Returns true with the given probability.
  bool chance(double probability) { return uniform() < probability; }

 private:
  std::uint64_t seed_;
  std::array<std::uint64_t, 4> state_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace longreach
