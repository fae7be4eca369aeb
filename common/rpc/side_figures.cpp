#include "common/rpc/side_figures.hpp"

#include <limits>
#include <numeric>

namespace longreach {
namespace {

constexpr Duration kLinkPeriod = std::chrono::milliseconds(50);

}  // namespace

LinkSample link_sample(Time now, const SideFigures& figures) {
  LinkSample out;
  out.now = now;
  out.link = figures.link;
  out.accepted = figures.accepted;
  out.rejected = std::accumulate(figures.rejected.begin(), figures.rejected.end(), std::uint64_t{0});
  out.session = figures.session;
  out.missed_ticks = figures.loop.missed_ticks;
  out.ticks_late_100ms = figures.loop.ticks_late_100ms;
  return out;
}

const SideFigures& SideObserver::observe(Time now, Port& port, const UdpChannel& channel,
                                         const LoopFigures& loop) {
  const Endpoint& endpoint = port.endpoint();
  if (now >= link_due_) {
    figures_.link = endpoint.monitor().figures(now);
    link_due_ = now + kLinkPeriod;
  }
  // Always of this tick: whether the other side is heard is decided with it.
  const auto heard = endpoint.monitor().last_heard();
  figures_.link.silence_s = heard ? to_seconds(now - *heard) : std::numeric_limits<double>::infinity();
  figures_.rejected = port.rejected();
  figures_.accepted = port.accepted_total();
  figures_.impaired = port.impairment().counts();
  figures_.loop = loop;
  figures_.session = endpoint.session();
  figures_.peer_restarts = endpoint.restarts();
  figures_.unknown_peers = channel.unknown_peers();
  figures_.unsent = channel.unsent();
  return figures_;
}

}  // namespace longreach
