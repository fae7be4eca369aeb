#pragma once
// A simulated link that is stepped once per sample. Data is delayed by a fixed number of samples, optionally
// with jitter and losses. The newest data that is due is delivered; older data that arrives later is dropped.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/core/random.hpp"

namespace longreach {

struct DelayLineConfig {
  int samples = 0;
  /// Standard deviation of the delay. The delay is clamped between 0 and six standard deviations above its
  /// mean.
  double jitter_samples = 0.0;
  double loss = 0.0;
};

template <class T>
class DelayLine {
 public:
  DelayLine(const DelayLineConfig& config, Random random)
      : config_(config),
        random_(random),
        slots_(static_cast<std::size_t>(config.samples + std::ceil(6.0 * config.jitter_samples)) + 1) {}

  /// Sends a value. Call it once per sample, before pop.
  void push(const T& value) {
    ++sequence_;
    if (config_.loss > 0.0 && random_.chance(config_.loss)) return;
    double due = config_.samples;
    if (config_.jitter_samples > 0.0) due += std::round(config_.jitter_samples * random_.normal());
    const auto ahead =
        static_cast<std::uint64_t>(std::clamp(due, 0.0, static_cast<double>(slots_.size()) - 1.0));
    slot(sequence_ + ahead) = {sequence_, value};
  }

  /// Returns the data that arrives in this sample, if any.
  std::optional<T> pop() {
    QueuedDatagram& queued_datagram = slot(sequence_);
    if (queued_datagram.sequence <= newest_) return std::nullopt;
    newest_ = queued_datagram.sequence;
    return queued_datagram.value;
  }

 private:
  struct QueuedDatagram {
    std::uint64_t sequence = 0;  // from 1
    T value{};
  };
  QueuedDatagram& slot(std::uint64_t at) { return slots_[at % slots_.size()]; }

  DelayLineConfig config_;
  Random random_;
  std::vector<QueuedDatagram> slots_;
  std::uint64_t sequence_ = 0;
  std::uint64_t newest_ = 0;
};

}  // namespace longreach
