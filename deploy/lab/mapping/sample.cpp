#include "deploy/lab/mapping/sample.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace longreach {
namespace {

double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

/// Twice the rank of each magnitude, in ascending order, so that shared ranks are integers, too.
std::vector<std::size_t> doubled_ranks(const std::vector<double>& ascending) {
  std::vector<std::size_t> ranks;
  for (std::size_t first = 0; first < ascending.size();) {
    std::size_t end = first;
    while (end < ascending.size() && std::abs(ascending[end]) == std::abs(ascending[first])) ++end;
    ranks.insert(ranks.end(), end - first, first + end + 1);
    first = end;
  }
  return ranks;
}

/// Probability of each sum of the positive ranks if all signs are equally likely.
std::vector<double> rank_sum_shares(const std::vector<std::size_t>& ranks) {
  std::vector<double> shares{1.0};
  for (const std::size_t rank : ranks) {
    std::vector<double> next(shares.size() + rank, 0.0);
    for (std::size_t sum = 0; sum < shares.size(); ++sum) {
      next[sum] += 0.5 * shares[sum];
      next[sum + rank] += 0.5 * shares[sum];
    }
    shares = std::move(next);
  }
  return shares;
}

}  // namespace

Spread spread_of(std::span<const double> sample) {
  if (sample.empty()) return {};
  std::vector<double> sorted(sample.begin(), sample.end());
  std::ranges::sort(sorted);
  Spread s{.low = quantile(sorted, 0.25), .median = quantile(sorted, 0.5), .high = quantile(sorted, 0.75)};
  const auto n = static_cast<double>(sorted.size());
  for (const double x : sorted) s.mean += x / n;
  for (const double x : sorted) s.sd += (x - s.mean) * (x - s.mean);
  s.sd = sorted.size() > 1 ? std::sqrt(s.sd / (n - 1.0)) : 0.0;
  return s;
}

double signed_rank_p(std::span<const double> differences) {
  std::vector<double> d;
  std::ranges::copy_if(differences, std::back_inserter(d), [](double x) { return x != 0.0; });
  std::ranges::sort(d, {}, [](double x) { return std::abs(x); });
  const std::vector<std::size_t> ranks = doubled_ranks(d);
  std::size_t positive = 0, all = 0;
  for (std::size_t i = 0; i < d.size(); ++i) {
    all += ranks[i];
    if (d[i] > 0.0) positive += ranks[i];
  }
  const std::vector<double> shares = rank_sum_shares(ranks);
  double p = 0.0;
  for (std::size_t sum = 0; sum <= std::min(positive, all - positive); ++sum) p += 2.0 * shares[sum];
  return std::min(p, 1.0);
}

}  // namespace longreach
