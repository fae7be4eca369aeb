#include "tests/faults/wire.hpp"

#include <algorithm>

namespace longreach {
namespace {

constexpr double kOldAfter_s = 0.05;  // an outage the old ones come

}  // namespace

void WireDirection::take(double now_s, Bytes datagram) {
  if (direction_faults.cut) return;
  if (direction_faults.held || direction_faults.late) {
    release_s_ = direction_faults.late ? kNever : 0.0;
    if (held_.size() < kKept) held_.push_back(std::move(datagram));
    return;
  }
  const double due_s = std::max(now_s + direction_faults.delay_s, line_.empty() ? 0.0 : line_.back().due_s);
  if (due_s > now_s) kept_until_s_ = due_s;
  if (direction_faults.swapped && !swapped_) {
    swapped_ = std::move(datagram);
    return;
  }
  for (std::uint32_t i = 0; i < direction_faults.copies; ++i) line_.push_back({due_s, datagram});
  line_.push_back({due_s, std::move(datagram)});
  if (swapped_) line_.push_back({due_s, *std::exchange(swapped_, std::nullopt)});
}

void WireDirection::inject(Bytes datagram) { store(std::move(datagram)); }

void WireDirection::pass(double now_s) {
  for (; !line_.empty() && line_.front().due_s <= now_s; line_.pop_front())
    arrive(std::move(line_.front().datagram));
  if (held_.empty() || direction_faults.held || direction_faults.late) return;
  if (release_s_ == kNever) release_s_ = now_s + kOldAfter_s;
  if (now_s < release_s_) return;
  for (Bytes& datagram : held_) arrive(std::move(datagram));
  held_.clear();
}

void WireDirection::release() {
  for (Kept& kept : line_) arrive(std::move(kept.datagram));
  for (Bytes& datagram : held_) arrive(std::move(datagram));
  line_.clear();
  held_.clear();
  kept_until_s_ = -1e9;
}

void WireDirection::arrive(Bytes datagram) {
  if (received_.size() < kReceived) {
    received_.push_back(datagram);
  } else {
    received_[random_.next() % kReceived] = datagram;
  }
  store(std::move(datagram));
}

void WireDirection::store(Bytes datagram) {
  if (socket_.size() < kSocket) socket_.push_back(std::move(datagram));
}

}  // namespace longreach
