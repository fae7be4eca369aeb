#pragma once
// Statistics of a sample of simulated operators: its spread, and the significance of the difference between
// two modes.

#include <span>

namespace longreach {

struct Spread {
  double mean = 0.0;
  double sd = 0.0;                             // sample standard deviation (n - 1); 0 for a single value
  double low = 0.0, median = 0.0, high = 0.0;  // quartiles, linearly interpolated
};
/// All values are zero for an empty sample.
Spread spread_of(std::span<const double> sample);

/// Wilcoxon signed-rank test (Biometrics Bulletin 1, 1945) for paired differences. Returns the exact
/// two-sided p-value: the probability, if both signs are equally likely, that the rank sum is at least as far
/// from its mean. Tied values share their ranks, and zero differences are dropped. Returns 1 if no
/// differences remain.
double signed_rank_p(std::span<const double> differences);

}  // namespace longreach
