#pragma once
// Converts the picture of the console to a message for remote clients.

#include "master/console/snapshot.hpp"
#include "proto/control.pb.h"

namespace longreach {

/// `workspace_m`: radius of the workspace of the handle about its home.
proto::Frame to_frame(const ConsoleSnapshot& snapshot, double workspace_m);

}  // namespace longreach
