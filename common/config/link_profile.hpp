#pragma once
// A link profile as one side of the link takes it.

#include "proto/config.pb.h"

namespace longreach {

/// What the side receives is impaired as the profile's way in says. What it sends keeps within the rate of
/// the way out, 5 % to spare, unless a budget is set: a link that is sent too much is as late as its queue is
/// long.
void take_profile(proto::MasterLink& link, const proto::LinkProfile& profile);
void take_profile(proto::SlaveLink& link, const proto::LinkProfile& profile);

}  // namespace longreach
