#include "common/loop/side_figures.hpp"

#include <limits>

namespace longreach {

const SideFigures& SideObserver::observe(Time now, Port& port, const LoopFigures& loop) {
  const Endpoint& endpoint = port.endpoint();
  const std::int64_t periods = now.time_since_epoch() / period_;
  if (periods != link_periods_) figures_.link = endpoint.monitor().figures(now);
  link_periods_ = periods;
  // Always of this tick: whether the other side is heard is decided with it.
  const auto heard = endpoint.monitor().last_heard();
  figures_.link.silence_s = heard ? to_seconds(now - *heard) : std::numeric_limits<double>::infinity();
  figures_.rejected = port.rejected();
  figures_.accepted = port.accepted_total();
  figures_.impaired = port.impairment().counts();
  figures_.loop = loop;
  figures_.session = endpoint.session();
  figures_.peer_restarts = endpoint.restarts();
  figures_.unknown_peers = port.channel().unknown_peers();
  figures_.unsent = port.channel().unsent();
  return figures_;
}

}  // namespace longreach
