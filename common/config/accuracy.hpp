#pragma once
// The `accuracy` preset, which trades accuracy for speed.

#include "proto/config.pb.h"

namespace longreach {

/// Sets those fields controlled by `accuracy` that the configuration leaves unset.
void apply_accuracy(proto::MasterConfig& config);
void apply_accuracy(proto::SlaveConfig& config);

}  // namespace longreach
