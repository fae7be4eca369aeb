#include "tests/process/device_box.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <span>

#include "common/link/adapter_datagram.hpp"

namespace longreach {
namespace {

using adapter::HandleDatagram;
using adapter::WrenchDatagram;

constexpr double kSpeed_m_per_s = 0.02, kPeriod_s = 1e-3;

std::int64_t now_ns() { return std::chrono::steady_clock::now().time_since_epoch().count(); }

}  // namespace

void DeviceBox::run() {
  adapter::Exchange exchange(7);
  std::array<std::byte, 2048> bytes{};
  WrenchDatagram wrench{};
  std::uint32_t buttons = buttons_;
  int pressed_at = 0;
  auto due = std::chrono::steady_clock::now();
  for (int tick = 0; !ended_; ++tick) {
    while (const auto size = listener_.receive(bytes)) {
      WrenchDatagram in;
      if (adapter::decode(bytes.data(), *size, in) && exchange.accept(in.header, now_ns())) wrench = in;
    }
    if (exchange.silent(now_ns())) wrench = {};
    const double step_m = kPeriod_s * kSpeed_m_per_s, left_m = target_m_ - at_m_;
    at_m_ = at_m_ + std::clamp(left_m, -step_m, step_m);
    HandleDatagram out;
    out.flags = HandleDatagram::kOk | HandleDatagram::kHeld;
    if (const std::uint32_t now = buttons_; now != buttons) pressed_at = tick, buttons = now;
    const bool opens = tick - pressed_at < 4 && (tick - pressed_at) % 2 == 1;
    out.flags |= opens ? 0U : buttons;
    out.position_m[0] = scale_ * at_m_ + jump_m_ + (tick / 1000 % 2 == 1 ? chatter_m_.load() : 0.0);
    if (swapped_) std::swap(out.orientation[0], out.orientation[3]);
    if ((wrench.flags & WrenchDatagram::kLive) != 0) std::copy_n(wrench.force_n, 3, out.force_n);
    for (const double force_n : out.force_n) force_max_n_ = std::max(force_max_n_.load(), std::abs(force_n));
    exchange.stamp(out);
    if (!muted_) listener_.send(std::as_bytes(std::span(&out, 1)));
    due = std::max(due + std::chrono::milliseconds(1),
                   std::chrono::steady_clock::now() - std::chrono::milliseconds(5));
    std::this_thread::sleep_until(due);
  }
}

}  // namespace longreach
