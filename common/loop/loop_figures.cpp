#include "common/loop/loop_figures.hpp"

#include <algorithm>
#include <cmath>

namespace longreach {
namespace {

constexpr double kFirstEdge_ns = 1000.0;
constexpr double kBucketsPerOctave = 4.0;

std::size_t bucket_of(Duration late) {
  const auto ns = static_cast<double>(std::max<Duration::rep>(late.count(), 1));
  const double bucket = std::ceil(kBucketsPerOctave * std::log2(ns / kFirstEdge_ns));
  return static_cast<std::size_t>(std::clamp(bucket, 0.0, static_cast<double>(LoopFigures::kBuckets - 1)));
}

double upper_edge_s(std::size_t bucket) {
  return 1e-9 * kFirstEdge_ns * std::exp2(static_cast<double>(bucket) / kBucketsPerOctave);
}

}  // namespace

void LoopFigures::book(Duration late, Duration busy) {
  ++ticks;
  ++lateness[bucket_of(late)];
  if (late > std::chrono::milliseconds(100)) ++ticks_late_100ms;
  lateness_max = std::max(lateness_max, late);
  busy_max = std::max(busy_max, busy);
}

std::array<std::uint64_t, (LoopFigures::kBuckets + 3) / 4 + 1> LoopFigures::lateness_octaves() const {
  std::array<std::uint64_t, (kBuckets + 3) / 4 + 1> out{};
  for (std::size_t i = 0; i < kBuckets; ++i) out[(i + 3) / 4] += lateness[i];
  return out;
}

double LoopFigures::lateness_quantile_s(double quantile) const {
  if (ticks == 0) return 0.0;
  const double wanted = quantile * static_cast<double>(ticks);
  double seen = 0.0;
  for (std::size_t i = 0; i + 1 < kBuckets; ++i) {
    seen += lateness[i];
    if (seen >= wanted) return std::min(upper_edge_s(i), to_seconds(lateness_max));
  }
  return to_seconds(lateness_max);
}

std::uint64_t Deadlines::advance(Time now) {
  next_ += period_;
  if (now < next_ + period_) return 0;
  const auto skipped = (now - next_) / period_;
  next_ += skipped * period_;
  return static_cast<std::uint64_t>(skipped);
}

}  // namespace longreach
