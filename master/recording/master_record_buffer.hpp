#pragma once
// Collects the records of the master's loop for a recording: the exact inputs and outputs of each tick, so
// that a node can be replayed, and, less often, the operator's view. The functions that the loop calls copy
// data into preallocated memory; they do not wait, allocate or make system calls. If there is no space for a
// tick, it is dropped and counted.

#include <cstdint>
#include <variant>

#include "common/recording/record_buffer.hpp"
#include "common/recording/record_ring.hpp"
#include "master/master_node.hpp"

namespace longreach {

/// A step of the node. `input` does not contain the messages, which are recorded before it.
struct MasterTickRecord {
  std::uint64_t tick = 0;    // number of the step, from 0
  std::uint32_t config = 0;  // number of the node's configuration
  std::uint32_t reports = 0, telemetry = 0;
  MasterInput input{};
  MasterOutput output{};
};

class MasterRecordBuffer : public RecordBuffer {
 public:
  /// `rate_hz` is the rate of the loop. `to_log_time` is added to the side's clock to obtain the log time.
  MasterRecordBuffer(double rate_hz, Duration to_log_time);

  /// Loop thread: adds a step and the resulting view of the node.
  void add_tick(std::uint64_t tick, std::uint32_t config, const MasterInput& input,
                const MasterOutput& output, const MasterView& view);
  /// Loop thread: returns whether a record of the link is due after this tick.
  [[nodiscard]] bool link_due(std::uint64_t tick) const { return tick % link_every_ == 0; }
  /// Loop thread: adds a record of the link.
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

  std::uint64_t view_every_, link_every_;  // intervals, ticks
  RecordRing<Record> ring_;
  std::uint16_t report_channel_ = 0, telemetry_channel_ = 0, tick_channel_ = 0, view_channel_ = 0;
  recording::ReceivedReport report_;
  recording::ReceivedTelemetry telemetry_;
  recording::MasterTick tick_;
  recording::MasterView view_;
};

/// Writes the input without its messages, whose numbers are already in `out`.
void write(const MasterInput& input, recording::MasterInput& out);
void write(const MasterOutput& output, recording::MasterOutput& out);
void write(const MasterView& view, recording::MasterView& out);
/// Reads an input without its messages. Throws RecordingError if a value is invalid.
MasterInput read(const recording::MasterInput& in);

}  // namespace longreach
