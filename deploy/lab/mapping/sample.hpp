#pragma once
// What is said of a sample of simulated operators: its spread, and whether two ways of working differ.

#include <span>

namespace longreach {

struct Spread {
  double mean = 0.0;
  double sd = 0.0;                             // of the sample, n - 1; 0 for one
  double low = 0.0, median = 0.0, high = 0.0;  // quartiles, interpolated linearly between order statistics
};
/// Zeros for an empty sample.
Spread spread_of(std::span<const double> sample);

/// Wilcoxon's signed-rank test (Biometrics Bulletin 1, 1945) of paired differences: the probability, if each
/// were as likely to have the other sign, of a rank sum at least as far from its mean as this one. Two-sided,
/// exact by counting; equal sizes share their ranks, zeros are left out. 1 where nothing is left.
double signed_rank_p(std::span<const double> differences);

}  // namespace longreach
