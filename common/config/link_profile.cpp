#include "common/config/link_profile.hpp"

#include <algorithm>

namespace longreach {
namespace {

template <class Link>
void take(Link& link, const proto::Impairment& in, const proto::Impairment& out) {
  constexpr double kShare = 0.95;
  *link.mutable_impairment() = in;
  if (!link.has_budget_kbit_per_s() && out.rate_bit_per_s() > 0.0)
    link.set_budget_kbit_per_s(kShare * 1e-3 * out.rate_bit_per_s());
}

}  // namespace

void take_profile(proto::MasterLink& link, const proto::LinkProfile& profile) {
  take(link, profile.down(), profile.up());
}

void take_profile(proto::SlaveLink& link, const proto::LinkProfile& profile) {
  take(link, impairment_of_slave(profile), profile.down());
}

proto::Impairment impairment_of_slave(const proto::LinkProfile& profile) {
  constexpr double kRpcDelayMax_s = 10.0;  // the schema's range of rpc_delay_s
  proto::Impairment up = profile.up();
  if (!up.has_rpc_delay_s())
    up.set_rpc_delay_s(std::min(up.delay_s() + profile.down().delay_s(), kRpcDelayMax_s));
  return up;
}

}  // namespace longreach
