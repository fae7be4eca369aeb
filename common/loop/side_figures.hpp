#pragma once
// Statistics of link, loop and dropped datagrams, which the loops of both sides publish in addition to their
// views. Contains only plain values.

#include "common/loop/loop_figures.hpp"
#include "common/wire/port.hpp"

namespace longreach {

struct SideFigures {
  LinkFigures link{};
  RejectionCounts rejected{};
  std::uint64_t accepted = 0;
  ImpairmentCounts impaired{};
  LoopFigures loop{};
  std::uint64_t session = 0;        // 0 before the first session
  std::uint32_t peer_restarts = 0;  // number of sessions after the first
  std::uint64_t unknown_peers = 0;  // datagrams from addresses other than the peer's
  std::uint64_t unsent = 0;         // datagrams that the system refused to send
};

/// Maintains the statistics of a side. In most ticks it only copies a few values: the statistics of the link
/// require sorting a window and are computed only at multiples of `period` of the clock of the side.
class SideObserver {
 public:
  explicit SideObserver(Duration period = std::chrono::milliseconds(50)) : period_(period) {}
  const SideFigures& observe(Time now, Port& port, const LoopFigures& loop);
  [[nodiscard]] const SideFigures& figures() const { return figures_; }

 private:
  Duration period_;
  SideFigures figures_{};
  std::int64_t link_periods_ = -1;  // since the start of the clock, at the last statistics of the link
};

}  // namespace longreach
