// Time of the identification in C++, for a comparison: identify_time FILE N, FILE: N times, N positions, N forces as
// doubles. Prints the minimum processor time of three runs in s, and k.

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <limits>
#include <vector>

#include "deploy/library/include/longreach/identification.hpp"

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const std::size_t count = std::strtoul(argv[2], nullptr, 10);
  std::vector<double> samples(3 * count);
  std::ifstream file(argv[1], std::ios::binary);
  file.read(reinterpret_cast<char*>(samples.data()), static_cast<std::streamsize>(8 * samples.size()));
  if (!file) return 1;
  const std::span<const double> all(samples);
  double least_s = std::numeric_limits<double>::infinity(), k = 0.0;
  for (int i = 0; i < 3; ++i) {
    const std::clock_t start = std::clock();
    k = longreach::identify(all.first(count), all.subspan(count, count), all.last(count)).k.value;
    least_s = std::min(least_s, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  std::printf("%.6f %.17g\n", least_s, k);
  return 0;
}
