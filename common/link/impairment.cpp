#include "common/link/impairment.hpp"

#include <algorithm>
#include <cmath>

#include "common/link/saturating.hpp"

namespace longreach {
namespace {

constexpr std::size_t kUdpIpHeaderBytes = 28;  // UDP 8 and IPv4 20

Time later(Time t, double s) { return Time{Duration{saturating_add(to_ns(t), from_seconds(s).count())}}; }

bool is_clear(ImpairmentConfig config) {
  config.rpc_delay_s = 0.0;
  return config == ImpairmentConfig{};
}

}  // namespace

Impairment::Impairment(const ImpairmentConfig& config, Random random)
    : config_(config),
      clear_(is_clear(config)),
      streams_{random.child("loss"),
               random.child("corrupt"),
               random.child("duplicate"),
               {random.child("jitter"), random.child("jitter of copies")},
               {random.child("reorder"), random.child("reorder of copies")}},
      bytes_(kSlots * kSlotBytes),
      origins_(kSlots) {
  heap_.reserve(kSlots);
  free_.reserve(kSlots);
  for (std::size_t i = kSlots; i > 0; --i) free_.push_back(static_cast<std::uint32_t>(i - 1));
}

void Impairment::configure(const ImpairmentConfig& config, Time now) {
  config_ = config;
  clear_ = is_clear(config);
  set_at_ = now;
  queue_free_at_ = now;
  in_burst_.reset();
}

void Impairment::push(Time now, std::span<const std::byte> datagram, const Origin& origin) {
  start_clock(now);
  ++counts_.in;
  const Decision decision = draw_decision();
  const double t_s = to_seconds(now - *set_at_);
  if (blacked_out(t_s)) {
    ++counts_.blacked_out;
    return;
  }
  if (decision.lost) {
    ++counts_.lost;
    return;
  }
  if (decision.corrupted) ++counts_.corrupted;
  if (decision.duplicated) ++counts_.duplicated;

  const std::size_t copies = decision.duplicated ? kCopies : 1;
  for (std::size_t copy = 0; copy < copies; ++copy) {
    const std::optional<Time> left = leave_queue(now, datagram.size());
    const double delay_s = std::max(0.0, base_delay_s(t_s) + config_.jitter_s * decision.jitter[copy]);
    const bool let_past = decision.let_past[copy] && delay_s > 0.0;
    if (!left || !store(later(*left, let_past ? 0.5 * delay_s : delay_s), datagram, origin, decision)) {
      ++counts_.queue_dropped;
    } else if (let_past) {
      ++counts_.reordered;
    }
  }
}

std::optional<std::span<const std::byte>> Impairment::pop(Time now) {
  start_clock(now);
  if (heap_.empty() || heap_.front().due > now) return std::nullopt;
  const QueuedDatagram queued_datagram = heap_.front();
  std::pop_heap(heap_.begin(), heap_.end());
  heap_.pop_back();
  free_.push_back(queued_datagram.slot);
  origin_ = origins_[queued_datagram.slot];
  ++counts_.out;
  return std::span<const std::byte>(bytes_).subspan(queued_datagram.slot * kSlotBytes, queued_datagram.size);
}

// Each enabled effect draws from its stream independently of the other effects.
Impairment::Decision Impairment::draw_decision() {
  Decision decision;
  if (config_.loss > 0.0) decision.lost = draw_loss();
  if (config_.corrupt > 0.0) {
    decision.corrupted = streams_.corrupt.chance(config_.corrupt);
    decision.flipped = streams_.corrupt.uniform();
  }
  if (config_.duplicate > 0.0) decision.duplicated = streams_.duplicate.chance(config_.duplicate);
  for (std::size_t copy = 0; copy < kCopies; ++copy) {
    if (config_.jitter_s > 0.0) decision.jitter[copy] = streams_.jitter[copy].normal();
    if (config_.reorder > 0.0) decision.let_past[copy] = streams_.reorder[copy].chance(config_.reorder);
  }
  return decision;
}

// Two-state Gilbert model: bursts end with probability r = 1/burst and begin with probability q = p r / (1 -
// p), so that p is the mean loss. If that requires q > 1, bursts become longer instead to keep the mean.
bool Impairment::draw_loss() {
  const double u = streams_.loss.uniform();
  const double p = config_.loss;
  if (!(config_.loss_burst > 1.0) || p >= 1.0) return u < p;
  if (!in_burst_) {
    in_burst_ = u < p;
  } else {
    const double end = std::min(1.0 / config_.loss_burst, (1.0 - p) / p);
    const double begin = p * end / (1.0 - p);
    in_burst_ = *in_burst_ ? u >= end : u < begin;
  }
  return *in_burst_;
}

void Impairment::start_clock(Time now) {
  if (!set_at_) {
    set_at_ = now;
    queue_free_at_ = now;
  }
}

bool Impairment::blacked_out(double t_s) const {
  const double since = t_s - config_.blackout_start_s;
  if (!(config_.blackout_duration_s > 0.0) || since < 0.0) return false;
  const double phase = config_.blackout_period_s > 0.0 ? std::fmod(since, config_.blackout_period_s) : since;
  return phase < config_.blackout_duration_s;
}

double Impairment::base_delay_s(double t_s) const {
  const double into_step = t_s - config_.step_start_s;
  const bool stepped = into_step >= 0.0 && into_step < config_.step_duration_s;
  return config_.delay_s + config_.drift_s_per_s * t_s + (stepped ? config_.step_delay_s : 0.0);
}

std::optional<Time> Impairment::leave_queue(Time now, std::size_t bytes) {
  if (!(config_.rate_bit_per_s > 0.0)) return now;
  const Time begins = std::max(now, queue_free_at_);
  if (begins - now > from_seconds(config_.queue_s)) return std::nullopt;
  queue_free_at_ =
      later(begins, 8.0 * static_cast<double>(bytes + kUdpIpHeaderBytes) / config_.rate_bit_per_s);
  return queue_free_at_;
}

bool Impairment::store(Time due, std::span<const std::byte> datagram, const Origin& origin,
                       const Decision& decision) {
  if (free_.empty()) return false;
  const std::uint32_t slot = free_.back();
  free_.pop_back();
  const std::size_t size = std::min(datagram.size(), kSlotBytes);
  const auto room = std::span(bytes_).subspan(slot * kSlotBytes, size);
  std::copy_n(datagram.begin(), size, room.begin());
  origins_[slot] = origin;
  if (decision.corrupted && size > 0) {
    const auto bit = static_cast<std::size_t>(decision.flipped * 8.0 * static_cast<double>(size));
    room[bit / 8] ^= std::byte{1} << (bit % 8);
  }
  heap_.push_back({due, arrivals_++, slot, static_cast<std::uint32_t>(size)});
  std::push_heap(heap_.begin(), heap_.end());
  return true;
}

}  // namespace longreach
