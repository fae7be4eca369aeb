#include "tests/process/broken_adapter.hpp"

#include <sched.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <span>

#include "common/link/adapter_datagram.hpp"

namespace longreach {
namespace {

using adapter::HandleDatagram;
using adapter::WrenchDatagram;

std::int64_t now_ns() { return std::chrono::steady_clock::now().time_since_epoch().count(); }

/// Whether this one counts, as far as the flaw lets it be judged.
bool counts(Flaw flaw, const std::array<std::byte, 2048>& bytes, std::size_t size,
            adapter::Exchange& exchange, std::uint64_t& first_session, WrenchDatagram& out) {
  if (flaw == Flaw::kTakesAnything) {
    if (size != sizeof out) return false;
    std::memcpy(&out, bytes.data(), sizeof out);
    exchange.accept(out.header, now_ns());
    return true;
  }
  if (!adapter::decode(bytes.data(), size, out)) return false;
  if (first_session == 0) first_session = out.header.session;
  if (flaw == Flaw::kTakesNoRestart && out.header.session != first_session) return false;
  return exchange.accept(out.header, now_ns()) ||
         (flaw == Flaw::kTakesOldNumbers && out.header.session == first_session);
}

}  // namespace

BrokenAdapter::BrokenAdapter(Flaw flaw) : flaw_(flaw), listener_(flaw == Flaw::kTakesAnyone) {
  thread_ = std::thread([this] { run(); });
}

BrokenAdapter::~BrokenAdapter() {
  ended_ = true;
  thread_.join();
}

void BrokenAdapter::run() {
  const sched_param priority{.sched_priority = 20};
  sched_setscheduler(0, SCHED_FIFO, &priority);
  adapter::Exchange exchange(7);
  std::array<std::byte, 2048> bytes{};
  WrenchDatagram wrench{};
  std::uint64_t first_session = 0;
  auto due = std::chrono::steady_clock::now();
  for (int tick = 0; !ended_; ++tick) {
    while (const auto size = listener_.receive(bytes)) {
      WrenchDatagram in;
      if (counts(flaw_, bytes, *size, exchange, first_session, in)) wrench = in;
    }
    const bool silent = exchange.silent(now_ns());
    if (silent && flaw_ != Flaw::kNoWatchdog) wrench = {};
    HandleDatagram out;
    out.flags = flaw_ == Flaw::kFailed ? 0 : HandleDatagram::kOk | HandleDatagram::kHeld;
    if (flaw_ != Flaw::kNoWrench && (wrench.flags & WrenchDatagram::kLive) != 0)
      std::copy_n(wrench.force_n, 3, out.force_n);
    exchange.stamp(out);
    if (flaw_ == Flaw::kNoCount) out.header.sequence = 1;
    if (flaw_ == Flaw::kNoEcho) out.header.echo = 0;
    if (flaw_ == Flaw::kNotFinite && tick % 50 == 0)
      out.position_m[0] = std::numeric_limits<double>::quiet_NaN();
    const std::size_t size = sizeof out - (flaw_ == Flaw::kShort && tick % 50 == 0 ? 1 : 0);
    if (!(silent && flaw_ == Flaw::kMute)) listener_.send(std::as_bytes(std::span(&out, 1)).first(size));
    due = std::max(due + std::chrono::milliseconds(flaw_ == Flaw::kSlow ? 10 : 1),
                   std::chrono::steady_clock::now() - std::chrono::milliseconds(5));
    std::this_thread::sleep_until(due);
  }
}

}  // namespace longreach
