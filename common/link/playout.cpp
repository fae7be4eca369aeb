#include "common/link/playout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/link/saturating.hpp"

namespace longreach {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr std::size_t kGoals = 8192;
constexpr std::size_t kLatenessSamples = 4096;  // 5 s at 800 Hz; less at higher rates
constexpr Duration kLatenessWindow = seconds(5);
constexpr Duration kQuantilePeriod = milliseconds(100);
// A larger decrease of the transit time means that the link has changed; it is not jitter.
constexpr Duration kLinkStep = milliseconds(250);
constexpr int kSlewDivisor = 20;  // 0.05 s/s

}  // namespace

Playout::Playout(const PlayoutConfig& config)
    : config_(config), entries_(kGoals), lateness_(kLatenessSamples), scratch_(kLatenessSamples) {}

void Playout::push(Time received, PeerTime sent, std::uint64_t sequence, const Vector3& goal) {
  if (sequence == 0 || !goal.allFinite() || !insert({sequence, sent, goal})) return;
  const bool first = entries_.size() == 1;
  const Duration before = offset();
  offset_.on_datagram(received, sent);
  const Duration fall{saturating_sub(before.count(), offset().count())};
  book_lateness(received, sent);
  if (first) {
    lag_ = Duration{saturating_add(offset().count(), wanted_delay(received).count())};
  } else if (fall > kLinkStep) {
    lag_ = Duration{saturating_sub(lag_.count(), fall.count())};
  }
}

std::optional<PlayoutGoal> Playout::play(Time now) {
  if (entries_.empty()) return std::nullopt;
  adapt(now);
  const PlayoutGoal goal = goal_at(PeerTime{Duration{saturating_sub(to_ns(now), lag_.count())}});
  if (!played_ || goal.sequence > played_->sequence) played_ = goal;
  return played_;
}

double Playout::delay_s() const {
  return std::max(0.0, to_seconds(Duration{saturating_sub(lag_.count(), offset().count())}));
}

void Playout::clear() {
  offset_.clear();
  entries_.clear();
  lateness_.clear();
  lag_ = quantile_ = Duration{0};
  quantile_at_.reset();
  stepped_at_.reset();
  played_.reset();
}

// Returns false for a duplicate, and for an entry that is older than all entries of a full store.
bool Playout::insert(const Entry& entry) {
  std::size_t place = entries_.size();
  while (place > 0 && entries_[place - 1].sequence > entry.sequence) --place;
  if (place > 0 && entries_[place - 1].sequence == entry.sequence) return false;
  if (entries_.full()) {
    if (place == 0) return false;
    --place;
  }
  entries_.push(entry);
  for (std::size_t i = entries_.size() - 1; i > place; --i) entries_[i] = entries_[i - 1];
  entries_[place] = entry;
  return true;
}

void Playout::book_lateness(Time received, PeerTime sent) {
  while (!lateness_.empty() && received - lateness_.front().received > kLatenessWindow) lateness_.pop();
  const std::int64_t transit = transit_ns(received, sent);
  lateness_.push({received, transit, saturating_sub(transit, offset().count())});
}

void Playout::adapt(Time now) {
  const Duration dt =
      stepped_at_ ? std::clamp(now - *stepped_at_, Duration{0}, Duration{seconds(1)}) : Duration{0};
  stepped_at_ = now;
  const std::int64_t target = saturating_add(offset().count(), wanted_delay(now).count());
  const std::int64_t change = saturating_sub(target, lag_.count());
  const std::int64_t slew = (dt / kSlewDivisor).count();
  // While the newest goal is held because no newer one has arrived, a longer delay causes no motion.
  const std::int64_t overdue = saturating_sub(transit_ns(now, entries_.back().sent), lag_.count());
  lag_ = Duration{saturating_add(lag_.count(), std::clamp(change, -slew, std::max(slew, overdue)))};
}

Duration Playout::offset() const {
  const auto arrival = offset_.earliest_arrival(PeerTime{});
  return arrival ? arrival->time_since_epoch() : Duration{0};
}

