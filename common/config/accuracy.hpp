#pragma once
// The preset of speed against accuracy.

#include "proto/config.pb.h"

namespace longreach {

/// Sets the fields that `accuracy` chooses where they are not set.
void apply_accuracy(proto::MasterConfig& config);
void apply_accuracy(proto::SlaveConfig& config);

}  // namespace longreach
