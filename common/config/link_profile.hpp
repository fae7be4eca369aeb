#pragma once
// Applies a link profile to one side of the link.

#include "proto/config.pb.h"

namespace longreach {

/// The impairment at the slave, including the delay of its RPC (Impairment.rpc_delay_s).
proto::Impairment impairment_of_slave(const proto::LinkProfile& profile);

/// Impairs the received datagrams as specified for the incoming direction of the profile. Unless a send
/// budget is set, limits the send rate to 95 % of the rate of the outgoing direction, because an overloaded
/// link adds queueing delay.
void take_profile(proto::MasterLink& link, const proto::LinkProfile& profile);
void take_profile(proto::SlaveLink& link, const proto::LinkProfile& profile);

}  // namespace longreach
