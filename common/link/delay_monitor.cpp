#include "common/link/delay_monitor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/link/saturating.hpp"

namespace longreach {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Duration kWindow = seconds(2);
constexpr Duration kSettlingMax = seconds(1);
/// By jitter; anything later does not show that the peer is alive.
constexpr Duration kOvertakenMax = milliseconds(500);
constexpr Duration kRateSpanMin = milliseconds(100);  // a shorter span is not enough to determine a rate
constexpr std::size_t kCapacity = 16384;              // 3 s at 5 kHz

}  // namespace

DelayMonitor::DelayMonitor() : samples_(kCapacity), scratch_(kCapacity) {}

void DelayMonitor::on_datagram(Time now, const Header& header, PeerTime sent, Duration rtt,
                               std::size_t bytes) {
  const auto type = static_cast<std::size_t>(header.type) - 1;
  if (type >= kDatagramTypes) return;
  // loss() needs the samples of its window plus the maximum time that overtaken datagrams may still take.
  while (!samples_.empty() && (samples_.full() || now - samples_.front().received > kWindow + kSettlingMax)) {
    const Sample& old = samples_.front();
    Mark& mark = forgotten_[old.type];
    if (old.sequence > mark.sequence) mark = {old.sequence, old.sent};
    samples_.pop();
  }
  // The sample is filled in place: copying a struct that was just written in parts causes a store-forwarding
  // stall.
  Sample& sample = samples_.extend();
  sample.received = now;
  sample.sent = sent;
  sample.rtt = rtt;
  sample.sequence = header.sequence;
  sample.bytes = static_cast<std::uint32_t>(std::min<std::size_t>(bytes, 65535));
  sample.type = static_cast<std::uint8_t>(type);
  sample.late = header.sequence < newest_[type];
  newest_[type] = std::max(newest_[type], header.sequence);
  if (std::exchange(skips_[type], false)) skipped_[type] = header.sequence - 1;
  if (!first_received_) first_received_ = now;
  // A single prompt datagram among delayed ones must not make the peer appear alive.
  newest_sent_ = std::max(newest_sent_.value_or(sent), sent);
  if (saturating_sub(to_ns(*newest_sent_), to_ns(sent)) <= kOvertakenMax.count()) last_heard_ = now;
}

LinkFigures DelayMonitor::figures(Time now) const {
  LinkFigures f;
  f.silence_s =
      last_heard_ ? std::max(0.0, to_seconds(now - *last_heard_)) : std::numeric_limits<double>::infinity();
  if (echoed_)
    f.age_s = std::max(0.0, 1e-9 * static_cast<double>(saturating_sub(to_ns(now), to_ns(*echoed_))));
  const std::size_t first = first_since(now - kWindow);
  const std::size_t count = samples_.size() - first;
  if (count == 0) return f;

  // Differences from the first transit time are used, so that the unknown clock offset costs no precision.
  const std::int64_t reference = transit_ns(samples_[first].received, samples_[first].sent);
  double sum = 0.0, squares = 0.0, bytes = 0.0;
  std::size_t late = 0, rtts = 0;
  for (std::size_t i = first; i < samples_.size(); ++i) {
    const Sample& s = samples_[i];
    const double x = 1e-9 * static_cast<double>(saturating_sub(transit_ns(s.received, s.sent), reference));
    sum += x;
    squares += x * x;
    bytes += s.bytes;
    if (s.late) ++late;
    if (s.rtt >= Duration{0}) scratch_[rtts++] = s.rtt.count();
  }
  const auto n = static_cast<double>(count);
  f.jitter_s = std::sqrt(std::max(0.0, squares / n - (sum / n) * (sum / n)));
  f.reorder = static_cast<double>(late) / n;
  f.loss = loss(first);

  const Time since = std::max(now - kWindow, samples_.full() ? samples_.front().received : *first_received_);
  const double span_s = to_seconds(std::clamp(now - since, kRateSpanMin, kWindow));
  f.rate_hz = n / span_s;
  f.bytes_per_s = bytes / span_s;

  if (rtts > 0) {
    const auto begin = scratch_.begin(), end = begin + static_cast<std::ptrdiff_t>(rtts);
    const auto middle = begin + static_cast<std::ptrdiff_t>(rtts / 2);
    std::nth_element(begin, middle, end);
    f.rtt_s = 1e-9 * static_cast<double>(*middle);
    f.rtt_min_s = 1e-9 * static_cast<double>(*std::min_element(begin, std::next(middle)));
  }
  return f;
}

