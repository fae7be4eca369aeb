#pragma once
// What the master's loop writes down for a recording: each tick's inputs and outputs, exactly, so that a node
// can be run again on them; and, less often, what the operator sees. The loop's calls cost copies into memory
// that is there already: they do not wait, allocate or call the system. A tick that the recorder has left no
// room for is not recorded, and counted.

#include <cstdint>
#include <variant>

#include "common/recording/record_buffer.hpp"
#include "common/recording/record_ring.hpp"
#include "master/master_node.hpp"

namespace longreach {

/// A step of the node. `input` without the messages, which are recorded before it.
struct MasterTickRecord {
  std::uint64_t tick = 0;    // from 0 at the node's first step
  std::uint32_t config = 0;  // number of the configuration that the node has
  std::uint32_t reports = 0, telemetry = 0;
  MasterInput input{};
  MasterOutput output{};
};

class MasterRecordBuffer : public RecordBuffer {
 public:
  MasterRecordBuffer(double rate_hz, Duration to_log_time);

  /// Loop: a step that was taken, and what the node shows after it.
  void add_tick(std::uint64_t tick, std::uint32_t config, const MasterInput& input,
                const MasterOutput& output, const MasterView& view);
  /// Loop: whether the link is due, after this tick.
  [[nodiscard]] bool link_due(std::uint64_t tick) const { return tick % link_every_ == 0; }
  void add_link(const LinkSample& sample);

 private:
  struct ViewRecord {
    std::uint64_t tick = 0;
    Time now{};
    MasterView view{};
  };
  using Record =
      std::variant<Received<StiffnessReport>, Received<Telemetry>, MasterTickRecord, ViewRecord, LinkSample>;

  void declare_ticks(McapWriter& writer) override;
  void drain_ticks(McapWriter& writer) override;
  void write_record(const Received<StiffnessReport>& record, McapWriter& writer);
  void write_record(const Received<Telemetry>& record, McapWriter& writer);
  void write_record(const MasterTickRecord& record, McapWriter& writer);
  void write_record(const ViewRecord& record, McapWriter& writer);
  void write_record(const LinkSample& record, McapWriter& writer) { write_link(record, writer); }

  std::uint64_t view_every_, link_every_;  // ticks
  RecordRing<Record> ring_;
  std::uint16_t report_channel_ = 0, telemetry_channel_ = 0, tick_channel_ = 0, view_channel_ = 0;
  recording::ReceivedReport report_;
  recording::ReceivedTelemetry telemetry_;
  recording::MasterTick tick_;
  recording::MasterView view_;
};

/// Without the messages, whose numbers are in `out` already.
void write(const MasterInput& input, recording::MasterInput& out);
void write(const MasterOutput& output, recording::MasterOutput& out);
void write(const MasterView& view, recording::MasterView& out);
/// Throws RecordingError.
MasterInput read(const recording::MasterInput& in);

}  // namespace longreach
