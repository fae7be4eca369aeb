#include "common/io/side_figures.hpp"

namespace longreach {
namespace {

constexpr Duration kLinkPeriod = std::chrono::milliseconds(50);

}  // namespace

const SideFigures& SideObserver::observe(Time now, Port& port, const UdpChannel& channel,
                                         const LoopFigures& loop) {
  const Endpoint& endpoint = port.endpoint();
  if (now >= link_due_) {
    figures_.link = endpoint.monitor().figures(now);
    link_due_ = now + kLinkPeriod;
  }
  // Always of this tick: whether the other side is heard is decided with it.
  if (const auto heard = endpoint.monitor().last_heard()) figures_.link.silence_s = to_seconds(now - *heard);
  figures_.rejected = port.rejected();
  figures_.accepted = port.accepted_total();
  figures_.impaired = port.impairment().counts();
  figures_.loop = loop;
  figures_.peer_session = endpoint.peer_session();
  figures_.peer_restarts = endpoint.peer_restarts();
  figures_.strangers = channel.strangers();
  figures_.unsent = channel.unsent();
  return figures_;
}

}  // namespace longreach
