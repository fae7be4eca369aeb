#pragma once
// Application of a link profile to one side of the link.

#include "proto/config.pb.h"

namespace longreach {

/// Impairs the received datagrams as the incoming direction of the profile specifies. Limits the sent data to
/// 95 % of the rate of the outgoing direction, unless a budget is set, because an overloaded link adds the
/// delay of its queue.
void take_profile(proto::MasterLink& link, const proto::LinkProfile& profile);
void take_profile(proto::SlaveLink& link, const proto::LinkProfile& profile);

}  // namespace longreach
