#pragma once
// Statistics of a sample of simulated operators: spread, and significance of the difference of two modes.

#include <span>

namespace longreach {

struct Spread {
  double mean = 0.0;
  double sd = 0.0;                             // of the sample, n - 1; 0 for one
  double low = 0.0, median = 0.0, high = 0.0;  // quartiles, interpolated linearly between order statistics
};
/// Zeros for an empty sample.
Spread spread_of(std::span<const double> sample);

/// Wilcoxon's signed-rank test (Biometrics Bulletin 1, 1945) of paired differences: the probability, for
/// equally likely signs, of a rank sum at least as far from its mean. Two-sided, exact by counting; ties
/// share their ranks, zeros are dropped. 1 if none remain.
double signed_rank_p(std::span<const double> differences);

}  // namespace longreach
