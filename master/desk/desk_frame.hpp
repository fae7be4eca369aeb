#pragma once
// Converts a snapshot of the console to a message for remote clients.

#include "master/console/snapshot.hpp"
#include "proto/control.pb.h"

namespace longreach {

/// Returns the message for `snapshot`. `workspace_m` is the radius of the handle's workspace around its home.
proto::Frame to_frame(const ConsoleSnapshot& snapshot, double workspace_m);

}  // namespace longreach
