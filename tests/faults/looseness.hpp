#pragma once
// The configuration fields that can weaken a guard: those of the schema that a client cannot change freely. The campaign
// changes each of these fields and checks the result.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "proto/config.pb.h"

namespace longreach {

/// Specifies which values are less restrictive than the value at the start.
enum class Loose : std::uint8_t { kAbove, kBelow, kOther };

struct GuardedField {
  std::string path;
  Loose looser = Loose::kAbove;
  double automatic = 0.0;  // value that is used if the field is 0
};

std::span<const GuardedField> slave_limits();
std::span<const GuardedField> master_limits();

/// Returns the name of a limit that is less restrictive now than at the start, or an empty string if there is
/// none.
std::string looser(const proto::SlaveConfig& start, const proto::SlaveConfig& now);
std::string looser(const proto::MasterConfig& start, const proto::MasterConfig& now);

}  // namespace longreach
