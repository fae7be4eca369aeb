#include "common/safety/delay_watch.hpp"

#include <algorithm>

namespace longreach {
namespace {

using std::chrono::milliseconds;

constexpr Duration kLeastWindow = milliseconds(500);
constexpr Duration kSpanMin = milliseconds(250);  // a few outliers are then a minority
constexpr Duration kLook = milliseconds(20);
constexpr std::size_t kSamplesMin = 3;
constexpr double kRise_s_per_s = 1e-3;  // permitted rise of the minimum: clocks drift, and paths lengthen
constexpr std::size_t kLeastCapacity = 4096;  // 0.5 s at 8 kHz

}  // namespace

DelayWatch::DelayWatch() : samples_(kLeastCapacity), scratch_(kLeastCapacity) {}

void DelayWatch::rebase() { least_s_ = median_s_; }

void DelayWatch::add(Time now, Duration rtt) {
  if (rtt >= Duration{0}) samples_.push({now, rtt.count()});
}

void DelayWatch::step(Time now) {
  if (looked_at_ && now - *looked_at_ < kLook) return;
  const double passed_s = looked_at_ ? to_seconds(now - *looked_at_) : 0.0;
  looked_at_ = now;
  median_s_ = median(now);
  if (least_s_) *least_s_ += kRise_s_per_s * passed_s;
  if (median_s_) least_s_ = std::min(least_s_.value_or(*median_s_), *median_s_);
}

std::optional<double> DelayWatch::median(Time now) {
  while (!samples_.empty() && now - samples_.front().at > kLeastWindow) samples_.pop();
  if (samples_.size() < kSamplesMin || samples_.back().at - samples_.front().at < kSpanMin)
    return std::nullopt;
  for (std::size_t i = 0; i < samples_.size(); ++i) scratch_[i] = samples_[i].rtt_ns;
  const auto begin = scratch_.begin(), end = begin + static_cast<std::ptrdiff_t>(samples_.size());
  const auto middle = begin + static_cast<std::ptrdiff_t>(samples_.size() / 2);
  std::nth_element(begin, middle, end);
  return 1e-9 * static_cast<double>(*middle);
}

}  // namespace longreach