Duration Playout::wanted_delay(Time now) {
  if (!config_.adaptive) return std::max(Duration{0}, from_seconds(config_.fixed_delay_s));
  if (!quantile_at_ || now - *quantile_at_ >= kQuantilePeriod) {
    quantile_ = lateness_quantile();
    quantile_at_ = now;
  }
  return quantile_;
}

Duration Playout::lateness_quantile() {
  const std::int64_t latest = from_seconds(config_.delay_max_s).count();
  const std::int64_t earliest_transit = offset().count();
  std::size_t n = 0;
  for (std::size_t i = 0; i < lateness_.size(); ++i) {
    // The smaller of the two counts: neither a link that has become faster nor one that has become
    // permanently slower makes its datagrams late.
    const Lateness& l = lateness_[i];
    const std::int64_t late = std::min(l.late_ns, saturating_sub(l.transit_ns, earliest_transit));
    if (late <= latest) scratch_[n++] = std::max<std::int64_t>(late, 0);
  }
  if (n == 0) return Duration{0};
  const double rank = std::ceil(std::clamp(config_.quantile, 0.0, 1.0) * static_cast<double>(n));
  const std::size_t index = rank >= 1.0 ? std::min(n, static_cast<std::size_t>(rank)) - 1 : 0;
  const auto begin = scratch_.begin();
  const auto nth = begin + static_cast<std::ptrdiff_t>(index);
  std::nth_element(begin, nth, begin + static_cast<std::ptrdiff_t>(n));
  return Duration{*nth};
}

PlayoutGoal Playout::goal_at(PeerTime instant) const {
  std::size_t low = 0, high = entries_.size();
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (entries_[middle].sent > instant) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  if (low == 0) return {static_cast<double>(entries_.front().sequence), entries_.front().goal};
  const Entry& a = entries_[low - 1];
  const double sequence = static_cast<double>(a.sequence);
  if (low == entries_.size()) return {sequence, a.goal};
  const Entry& b = entries_[low];
  const double part = static_cast<double>(saturating_sub(to_ns(instant), to_ns(a.sent))) /
                      static_cast<double>(saturating_sub(to_ns(b.sent), to_ns(a.sent)));
  return {sequence + part * static_cast<double>(b.sequence - a.sequence), a.goal + part * (b.goal - a.goal)};
}

std::size_t Playout::first_beyond(double sequence) const {
  std::size_t i = entries_.size();
  while (i > 0 && static_cast<double>(entries_[i - 1].sequence) > sequence) --i;
  return i;
}

std::optional<double> Playout::crossing(const Vector3& n, const Vector3& point, double last_sequence,
                                        double most) const {
  struct Place {
    double sequence, distance;
  };
  const auto place = [&](std::size_t i) {
    return Place{static_cast<double>(entries_[i].sequence), n.dot(entries_[i].goal - point)};
  };
  const std::size_t beyond = first_beyond(last_sequence);
  if (beyond == 0 || std::isnan(last_sequence)) return std::nullopt;

  Place b = place(beyond - 1);
  std::size_t next = beyond - 1;  // entries below this one have not been considered yet
  if (beyond < entries_.size() && last_sequence > b.sequence) {
    const Place c = place(beyond);
    const double part = (last_sequence - b.sequence) / (c.sequence - b.sequence);
    b = {last_sequence, b.distance + part * (c.distance - b.distance)};
    next = beyond;
  }
  std::optional<double> nearest;
  double least = most;
  const auto consider = [&](const Place& p) {
    if (std::abs(p.distance) >= least) return;
    least = std::abs(p.distance);
    nearest = p.sequence;
  };
  consider(b);
  for (; next > 0; --next) {
    const Place a = place(next - 1);
    if ((a.distance < 0.0) != (b.distance < 0.0)) {
      // Where a goal is missing, the sender's goals are not on the line between the two that arrived.
      const bool whole = entries_[next].sequence == entries_[next - 1].sequence + 1;
      const double zero = a.sequence + (b.sequence - a.sequence) * a.distance / (a.distance - b.distance);
      if (a.distance < 0.0) return whole ? std::optional(zero) : std::nullopt;
      if (whole) consider({zero, 0.0});
    }
    consider(a);
    b = a;
  }
  return nearest;
}

}  // namespace longreach
