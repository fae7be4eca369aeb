#pragma once
// The `accuracy` preset, which trades accuracy for speed.

#include "proto/config.pb.h"

namespace longreach {

/// Sets the fields that `accuracy` controls, unless the configuration sets them explicitly.
void apply_accuracy(proto::MasterConfig& config);
void apply_accuracy(proto::SlaveConfig& config);

}  // namespace longreach