void DelayMonitor::clear() {
  samples_.clear();
  newest_.fill(0);
  skips_.fill(false);
  skipped_.fill(0);
  newest_sent_.reset();
  forgotten_.fill({});
  first_received_.reset();
  last_heard_.reset();
  echoed_.reset();
}

std::size_t DelayMonitor::first_since(Time t) const {
  std::size_t low = 0, high = samples_.size();
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (samples_[middle].received > t) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  return low;
}

// Returns how long an overtaken datagram may still be in transit: the transit time of the slowest overtaken
// datagram minus that of the fastest datagram.
Duration DelayMonitor::settling(std::size_t first) const {
  std::int64_t fastest = std::numeric_limits<std::int64_t>::max();
  std::int64_t slowest = std::numeric_limits<std::int64_t>::min();
  for (std::size_t i = first; i < samples_.size(); ++i) {
    const std::int64_t transit = transit_ns(samples_[i].received, samples_[i].sent);
    fastest = std::min(fastest, transit);
    if (samples_[i].late) slowest = std::max(slowest, transit);
  }
  if (slowest <= fastest) return Duration{0};
  return std::min(Duration{saturating_sub(slowest, fastest)}, kSettlingMax);
}

double DelayMonitor::loss(std::size_t first) const {
  std::int64_t end = std::numeric_limits<std::int64_t>::min();
  for (std::size_t i = first; i < samples_.size(); ++i) end = std::max(end, to_ns(samples_[i].sent));
  end = saturating_sub(end, settling(first).count());
  const std::int64_t begin = saturating_sub(end, kWindow.count());

  std::array<Mark, kDatagramTypes> before = forgotten_;  // last one sent before the window
  std::array<Mark, kDatagramTypes> after{};              // first one sent in the window
  std::array<Mark, kDatagramTypes> last{};               // last one sent in the window
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const Sample& s = samples_[i];
    const Mark mark{s.sequence, s.sent};
    if (to_ns(s.sent) <= begin) {
      if (mark.sequence > before[s.type].sequence) before[s.type] = mark;
    } else if (to_ns(s.sent) <= end) {
      if (mark.sequence > last[s.type].sequence) last[s.type] = mark;
      if (after[s.type].sequence == 0 || mark.sequence < after[s.type].sequence) after[s.type] = mark;
    }
  }

  // Numbers up to `base` were sent before the window. The numbers in a gap across the beginning of the window
  // are assumed to have been sent at equal intervals.
  std::array<std::uint64_t, kDatagramTypes> base{};
  double sent = 0.0, came = 0.0;
  for (std::size_t type = 0; type < kDatagramTypes; ++type) {
    const Mark &a = before[type], &b = after[type];
    if (b.sequence == 0) continue;
    base[type] = b.sequence - 1;
    if (a.sequence != 0 && a.sequence < b.sequence) {
      const double share = static_cast<double>(saturating_sub(begin, to_ns(a.sent))) /
                           static_cast<double>(saturating_sub(to_ns(b.sent), to_ns(a.sent)));
      const std::uint64_t gap = b.sequence - a.sequence;
      const double passed = std::floor(static_cast<double>(gap) * std::clamp(share, 0.0, 1.0));
      if (passed < static_cast<double>(gap - 1)) base[type] = a.sequence + static_cast<std::uint64_t>(passed);
    }
    base[type] = std::max(base[type], skipped_[type]);
    if (last[type].sequence > base[type]) sent += static_cast<double>(last[type].sequence - base[type]);
  }
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const Sample& s = samples_[i];
    if (s.sequence > base[s.type] && s.sequence <= last[s.type].sequence) came += 1.0;
  }
  return sent > 0.0 ? std::clamp(1.0 - came / sent, 0.0, 1.0) : 0.0;
}

}  // namespace longreach
