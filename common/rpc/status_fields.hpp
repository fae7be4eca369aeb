#pragma once
// Fields of the RPC status that both sides fill in the same way.

#include <string>
#include <string_view>

#include "common/link/delay_monitor.hpp"
#include "common/link/envelope.hpp"
#include "common/link/impairment.hpp"
#include "common/link/stiffness_report.hpp"
#include "common/link/telemetry.hpp"
#include "common/rpc/side_figures.hpp"
#include "common/spatial/spatial.hpp"
#include "common/wire/adapter_port.hpp"
#include "proto/control.pb.h"

namespace longreach {

std::string_view to_string(SafetyState state);  // as in proto/control: Idle, Observing, ...
std::string_view to_string(HoldCause cause);    // its name
std::string because(const Reason& reason);      // position of a joint for a log line; otherwise empty

void add_count(proto::Status& status, std::string_view name, std::uint64_t count);
/// rejected, and rejected_REASON for each reason.
void add_counts(proto::Status& status, const RejectionCounts& counts);
/// ticks, missed_ticks, ticks_late_100ms, lateness_p99_us, lateness_max_us, busy_max_us.
void add_counts(proto::Status& status, const LoopFigures& loop);
/// impaired_REASON for each effect of the artificial impairment.
void add_counts(proto::Status& status, const ImpairmentCounts& counts);
/// adapter_accepted, adapter_malformed, adapter_late, adapter_restarts, adapter_silent_after_us, if there is
/// an adapter.
void add_counts(proto::Status& status, const AdapterFigures& adapter);
/// Names of the active limits.
void add_clamps(google::protobuf::RepeatedPtrField<std::string>& names, const Clamps& clamps);
/// Link and counters of the side: all of the above and accepted, peer_restarts, strangers, unsent.
void fill(proto::Status& status, const SideFigures& figures);
proto::Figures to_message(const LinkFigures& figures);

template <class Field>
void assign(const Vector3& values, Field& out) {
  out.Clear();
  for (const double v : values) out.Add(v);
}

}  // namespace longreach
