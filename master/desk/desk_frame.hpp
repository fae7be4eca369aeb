#pragma once
// The console's picture as a message, for eyes elsewhere.

#include "master/console/snapshot.hpp"
#include "proto/control.pb.h"

namespace longreach {

/// `workspace_m`: radius of the handle's workspace about its home.
proto::Frame to_frame(const ConsoleSnapshot& snapshot, double workspace_m);

}  // namespace longreach
