#include "common/rpc/status_fields.hpp"

#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "common/link/boundary_words.hpp"
#include "common/link/protection.hpp"

namespace longreach {

std::string_view to_string(SafetyState state) {
  switch (state) {
    case SafetyState::kIdle:
      return "Idle";
    case SafetyState::kObserving:
      return "Observing";
    case SafetyState::kEngaged:
      return "Engaged";
    case SafetyState::kHolding:
      return "Holding";
    case SafetyState::kStopped:
      return "Stopped";
    case SafetyState::kFault:
      return "Fault";
  }
  return "unknown";
}

std::string_view to_string(HoldCause cause) { return text_of(cause).name; }

std::string because(const Reason& reason) {
  return reason.joint == 0 ? "" : " because=\"" + sentence(reason) + "\"";
}

void add_count(proto::Status& status, std::string_view name, std::uint64_t count) {
  auto* counter = status.add_counters();
  counter->set_name(std::string(name));
  counter->set_count(count);
}

void add_counts(proto::Status& status, const RejectionCounts& counts) {
  add_count(status, "rejected", std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}));
  for (std::size_t i = 0; i < kRejectionCount; ++i) {
    add_count(status, "rejected_" + std::string(to_string(static_cast<Rejection>(i))), counts[i]);
  }
}

void add_counts(proto::Status& status, const LoopFigures& loop) {
  const auto microseconds = [](double s) { return static_cast<std::uint64_t>(std::lround(1e6 * s)); };
  add_count(status, "ticks", loop.ticks);
  add_count(status, "missed_ticks", loop.missed_ticks);
  add_count(status, "ticks_late_100ms", loop.ticks_late_100ms);
  add_count(status, "lateness_p99_us", microseconds(loop.lateness_quantile_s(0.99)));
  add_count(status, "lateness_max_us", microseconds(to_seconds(loop.lateness_max)));
  add_count(status, "busy_max_us", microseconds(to_seconds(loop.busy_max)));
  const auto octaves = loop.lateness_octaves();
  std::size_t used = octaves.size();
  while (used > 0 && octaves[used - 1] == 0) --used;
  status.mutable_lateness()->Assign(octaves.begin(), octaves.begin() + static_cast<std::ptrdiff_t>(used));
}

void add_counts(proto::Status& status, const ImpairmentCounts& counts) {
  add_count(status, "impaired_lost", counts.lost);
  add_count(status, "impaired_blacked_out", counts.blacked_out);
  add_count(status, "impaired_corrupted", counts.corrupted);
  add_count(status, "impaired_duplicated", counts.duplicated);
  add_count(status, "impaired_queue_dropped", counts.queue_dropped);
  add_count(status, "impaired_reordered", counts.reordered);
}

void add_counts(proto::Status& status, const AdapterFigures& adapter) {
  if (!adapter.present) return;
  add_count(status, "adapter_accepted", adapter.accepted);
  add_count(status, "adapter_malformed", adapter.malformed);
  add_count(status, "adapter_late", adapter.late);
  add_count(status, "adapter_restarts", adapter.restarts);
  add_count(status, "adapter_silent_after_us",
            static_cast<std::uint64_t>(std::lround(1e6 * adapter.silent_after_s)));
}

void add_reduced(google::protobuf::RepeatedPtrField<std::string>& sentences, std::uint32_t reduced) {
  for (std::string& sentence : reduced_in_words(reduced)) *sentences.Add() = std::move(sentence);
}

void add_clamps(google::protobuf::RepeatedPtrField<std::string>& names, const Clamps& clamps,
                const Pose& X_WE, const Pose& X_WE_goal) {
  const auto add = [&names](bool active, const char* name) {
    if (active) names.Add(name);
  };
  add(clamps.tool_speed, "tool speed");
  add(clamps.joint_speed, "joint speed");
  add(clamps.workspace, "workspace");
  add(clamps.force_guard, "force guard");
  add(clamps.moment_guard, "moment guard");
  add(clamps.singularity, "singularity");
  const std::string boundary = boundary_in_words(clamps, X_WE, X_WE_goal);
  add(!boundary.empty(), boundary.c_str());
}

void add_load_limit(google::protobuf::RepeatedPtrField<std::string>& names, double acceleration_m_per_s2,
                    double acceleration_rad_per_s2) {
  if (std::string words = load_limit_in_words(acceleration_m_per_s2, acceleration_rad_per_s2); !words.empty())
    *names.Add() = std::move(words);
}

void fill(proto::Status& status, const SideFigures& figures) {
  *status.mutable_link() = to_message(figures.link);
  add_count(status, "accepted", figures.accepted);
  add_counts(status, figures.rejected);
  add_count(status, "strangers", figures.unknown_peers);
  add_count(status, "unsent", figures.unsent);
  add_count(status, "peer_restarts", figures.peer_restarts);
  add_counts(status, figures.loop);
  add_counts(status, figures.impaired);
}

proto::Figures to_message(const LinkFigures& figures) {
  proto::Figures out;
  out.set_rtt_known(figures.rtt_s.has_value());
  out.set_rtt_s(figures.rtt_s.value_or(0.0));
  out.set_jitter_s(figures.jitter_s);
  out.set_loss(figures.loss);
  out.set_reorder(figures.reorder);
  if (figures.age_s) out.set_age_s(*figures.age_s);
  out.set_silence_s(std::isfinite(figures.silence_s) ? figures.silence_s : -1.0);
  out.set_rate_hz(figures.rate_hz);
  out.set_bytes_per_s(figures.bytes_per_s);
  return out;
}

}  // namespace longreach
