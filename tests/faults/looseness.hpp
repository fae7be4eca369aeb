#pragma once
// What weakens a guard, by lists that are the oracle's own: each is asked for by the campaign, and judged. A
// test compares them with the schema, so that no field is forgotten.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "proto/config.pb.h"

namespace longreach {

/// Which value is less restrictive than that of the start.
enum class Loose : std::uint8_t { kAbove, kBelow, kOther };

struct GuardedField {
  const char* path;
  Loose looser = Loose::kAbove;
  double automatic = 0.0;  // what 0 stands for
};

std::span<const GuardedField> slave_limits();
std::span<const GuardedField> master_limits();

/// Which limit is less restrictive than at the start; empty: none.
std::string looser(const proto::SlaveConfig& start, const proto::SlaveConfig& now);
std::string looser(const proto::MasterConfig& start, const proto::MasterConfig& now);

}  // namespace longreach
