#pragma once
// Fills in the fields of the RPC status that both sides have in common.

#include <string>
#include <string_view>

#include "common/link/delay_monitor.hpp"
#include "common/link/envelope.hpp"
#include "common/link/impairment.hpp"
#include "common/link/stiffness_report.hpp"
#include "common/loop/side_figures.hpp"
#include "common/spatial/spatial.hpp"
#include "common/wire/adapter_port.hpp"
#include "proto/control.pb.h"
#include "schema/state_link.hpp"

namespace longreach {

std::string_view to_string(SafetyState state);  // name as in proto/control: Idle, Observing, ...
std::string_view to_string(HoldCause cause);    // name of the cause
/// because="..." for a log line; empty if the reason is not a joint
std::string because(const Reason& reason);

void add_count(proto::Status& status, std::string_view name, std::uint64_t count);
/// Adds the counters `rejected` and, for each reason, `rejected_REASON`.
void add_counts(proto::Status& status, const RejectionCounts& counts);
/// Adds ticks, missed_ticks, ticks_late_100ms, lateness_p99_us, lateness_max_us and busy_max_us.
void add_counts(proto::Status& status, const LoopFigures& loop);
/// Adds a counter `impaired_REASON` for each effect of the artificial impairment.
void add_counts(proto::Status& status, const ImpairmentCounts& counts);
/// Adds adapter_accepted, adapter_malformed, adapter_late, adapter_restarts and adapter_silent_after_us, if
/// there is an adapter.
void add_counts(proto::Status& status, const AdapterFigures& adapter);
/// Adds the names of the active limits.
void add_clamps(google::protobuf::RepeatedPtrField<std::string>& names, const Clamps& clamps,
                const Pose& X_WE, const Pose& X_WE_goal);
/// Adds the acceleration limits because of a load in the gripper that are not 0.
void add_load_limit(google::protobuf::RepeatedPtrField<std::string>& names, double acceleration_m_per_s2,
                    double acceleration_rad_per_s2);
/// Adds a sentence for each bit of Protection (common/link/protection.hpp).
void add_reduced(google::protobuf::RepeatedPtrField<std::string>& sentences, std::uint32_t reduced);
/// Fills in the link statistics and all counters of the side except the adapter's: those above, and accepted,
/// peer_restarts, strangers and unsent.
void fill(proto::Status& status, const SideFigures& figures);
proto::Figures to_message(const LinkFigures& figures);

template <class Field>
void assign(const Vector3& values, Field& out) {
  out.Clear();
  for (const double v : values) out.Add(v);
}

}  // namespace longreach
