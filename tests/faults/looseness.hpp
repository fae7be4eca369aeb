#pragma once
// Fields that can weaken a guard, as lists of the oracle: the campaign changes each of them and checks the
// result. A test compares the lists with the schema, so that no field is missing.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "proto/config.pb.h"

namespace longreach {

/// Which values are less restrictive than that of the start.
enum class Loose : std::uint8_t { kAbove, kBelow, kOther };

struct GuardedField {
  const char* path;
  Loose looser = Loose::kAbove;
  double automatic = 0.0;  // value for which 0 stands
};

std::span<const GuardedField> slave_limits();
std::span<const GuardedField> master_limits();

/// Returns the limit that is less restrictive than at the start; empty: none.
std::string looser(const proto::SlaveConfig& start, const proto::SlaveConfig& now);
std::string looser(const proto::MasterConfig& start, const proto::MasterConfig& now);

}  // namespace longreach
